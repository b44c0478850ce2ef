//! The bounds of a frame do not depend on where in the world it is, nor on which way is north.

use crate::config::Config;
use crate::context::Context;
use crate::decision::Candidate;
use crate::frame::{Command, EgoState, Frame, FrameLine, Obstacle, ObstacleId, ObstacleKind};
use crate::geometry::{ConvexPolygon, Pose, Vec2, angle};
use crate::planner::Planner;
use crate::reference_line::{LineQuery, LineSample, ReferenceLine, SlPoint, testing};
use crate::vehicle::VehicleParams;
use proptest::prelude::*;
use std::sync::Arc;

fn moved_pose(by: Pose, pose: Pose) -> Pose {
    let at = by.to_world(pose.position());
    Pose::new(at.x, at.y, angle::wrap(pose.theta + by.theta))
}

fn moved_line(by: Pose, line: &ReferenceLine) -> ReferenceLine {
    let mut samples: Vec<LineSample> = line.clone().into();
    for sample in &mut samples {
        let point = &mut sample.point;
        let there = moved_pose(by, Pose::new(point.x, point.y, point.theta));
        (point.x, point.y, point.theta) = (there.x, there.y, there.theta);
    }
    ReferenceLine::from(samples)
}

fn moved(by: Pose, frame: &Frame) -> Frame {
    let mut frame = frame.clone();
    frame.ego.pose = moved_pose(by, frame.ego.pose);
    for line in &mut frame.lines {
        line.line = Arc::new(moved_line(by, &line.line));
    }
    for obstacle in &mut frame.obstacles {
        obstacle.pose = moved_pose(by, obstacle.pose);
    }
    if let Command::PullOver(at) = &mut frame.command {
        *at = by.to_world(*at);
    }
    frame
}

/// An ego in a bend, with parked cars beside and in its lane.
fn frame(ego: (f64, f64), cars: &[(f64, f64, f64)], destination: Option<f64>) -> Frame {
    let line = testing::s_curve();
    let pose = |s: f64, l: f64, turn: f64| {
        let at = line.to_cartesian(SlPoint { s, l });
        Pose::new(at.x, at.y, angle::wrap(line.point(s).theta + turn))
    };
    let place = |s| line.to_cartesian(SlPoint { s, l: 0.0 });
    let obstacles = (0..)
        .zip(cars)
        .map(|(id, (s, l, turn))| Obstacle {
            id: ObstacleId(id),
            kind: ObstacleKind::Car,
            pose: pose(*s, *l, *turn),
            shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 2.3, 2.3, 0.9),
            velocity: Vec2::new(0.0, 0.0),
            is_static: true,
            prediction: Vec::new(),
        })
        .collect();
    Frame {
        tick: 0,
        time: 0.0,
        ego: EgoState {
            pose: pose(ego.0, ego.1, 0.02),
            v: 6.0,
            a: 0.0,
            yaw_rate: 0.0,
            steer: 0.0,
        },
        command: destination.map_or(Command::Cruise, |s| Command::PullOver(place(s))),
        cruise_speed: 8.0,
        lines: vec![FrameLine {
            line: Arc::new(line),
            is_change_lane: false,
        }],
        obstacles,
    }
}

fn candidates(frame: &Frame) -> Vec<Candidate> {
    let planner = Planner::new(Config::default(), VehicleParams::default());
    planner.decide(frame, &mut Context::default()).candidates
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn a_moved_world_has_the_same_bounds(
        by in (-1e4..1e4_f64, -1e4..1e4_f64, -3.1..3.1_f64),
        ego in (20.0..80.0_f64, -0.4..0.4_f64),
        cars in prop::collection::vec((90.0..170.0_f64, -4.0..6.0_f64, -0.5..0.5_f64), 0..5),
        destination in prop::option::of(110.0..160.0_f64),
    ) {
        let here = frame(ego, &cars, destination);
        let there = moved(Pose::new(by.0, by.1, by.2), &here);
        let (here, there) = (candidates(&here), candidates(&there));
        prop_assert!(!here.is_empty());
        prop_assert_eq!(here.len(), there.len());
        for (a, b) in here.iter().zip(&there) {
            prop_assert_eq!(a.bound.label, b.bound.label);
            // A station may fall to the other side of an obstacle's edge by rounding: never two.
            let (short, long) = (a.bound.points.len().min(b.bound.points.len()), a.bound.points.len().max(b.bound.points.len()));
            prop_assert!(long - short <= 1, "{}: {short} and {long} points", a.bound.label);
            let off = |k: &usize| {
                let (p, q) = (&a.bound.points[*k], &b.bound.points[*k]);
                (p.l_min - q.l_min).abs().max((p.l_max - q.l_max).abs()) > 1e-6
            };
            let moved = (0..short).filter(off).count();
            prop_assert!(moved <= 2 * cars.len(), "{}: {moved} points differ", a.bound.label);
            prop_assert_eq!(a.bound.blocked_by, b.bound.blocked_by);
        }
    }
}
