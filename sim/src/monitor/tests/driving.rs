//! Road, motion, time to collision, standstill, progress: each threshold from both sides.

use super::fixture::*;
use crate::verdict::Ending;
use corridor_decider::decision::{Stop, StopCause};
use corridor_decider::frame::{EgoState, ObstacleId};
use corridor_decider::geometry::Pose;
use corridor_decider::tasks::path_bounds::{Borrow, Label, LaneType};
use corridor_scenarios::scenario::Expectation;
use std::f64::consts::PI;

fn free_run() -> Run {
    Run::new(scenario(&[], Expectation::Progress(100.0)))
}

#[test]
fn the_road_may_be_left_by_0_3_m() {
    for (over, pass) in [(0.29, true), (0.31, false)] {
        let mut run = free_run();
        let y = -1.75 + 1.055 - over;
        run.drive(0.2, |t| ego(50.0 + 8.0 * t, y, 0.0, 8.0), |_| Vec::new());
        let metric = run.metric("drivable_area");
        assert!(metric.gate && metric.pass == pass, "{over}: {metric:?}");
        assert!((metric.value.unwrap() - over).abs() < 1e-9);
    }
}

#[test]
fn driving_against_the_lane_counts_metres_in_a_second() {
    for (v, pass) in [(5.9, true), (6.1, false)] {
        let mut run = free_run();
        run.drive(2.0, |t| ego(50.0 + v * t, 3.5, 0.0, v), |_| Vec::new());
        let metric = run.metric("driving_direction");
        assert!(
            metric.pass == pass && (metric.value.unwrap() - v).abs() < 0.1,
            "{metric:?}"
        );
    }
    let mut run = free_run();
    run.drive(2.0, |t| ego(100.0 - 8.0 * t, 3.5, PI, 8.0), |_| Vec::new());
    assert!(run.value("driving_direction") < 1e-9, "along the oncoming lane");
}

#[test]
fn a_borrow_and_the_way_back_from_it_may_go_against_the_lane() {
    let borrow = Label::Regular {
        borrow: Borrow::Left,
        lane: LaneType::Reverse,
    };
    let mut run = free_run();
    let at = |t: f64| ego(20.0 + 8.0 * t, 3.5, 0.0, 8.0);
    run.tick(&decision(bound(borrow, -1.0, 5.0), 20.0));
    run.drive(3.0, at, |_| Vec::new());
    run.tick(&decision(bound(OWN, -1.0, 5.0), 20.0));
    run.drive(7.0, at, |_| Vec::new());
    assert!(
        run.metric("driving_direction").pass,
        "{:?}",
        run.metric("driving_direction")
    );
    run.drive(10.0, at, |_| Vec::new());
    assert!(!run.metric("driving_direction").pass, "never came back");
}

#[test]
fn comfort_knows_each_of_its_bounds() {
    let worst = |state: &dyn Fn(f64) -> EgoState| {
        let mut run = Run::new(scenario(&[], Expectation::Progress(1e6)));
        run.drive(5.0, state, |_| Vec::new());
        run
    };
    let braking = |a: f64| {
        worst(&move |_| EgoState {
            a,
            ..ego(50.0, 0.0, 0.0, 8.0)
        })
    };
    assert!(braking(-4.04).metric("comfort").pass && !braking(-4.06).metric("comfort").pass);
    assert!(braking(2.39).metric("comfort").pass && !braking(2.41).metric("comfort").pass);
    let turning = |rate: f64, v: f64| {
        worst(&move |t| EgoState {
            yaw_rate: rate,
            ..ego(50.0, 0.0, corridor_decider::geometry::angle::wrap(rate * t), v)
        })
    };
    assert!(turning(0.94, 1.0).metric("yaw_rate").pass && !turning(0.96, 1.0).metric("yaw_rate").pass);
    assert!(
        turning(0.5, 9.77).metric("comfort").pass,
        "4.885 m/s² to the side"
    );
    assert!(
        !turning(0.5, 9.79).metric("lateral_acceleration").pass,
        "4.895 m/s² to the side"
    );
    let jerking = |j: f64| {
        worst(&move |t| EgoState {
            a: j * (t - 2.5) * 0.1,
            ..ego(50.0, 0.0, 0.0, 1.0)
        })
    };
    assert!(jerking(41.2).metric("lon_jerk").pass && !jerking(41.4).metric("lon_jerk").pass);
    let spinning = |a: f64| worst(&move |t| ego(50.0, 0.0, 0.5 * a * (t - 2.5) * (t - 2.5) * 0.1, 1.0));
    assert!(spinning(19.2).metric("yaw_acceleration").pass);
    assert!(!spinning(19.4).metric("yaw_acceleration").pass);
}

#[test]
fn speeding_costs_in_proportion() {
    let mut run = free_run();
    run.drive(5.0, |t| ego(20.0 + 11.115 * t, 0.0, 0.0, 11.115), |_| Vec::new());
    assert!(
        (run.value("speed_limit") - 0.5).abs() < 1e-9,
        "half of 2.23 m/s over all the time"
    );
    assert!((run.value("overspeed") - 1.115).abs() < 1e-9 && !run.metric("overspeed").pass);
}

#[test]
fn time_to_collision_is_that_of_the_straight_projection() {
    let ttc = |gap: f64, y: f64, v: f64| {
        let mut run = Run::new(scenario(&[Pose::new(0.0, 0.0, 0.0)], Expectation::Progress(1e6)));
        let car = motion(50.0 + 3.89 + gap + 2.25, y, 0.0, v);
        run.drive(0.1, |_| ego(50.0, 0.0, 0.0, 8.0), |_| vec![car]);
        run.metric("ttc")
    };
    // 8 m/s against a standing car: contact lies in the first step of 0.1 s at or after gap / 8.
    assert!((ttc(7.9, 0.0, 0.0).value.unwrap() - 1.0).abs() < 1e-9 && ttc(7.9, 0.0, 0.0).pass);
    assert!((ttc(7.1, 0.0, 0.0).value.unwrap() - 0.9).abs() < 1e-9 && !ttc(7.1, 0.0, 0.0).pass);
    assert_eq!(ttc(7.1, 0.0, 8.0).value, None, "nobody gets nearer");
    assert_eq!(ttc(7.1, 2.0, 0.0).value, None, "passes beside");
    assert_eq!(ttc(24.5, 0.0, 0.0).value, None, "beyond the horizon");
    assert_eq!(ttc(-20.0, 0.0, 20.0).value, None, "from behind");
}

#[test]
fn standing_needs_a_reason_that_is_there_to_be_seen() {
    let stand = |duration: f64, v: f64, stop: Option<StopCause>| {
        let cars = [Pose::new(0.0, 0.0, 0.0), Pose::new(0.0, 0.0, 0.0)];
        let mut run = Run::new(scenario(&cars, Expectation::Progress(100.0)));
        let stop = stop.map(|cause| Stop { distance: 5.0, cause });
        let answer = decision(bound(OWN, -1.0, 1.0), 50.0);
        run.tick(&corridor_decider::decision::Decision { stop, ..answer });
        let cars = vec![motion(70.0, 0.0, 0.0, 0.0), motion(90.0, 0.0, 0.0, 0.0)];
        run.drive(duration, |_| ego(50.0, 0.0, 0.0, v), |_| cars.clone());
        run.metric("standstill")
    };
    assert!(stand(10.0, 0.0, None).pass && !stand(10.2, 0.0, None).pass);
    assert!(stand(30.0, 0.011, None).pass);
    let blocked = |id| Some(StopCause::Blocked(ObstacleId(id)));
    assert!(stand(30.0, 0.0, blocked(0)).pass, "13.9 m ahead");
    assert!(!stand(30.0, 0.0, blocked(1)).pass, "33.9 m ahead");
    assert!(!stand(30.0, 0.0, blocked(99)).pass, "no such obstacle");
    assert!(!stand(30.0, 0.0, Some(StopCause::PathEnd)).pass);
    assert!(
        !stand(30.0, 0.0, Some(StopCause::Destination)).pass,
        "60 m short of it"
    );
    assert!(!stand(30.0, 0.0, Some(StopCause::PullOver)).pass, "no target");
}

#[test]
fn progress_counts_from_the_start_and_a_fifth_is_the_least() {
    for (metres, pass) in [(19.9, false), (20.1, true)] {
        let mut run = free_run();
        run.drive(1.0, |t| ego(10.0 + metres * t, 0.0, 0.0, metres), |_| Vec::new());
        let metric = run.metric("progress_min");
        assert!(metric.pass == pass && metric.gate, "{metric:?}");
        assert!((run.value("distance") - metres).abs() < 1e-6);
    }
    let mut parked = Run::new(scenario(&[], Expectation::Progress(10.0)));
    parked.drive(1.0, |_| ego(10.0, 0.0, 0.0, 0.0), |_| Vec::new());
    assert!(
        !parked.metric("progress_min").pass,
        "a parked ego makes no progress on any route"
    );
    let mut back = free_run();
    back.drive(1.0, |t| ego(10.0 - 5.0 * t, 0.0, 0.0, -5.0), |_| Vec::new());
    assert!(back.value("progress").abs() < 1e-12);
}

#[test]
fn the_goal_ends_the_run_three_metres_before_it() {
    let mut run = free_run();
    run.tick(&decision(bound(OWN, -1.0, 1.0), 10.0));
    run.drive(60.0, |t| ego(10.0 + 8.0 * t, 0.0, 0.0, 8.0), |_| Vec::new());
    let verdict = run.verdict();
    assert_eq!(verdict.ending, Ending::GoalReached);
    assert!(
        verdict.pass && (verdict.duration - 97.0 / 8.0).abs() < 0.1,
        "{}",
        verdict.summary
    );
    assert!(
        verdict
            .metrics
            .windows(2)
            .all(|pair| pair[0].gate >= pair[1].gate),
        "gates first"
    );
    assert!(
        (run.value("nuplan_cls") - 1.0).abs() < 0.03,
        "{}",
        run.value("nuplan_cls")
    );
}

#[test]
fn a_state_that_is_not_a_number_fails_the_run() {
    let mut run = free_run();
    run.drive(0.5, |_| ego(f64::NAN, 0.0, 0.0, 8.0), |_| Vec::new());
    assert!(!run.verdict().pass && !run.metric("progress_min").pass);
}
