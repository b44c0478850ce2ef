//! Consecutive plans, the lane's middle, and what excuses leaving it.

use super::fixture::*;
use corridor_decider::decision::{Decision, TrajectoryPoint};
use corridor_decider::geometry::Pose;
use corridor_decider::tasks::path_bounds::{Borrow, Label, LaneType};
use corridor_scenarios::scenario::Expectation;

/// A plan over `end` seconds of acceleration and curvature at 8 m/s, as functions of the run's time.
fn plan(at: f64, end: f64, a: impl Fn(f64) -> f64, kappa: impl Fn(f64) -> f64) -> Decision {
    let point = |k: u32| {
        let t = f64::from(k) * 0.02;
        TrajectoryPoint {
            t,
            distance: 8.0 * t,
            pose: Pose::new(20.0 + 8.0 * (at + t), 0.0, 0.0),
            kappa: kappa(at + t),
            v: 8.0,
            a: a(at + t),
        }
    };
    Decision {
        trajectory: (0..=400)
            .map(point)
            .take_while(|point| point.t <= end + 1e-9)
            .collect(),
        ..decision(bound(OWN, -1.0, 1.0), 20.0)
    }
}

/// A run of two plans, 0.1 s apart.
fn after(first: &Decision, second: &Decision) -> Run {
    let mut run = Run::new(scenario(&[], Expectation::Progress(1e6)));
    run.tick(first);
    run.time += 0.1;
    run.tick(second);
    run
}

#[test]
fn a_plan_that_is_the_rest_of_the_last_one_agrees_with_it() {
    let a = |t: f64| 1.0 - 0.3 * t;
    let kappa = |t: f64| 0.01 * t;
    let run = after(&plan(0.0, 7.0, a, kappa), &plan(0.1, 7.0, a, kappa));
    assert!((run.value("consistency") - 1.0).abs() < 1e-12);
    for part in ["acceleration", "jerk", "yaw_rate", "yaw_acceleration"] {
        assert!(run.value(&format!("consistency_{part}")) < 1e-9, "{part}");
    }
}

#[test]
fn each_difference_has_its_bound() {
    let none = |_: f64| 0.0;
    let level = |by: f64| after(&plan(0.0, 4.0, none, none), &plan(0.1, 4.0, |_| by, none));
    assert!((level(0.69).value("consistency_acceleration") - 0.69).abs() < 1e-9);
    assert!(level(-0.69).metric("consistency_acceleration").pass && level(0.69).metric("consistency").pass);
    assert!(!level(0.71).metric("consistency_acceleration").pass && level(0.71).value("consistency") < 1e-9);
    // A slope of the difference is a jerk; over a short plan it stays a small acceleration.
    let ramp = |by: f64| {
        after(
            &plan(0.0, 1.1, none, none),
            &plan(0.1, 1.0, |t| by * (t - 0.6), none),
        )
    };
    assert!(
        (ramp(0.49).value("consistency_jerk") - 0.49).abs() < 1e-9 && ramp(0.49).metric("consistency").pass
    );
    assert!(!ramp(0.51).metric("consistency_jerk").pass && !ramp(0.51).metric("consistency").pass);
    let turn = |by: f64| after(&plan(0.0, 4.0, none, none), &plan(0.1, 4.0, none, |_| by / 8.0));
    assert!(
        turn(0.099).metric("consistency_yaw_rate").pass && !turn(-0.101).metric("consistency_yaw_rate").pass
    );
    let twist = |by: f64| {
        let kappa = move |t: f64| by * (t - 0.6) / 8.0;
        after(&plan(0.0, 1.1, none, none), &plan(0.1, 1.0, none, kappa))
    };
    assert!(twist(0.099).metric("consistency_yaw_acceleration").pass);
    assert!(
        !twist(0.101).metric("consistency_yaw_acceleration").pass && !twist(0.101).metric("consistency").pass
    );
}

#[test]
fn consistency_is_the_share_that_agrees_and_needs_a_common_time() {
    let none = |_: f64| 0.0;
    let mut run = after(&plan(0.0, 4.0, none, none), &plan(0.1, 4.0, none, none));
    for k in 2..=4 {
        run.time += 0.1;
        let a = if k == 4 { 2.0 } else { 0.0 };
        run.tick(&plan(0.1 * f64::from(k), 4.0, |_| a, none));
    }
    assert!((run.value("consistency") - 0.75).abs() < 1e-12 && !run.metric("consistency").gate);
    assert!((run.metric("consistency").worst_t.unwrap() - 0.4).abs() < 1e-9);
    let short = after(&plan(0.0, 0.2, none, none), &plan(0.1, 4.0, |_| 3.0, none));
    assert_eq!(short.metric("consistency").value, None, "they share 0.1 s");
    let empty = Decision {
        trajectory: Vec::new(),
        ..plan(0.0, 0.2, none, none)
    };
    assert_eq!(
        after(&empty, &plan(0.1, 4.0, none, none))
            .metric("consistency")
            .value,
        None
    );
}

/// Time beside the middle under a label, s.
fn beside(l: f64, label: Label, duration: f64) -> Run {
    let mut run = Run::new(scenario(&[], Expectation::Progress(1e6)));
    run.tick(&decision(bound(label, -2.0, 2.0), 20.0));
    run.drive(duration, |t| ego(20.0 + 8.0 * t, l, 0.0, 8.0), |_| Vec::new());
    run
}

#[test]
fn the_lane_may_be_left_for_a_reason() {
    assert!(beside(0.49, OWN, 9.0).metric("lane_keep").pass);
    assert!(
        beside(-0.51, OWN, 2.0).metric("lane_keep").pass && !beside(-0.51, OWN, 2.2).metric("lane_keep").pass
    );
    let borrow = Label::Regular {
        borrow: Borrow::Left,
        lane: LaneType::Reverse,
    };
    for label in [borrow, Label::PullOver, Label::LaneChange] {
        assert!(beside(1.5, label, 9.0).metric("lane_keep").pass, "{label}");
    }
    assert!(!beside(1.5, Label::Fallback, 9.0).metric("lane_keep").pass);
}

/// A pull-over is no reason to drive against the lane's direction; only a borrow is.
#[test]
fn only_a_borrow_may_go_against_the_lane() {
    assert!(!beside(3.5, Label::PullOver, 3.0).metric("driving_direction").pass);
    assert!(
        !beside(3.5, Label::LaneChange, 3.0)
            .metric("driving_direction")
            .pass
    );
    let borrow = Label::Regular {
        borrow: Borrow::Left,
        lane: LaneType::Reverse,
    };
    assert!(beside(3.5, borrow, 3.0).metric("driving_direction").pass);
}

/// One way out and back in ten seconds is two changes in the minute that it is part of, not twelve.
#[test]
fn flips_are_counted_over_a_minute_at_least() {
    let flips = |ticks: u32| {
        let mut run = Run::new(scenario(&[], Expectation::Progress(1e6)));
        for k in 0..ticks {
            let label = if k % 50 < 25 { OWN } else { Label::Fallback };
            run.tick(&decision(bound(label, -1.0, 1.0), 20.0));
            run.time += 0.1;
        }
        run.value("label_flips")
    };
    assert!((flips(75) - 2.0).abs() < 1e-9);
    assert!((flips(1201) - 47.0 / 2.0).abs() < 0.6, "{}", flips(1201));
}
