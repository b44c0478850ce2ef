//! Failures of single parts for a while, to see what the decider makes of them, and to give a fault its occasion.

use corridor_decider::decision::{PathRung, SpeedRung};
use corridor_decider::frame::Frame;
use corridor_decider::geometry::Pose;
use corridor_decider::planner::{self, TaskName};
use serde::{Deserialize, Serialize};

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
