//! Faults planted between the world and the decider, to see whether a sweep catches them, and failures of single parts,
//! to see what the decider makes of them.

use corridor_decider::decision::{Decision, PathRung, SpeedRung};
use corridor_decider::frame::Frame;
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle};
use corridor_decider::planner::{self, TaskName};
use corridor_decider::reference_line::{LineQuery, SlPoint};
use serde::{Deserialize, Serialize};

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
pub(crate) const SUDDEN: u32 = 10;

/// A part that fails for a while.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Failure {
    /// Which part.
    pub of: Part,
    /// From when on, s.
    pub from: f64,
    /// Until when, s.
    pub until: f64,
}

/// What can fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Part {
    /// One of the stage's tasks.
    Task(TaskName),
    /// A source of a path for a tick whose own failed.
    Path(PathRung),
    /// A source of a speed for a tick whose own failed.
    Speed(SpeedRung),
    /// The ego's place is no number.
    Localisation,
    /// The route gives no line.
    ReferenceLine,
}

/// The parts that fail at one time.
pub(crate) fn failing(failures: &[Failure], time: f64) -> impl Iterator<Item = Part> + '_ {
    let now = move |failure: &&Failure| failure.from <= time && time < failure.until;
    failures.iter().filter(now).map(|failure| failure.of)
}

impl Part {
    /// Whether this is that part of the planner.
    pub(crate) fn is(self, part: planner::Part) -> bool {
        match (self, part) {
            (Self::Task(own), planner::Part::Task(other)) => own == other,
            (Self::Path(own), planner::Part::Path(other)) => own == other,
            (Self::Speed(own), planner::Part::Speed(other)) => own == other,
            _ => false,
        }
    }
}

/// The frame as it is seen while a part fails.
pub(crate) fn without(mut frame: Frame, part: Part) -> Frame {
    match part {
        Part::Task(_) | Part::Path(_) | Part::Speed(_) => {}
        Part::Localisation => frame.ego.pose = Pose::new(f64::NAN, f64::NAN, f64::NAN),
        Part::ReferenceLine => frame.lines.clear(),
    }
    frame
}

/// The decision with a number that is none.
pub(crate) fn not_a_number(mut decision: Decision) -> Decision {
    if let Some(point) = decision.trajectory.last_mut() {
        point.v = f64::NAN;
    }
    decision
}

/// The frame with every obstacle on the other side of the ego's line.
pub(crate) fn mirrored(frame: &Frame) -> Frame {
    let mut frame = frame.clone();
    let Some(line) = frame.lines.first().map(|first| first.line.clone()) else {
        return frame;
    };
    let flip = |pose: &mut Pose| {
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
