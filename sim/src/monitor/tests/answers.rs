//! Bounds, paths and blocks against what stands.

use super::fixture::*;
use crate::verdict::Metric;
use corridor_decider::decision::{Decision, PathPoint};
use corridor_decider::frame::{Obstacle, ObstacleId, ObstacleKind};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2};
use corridor_scenarios::scenario::Expectation;

/// The metric after one answer with a car, 1.8 m wide, at `(60, y)`.
fn judged(name: &str, y: f64, answer: &Decision) -> Metric {
    judged_at(name, Pose::new(60.0, y, 0.0), answer)
}

fn judged_at(name: &str, car: Pose, answer: &Decision) -> Metric {
    let mut run = Run::new(scenario(&[car], Expectation::Progress(1e6)));
    let mut frame = run.frame();
    frame.ego = ego(10.0, 0.0, 0.0, 8.0);
    frame.obstacles = vec![Obstacle {
        id: ObstacleId(0),
        kind: ObstacleKind::Car,
        pose: car,
        shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 2.25, 2.25, 0.9),
        velocity: Vec2::zeros(),
        is_static: true,
        prediction: Vec::new(),
    }];
    run.monitor.tick(&frame, answer);
    run.metric(name)
}

#[test]
fn a_bound_swept_by_the_car_may_not_cover_what_stands() {
    let gap = |l_max: f64| {
        judged(
            "bound_obstacle_clearance",
            3.0,
            &decision(bound(OWN, -0.5, l_max), 10.0),
        )
    };
    // The car's right side is at 2.1, the ego's left one at 1.055 beside its axle.
    assert!((gap(0.645).value.unwrap() - 0.4).abs() < 1e-9);
    assert!(gap(0.944).pass && !gap(0.946).pass);
    assert_eq!(gap(1.046).worst_obstacle.as_deref(), Some("car_0"));
}

#[test]
fn padding_is_part_of_the_answer() {
    let mut padded = bound(OWN, -0.5, 0.5);
    padded.padding = 150;
    padded.blocked_by = Some(ObstacleId(0));
    let metric = judged("bound_obstacle_clearance", 0.0, &decision(padded, 10.0));
    assert!(metric.gate && !metric.pass, "{metric:?}");
}

#[test]
fn a_closed_road_is_not_open_and_an_open_one_not_closed() {
    let answer = |blocked_by| {
        let mut bound = bound(OWN, -0.5, 0.5);
        bound.blocked_by = blocked_by;
        decision(bound, 10.0)
    };
    let car = Some(ObstacleId(0));
    // Across the road it leaves 0.75 m on one side and 1.75 m on the other.
    let across = Pose::new(60.0, 1.25, std::f64::consts::FRAC_PI_2);
    assert!(!judged_at("missed_block", across, &answer(None)).pass);
    assert!(judged("missed_block", 1.75, &answer(None)).pass);
    assert!(judged("false_block", 0.0, &answer(car)).pass);
    assert!(!judged("false_block", 4.5, &answer(car)).pass);
    assert!(judged("blocker_id_correct", 0.0, &answer(car)).pass);
}

#[test]
fn a_path_may_not_lead_through_what_stands() {
    let path = |y: f64| {
        let mut answer = decision(bound(OWN, -0.5, 0.5), 50.0);
        let point = |k: u32| PathPoint {
            distance: f64::from(k),
            s: 50.0 + f64::from(k),
            l: 0.0,
            pose: Pose::new(50.0 + f64::from(k), 0.0, 0.0),
            kappa: 0.0,
        };
        answer.path = (0..=20).map(point).collect();
        judged("path_obstacle_clearance", y, &answer)
    };
    assert!((path(2.055).value.unwrap() - 0.1).abs() < 1e-9 && path(2.055).pass);
    assert!(!path(1.9).pass && path(1.9).gate);
}
