//! Soundness, containment, jitter, flips, retargets, tracking.

use super::fixture::*;
use crate::decider::NoAnswer;
use crate::verdict::Ending;
use corridor_decider::decision::{Decision, Outcome, PullOverTarget};
use corridor_decider::frame::ObstacleId;
use corridor_decider::geometry::Vec2;
use corridor_decider::tasks::path_bounds::{EdgeCause, Label};
use corridor_scenarios::scenario::Expectation;

fn run() -> Run {
    Run::new(scenario(&[], Expectation::Progress(1e6)))
}

/// One planning period in which the ego is at `l`.
fn drive_at(run: &mut Run, l: f64) {
    run.drive(
        run.time + 0.1,
        |t| ego(20.0 + 8.0 * t, l, 0.0, 8.0),
        |_| Vec::new(),
    );
}

#[test]
fn unsound_answers_end_the_run() {
    let sound = || decision(bound(OWN, -1.0, 1.0), 10.0);
    let spoilt = |spoil: &dyn Fn(&mut Decision)| {
        let mut run = run();
        let mut answer = sound();
        spoil(&mut answer);
        run.tick(&answer);
        let metric = run.metric("decider_ok");
        assert_eq!(metric.pass, run.ending() != Some(Ending::DeciderFailed));
        metric.pass
    };
    assert!(spoilt(&|_| ()));
    assert!(
        spoilt(&|d| d.candidates[0].bound.points[3].l_max = -1.0),
        "width zero is ordered"
    );
    assert!(!spoilt(&|d| d.candidates[0].bound.points[3].l_max = -1.000_001));
    assert!(!spoilt(&|d| d.candidates[0].bound.points[3].l_min = f64::NAN));
    assert!(!spoilt(&|d| d.candidates[0].bound.points[3].s = 1.0));
    assert!(!spoilt(&|d| d.candidates[0].bound.points.truncate(1)));
    assert!(spoilt(&|d| d.candidates[0].bound.points.truncate(2)));
    assert!(!spoilt(&|d| d.trajectory[2].v = f64::INFINITY));
    assert!(!spoilt(&|d| d.trajectory[2].t = 0.1));
    assert!(!spoilt(&|d| d.chosen = Some(1)));
    assert!(!spoilt(&|d| d.line = 1));
    assert!(spoilt(&|d| d.chosen = None));
}

#[test]
fn a_panic_is_the_deciders_failure() {
    let mut run = run();
    run.monitor
        .decider_failed(1.3, &NoAnswer::Panicked("index out of range".to_owned()));
    let verdict = run.verdict();
    assert_eq!(verdict.ending, Ending::DeciderFailed);
    assert!(
        !verdict.pass && verdict.summary.contains("index out of range"),
        "{}",
        verdict.summary
    );
}

#[test]
fn the_ego_is_held_against_the_bound_it_was_given() {
    let drive = |l: f64| {
        let mut run = run();
        run.tick(&decision(bound(OWN, -0.5, 0.5), 20.0));
        drive_at(&mut run, l);
        run
    };
    assert!(drive(0.499).metric("bound_containment").pass);
    assert!(!drive(-0.501).metric("bound_containment").pass);
    assert!(drive(0.599).metric("bound_excess").pass && !drive(-0.601).metric("bound_excess").pass);
    let mut padded = run();
    let mut pad = bound(OWN, -0.5, 0.5);
    pad.padding = 190;
    padded.tick(&decision(pad, 20.0));
    drive_at(&mut padded, 3.0);
    assert_eq!(
        padded.metric("bound_containment").value,
        None,
        "padding promises nothing"
    );
}

#[test]
fn the_narrowest_place_is_reported_with_its_obstacle() {
    let mut run = run();
    let mut narrow = bound(OWN, -0.5, 0.5);
    narrow.points[40].l_max = 0.1;
    narrow.points[40].left = EdgeCause::Obstacle(ObstacleId(7));
    run.tick(&decision(narrow, 20.0));
    let metric = run.metric("min_bound_width");
    assert!((metric.value.unwrap() - 0.6).abs() < 1e-12);
    assert_eq!(metric.worst_obstacle.as_deref(), Some("obstacle 7"));
}

#[test]
fn jitter_is_a_moved_limit_and_not_a_moved_station() {
    let jitter = |shift: f64, step_at: f64, offset: f64| {
        let mut run = run();
        for k in 0..2 {
            let moved = f64::from(k);
            let mut b = bound(OWN, -0.5, 0.5);
            for p in &mut b.points {
                p.s += moved * offset;
                let edge = if p.s >= step_at { 0.2 } else { 0.5 };
                p.l_max = edge + moved * shift;
            }
            run.tick(&decision(b, 20.0));
            drive_at(&mut run, 0.0);
        }
        run.metric("bound_jitter")
    };
    assert!(
        jitter(0.0, 30.2, 0.3).value.unwrap() <= 0.0,
        "the edge of an obstacle between two stations"
    );
    assert!(jitter(0.25, 1e9, 0.3).pass && !jitter(0.26, 1e9, 0.3).pass);
    assert!(!jitter(-0.26, 1e9, 0.0).pass);
}

#[test]
fn labels_and_sides_may_not_flip_much() {
    let flips = |labels: &[Label]| {
        let mut run = run();
        for label in labels.iter().cycle().take(600) {
            run.tick(&decision(bound(*label, -1.0, 1.0), 20.0));
            run.time += 0.1;
        }
        run.metric("label_flips")
    };
    assert!(flips(&[OWN]).value.unwrap().abs() < 1e-12);
    let rare: Vec<Label> = (0..600)
        .map(|k| if k / 100 % 2 == 0 { OWN } else { Label::Fallback })
        .collect();
    assert!(flips(&rare).pass, "five a minute");
    let often: Vec<Label> = (0..600)
        .map(|k| if k / 75 % 2 == 0 { OWN } else { Label::Fallback })
        .collect();
    assert!(!flips(&often).pass, "seven a minute");

    let mut run = run();
    let mut see = |left: bool| {
        let mut b = bound(OWN, -1.0, 1.0);
        let cause = EdgeCause::Obstacle(ObstacleId(0));
        if left {
            b.points[9].left = cause;
        } else {
            b.points[9].right = cause;
        }
        run.tick(&decision(b, 20.0));
        run.metric("side_flips")
    };
    assert!(
        see(true).pass && see(true).pass && see(false).pass,
        "one change of mind"
    );
    assert!(!see(true).pass);
}

#[test]
fn fallbacks_are_counted() {
    let mut run = run();
    for k in 0..100 {
        let outcome = if k < 6 {
            Outcome::PathFallback
        } else {
            Outcome::Normal
        };
        let answer = decision(bound(OWN, -1.0, 1.0), 20.0);
        run.tick(&Decision { outcome, ..answer });
        run.time += 0.1;
        if k == 5 {
            assert!((run.value("fallback_longest") - 0.5).abs() < 1e-9);
        }
    }
    assert!((run.value("fallback_ratio") - 0.06).abs() < 1e-12 && !run.metric("fallback_ratio").pass);
    let expected = [("normal".to_owned(), 94), ("path_fallback".to_owned(), 6)];
    assert_eq!(run.verdict().outcomes, expected);
}

#[test]
fn a_target_may_change_once() {
    let mut run = run();
    let mut aim = |x: f64| {
        let target = PullOverTarget {
            position: Vec2::new(x, -1.0),
            theta: 0.0,
        };
        let answer = decision(bound(Label::PullOver, -1.0, 1.0), 20.0);
        run.tick(&Decision {
            pull_over: Some(target),
            ..answer
        });
        run.metric("pull_over_retargets")
    };
    assert!(aim(50.0).pass && aim(50.05).pass && aim(60.0).pass);
    assert!(!aim(50.0).pass);
}

#[test]
fn tracking_is_measured_across_the_trajectory() {
    let drive = |l: f64, lag: f64| {
        let mut run = run();
        run.tick(&decision(bound(OWN, -1.0, 1.0), 20.0));
        run.drive(1.0, |t| ego(20.0 + 8.0 * t - lag, l, 0.0, 8.0), |_| Vec::new());
        run
    };
    assert!(
        drive(0.099, 2.0).metric("tracking_error").pass,
        "lagging is no lateral error"
    );
    assert!(!drive(-0.101, 0.0).metric("tracking_error").pass);
    assert!(drive(0.299, 0.0).metric("tracking_error_max").pass);
    assert!(!drive(0.301, 0.0).metric("tracking_error_max").pass);
}
