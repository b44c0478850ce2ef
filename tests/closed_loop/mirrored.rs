//! Left is as good as right: a world in a mirror is driven as in a mirror.
//!
//! The planners drive an ideal car, which is at each tick where the last trajectory said it would be, through the traffic
//! of a recorded run, and the same car through the mirror image of all of it.

use crate::support::trace;
use corridor_decider::baseline::Baseline;
use corridor_decider::config::Config;
use corridor_decider::context::Context;
use corridor_decider::decision::{Decision, TrajectoryPoint};
use corridor_decider::frame::{Command, EgoState, Frame, FrameLine, Obstacle};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2};
use corridor_decider::planner::{BaselinePlanner, LatticePlanner};
use corridor_decider::reference_line::{LinePoint, LineSample, ReferenceLine};
use corridor_decider::road::Side;
use corridor_sim::trace::Trace;
use std::sync::Arc;

/// A planner with what it remembers.
type Decide<'a> = Box<dyn FnMut(&Frame) -> Decision + 'a>;

fn in_mirror(v: Vec2) -> Vec2 {
    Vec2::new(v.x, -v.y)
}

fn pose_in_mirror(pose: Pose) -> Pose {
    Pose::new(pose.x, -pose.y, -pose.theta)
}

/// What lies beyond the lane's neighbours stays where it is: the planners held here do not ask for it.
fn line_in_mirror(line: &ReferenceLine) -> ReferenceLine {
    let swap = |(left, right): (f64, f64)| (right, left);
    let sample = |sample: &LineSample| {
        let mut mirrored = *sample;
        let LinePoint { x, y, theta, kappa } = sample.point;
        mirrored.point = LinePoint {
            x,
            y: -y,
            theta: -theta,
            kappa: -kappa,
        };
        mirrored.offset = -sample.offset;
        mirrored.lane_width = swap(sample.lane_width);
        mirrored.road_width = swap(sample.road_width);
        mirrored.marks = (sample.marks.1, sample.marks.0);
        mirrored
    };
    ReferenceLine::from(line.samples().iter().map(sample).collect::<Vec<_>>())
}

fn obstacle_in_mirror(obstacle: &Obstacle) -> Obstacle {
    let mut mirrored = obstacle.clone();
    let vertices: Vec<Vec2> = obstacle.shape.vertices().iter().map(|v| in_mirror(*v)).collect();
    mirrored.shape = ConvexPolygon::hull(&vertices).unwrap();
    mirrored.pose = pose_in_mirror(obstacle.pose);
    mirrored.velocity = in_mirror(obstacle.velocity);
    for predicted in &mut mirrored.prediction {
        predicted.pose = pose_in_mirror(predicted.pose);
    }
    mirrored
}

fn frame_in_mirror(frame: &Frame) -> Frame {
    let line = |of: &FrameLine| FrameLine {
        line: Arc::new(line_in_mirror(&of.line)),
        is_change_lane: of.is_change_lane,
    };
    Frame {
        ego: EgoState {
            pose: pose_in_mirror(frame.ego.pose),
            yaw_rate: -frame.ego.yaw_rate,
            steer: -frame.ego.steer,
            ..frame.ego
        },
        command: match frame.command {
            Command::ChangeLane(Side::Left) => Command::ChangeLane(Side::Right),
            Command::ChangeLane(Side::Right) => Command::ChangeLane(Side::Left),
            Command::PullOver(place) => Command::PullOver(in_mirror(place)),
            other => other,
        },
        lines: frame.lines.iter().map(line).collect(),
        obstacles: frame.obstacles.iter().map(obstacle_in_mirror).collect(),
        ..frame.clone()
    }
}

/// The states of an ideal car, tick after tick.
fn driven(trace: &Trace, seen: impl Fn(&Frame) -> Frame, mut decide: Decide) -> Vec<EgoState> {
    let mut ego: Option<EgoState> = None;
    let mut states = Vec::new();
    for k in 0..trace.ticks.len() {
        let mut frame = seen(&trace.frame(k).unwrap());
        frame.ego = ego.unwrap_or(frame.ego);
        states.push(frame.ego);
        let decision = decide(&frame);
        let Some(next) = decision.trajectory.get(1) else {
            break;
        };
        ego = Some(state_at(next));
    }
    states
}

fn state_at(point: &TrajectoryPoint) -> EgoState {
    EgoState {
        pose: point.pose,
        v: point.v,
        a: point.a,
        yaw_rate: point.v * point.kappa,
        steer: 0.0,
    }
}

fn lattice(trace: &Trace) -> Decide<'static> {
    let planner = LatticePlanner::new(Config::default(), trace.header.vehicle);
    let mut context = Context::default();
    Box::new(move |frame| planner.decide(frame, &mut context))
}

fn baseline(baseline: Baseline, trace: &Trace) -> Decide<'static> {
    let planner = BaselinePlanner::new(baseline, Config::default(), trace.header.vehicle);
    let mut context = Context::default();
    Box::new(move |frame| planner.decide(frame, &mut context))
}

fn assert_mirrored(trace: &Trace, name: &str, planner: impl Fn(&Trace) -> Decide<'static>) {
    let one = driven(trace, Frame::clone, planner(trace));
    let other = driven(trace, frame_in_mirror, planner(trace));
    assert_eq!(one.len(), other.len(), "{name}");
    assert!(one.len() > 20, "{name}: {} ticks", one.len());
    for (k, (a, b)) in one.iter().zip(&other).enumerate() {
        let apart = (in_mirror(a.pose.position()) - b.pose.position()).norm();
        assert!(apart < 1e-4, "{name}, tick {k}: {apart} m apart");
        assert!(
            (a.v - b.v).abs() < 1e-4,
            "{name}, tick {k}: {} and {} m/s",
            a.v,
            b.v
        );
    }
}

#[test]
fn planners_that_sample_do_not_know_left_from_right() {
    for name in ["cut_in", "curve_cyclist", "nudge_several"] {
        let trace = trace("mirrored", name, &["decider.planner=lattice"]);
        assert_mirrored(&trace, &format!("lattice, {name}"), lattice);
        for of in [Baseline::Blind, Baseline::Idm, Baseline::PdmClosed] {
            assert_mirrored(&trace, &format!("{of:?}, {name}"), |trace| baseline(of, trace));
        }
    }
}
