//! The decider as the loop sees it: a planner with its memory, behind a fault if one is planted, and fenced so
//! that a panic is an outcome of the run and not the end of the sweep.

use crate::settings::Settings;
use corridor_decider::context::Context;
use corridor_decider::decision::Decision;
use corridor_decider::frame::Frame;
use corridor_decider::geometry::{ConvexPolygon, Vec2, angle};
use corridor_decider::planner::Planner;
use corridor_decider::reference_line::{LineQuery, SlPoint};
use corridor_scenarios::Scenario;
use serde::{Deserialize, Serialize};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Faults planted between the world and the decider, to see whether a sweep catches them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fault {
    /// None.
    #[default]
    None,
    /// Obstacles are seen on the other side of the reference line: `l` with the wrong sign.
    Mirrored,
    /// The decider panics at tick `SUDDEN`.
    Panic,
    /// From tick `SUDDEN` on a number of the trajectory is none.
    Nan,
}

/// The tick of sudden faults: late enough to be under way, early enough for every run.
const SUDDEN: u32 = 10;

/// A planner and its memory.
pub(crate) struct Decider {
    planner: Planner,
    context: Context,
    fault: Fault,
}

impl Decider {
    pub(crate) fn new(scenario: &Scenario, settings: &Settings) -> Self {
        Self {
            planner: Planner::new(settings.decider.clone(), scenario.vehicle),
            context: Context::default(),
            fault: settings.fault,
        }
    }

    /// Decides one frame; the error is what a panic said.
    pub(crate) fn decide(&mut self, frame: &Frame) -> Result<Decision, String> {
        let Self {
            planner,
            context,
            fault,
        } = self;
        let decide = || match fault {
            Fault::Mirrored => planner.decide(&mirrored(frame), context),
            Fault::Panic if frame.tick == SUDDEN => panic!("a planted fault"),
            Fault::Nan if frame.tick >= SUDDEN => not_a_number(planner.decide(frame, context)),
            Fault::None | Fault::Panic | Fault::Nan => planner.decide(frame, context),
        };
        catch_unwind(AssertUnwindSafe(decide)).map_err(|panic| said(&*panic).to_owned())
    }
}

/// What a panic said.
pub(crate) fn said(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or(panic.downcast_ref::<&str>().copied())
        .unwrap_or("no message")
}

fn not_a_number(mut decision: Decision) -> Decision {
    if let Some(point) = decision.trajectory.last_mut() {
        point.v = f64::NAN;
    }
    decision
}

/// The frame with every obstacle on the other side of the ego's line.
fn mirrored(frame: &Frame) -> Frame {
    let mut frame = frame.clone();
    let Some(line) = frame.lines.first().map(|first| first.line.clone()) else {
        return frame;
    };
    let flip = |pose: &mut corridor_decider::geometry::Pose| {
        let SlPoint { s, l } = line.to_frenet(pose.position());
        let along = line.point(s).theta;
        let place = line.to_cartesian(SlPoint { s, l: -l });
        (pose.x, pose.y) = (place.x, place.y);
        pose.theta = angle::wrap(2.0 * along - pose.theta);
    };
    for obstacle in &mut frame.obstacles {
        flip(&mut obstacle.pose);
        obstacle
            .prediction
            .iter_mut()
            .for_each(|predicted| flip(&mut predicted.pose));
        let outline: Vec<Vec2> = obstacle
            .shape
            .vertices()
            .iter()
            .map(|v| Vec2::new(v.x, -v.y))
            .collect();
        if let Some(shape) = ConvexPolygon::hull(&outline) {
            obstacle.shape = shape;
        }
    }
    frame
}
