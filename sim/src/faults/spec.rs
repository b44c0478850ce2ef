//! What a planted fault is: its name, what it does, where it sits and where it is likely to show.

use super::failure::Part;
use super::hints;
use super::planted::Past;
use crate::trace::Controls;
use crate::tracker::TrackerConfig;
use corridor_decider::config::Config;
use corridor_decider::context::Context;
use corridor_decider::decision::{Decision, TrajectoryPoint};
use corridor_decider::frame::Frame;
use corridor_decider::planner::{LinePlan, TaskName};
use corridor_decider::vehicle::VehicleParams;
use serde::Serialize;

/// A fault that can be planted.
#[derive(Debug)]
pub struct Spec {
    /// Its name, for `--set fault=NAME`.
    pub name: &'static str,
    /// What is wrong, in one sentence.
    pub what: &'static str,
    /// Where the mistake was made.
    pub stage: Stage,
    /// How it is planted.
    pub plant: Plant,
    /// Parts that fail for a while in the sound run as in the faulty one, without which the fault has no occasion: which,
    /// from when and until when, s.
    pub occasion: &'static [(Part, f64, f64)],
}

/// A scenario, and the first of the seeds that are likely to show a fault.
pub type Hint = (&'static str, u64);

/// The link of the chain in which a mistake was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// What is known of the task and the road.
    Scenario,
    /// What is seen.
    Perception,
    /// The decider as a whole.
    Decider,
    /// How far left and right the car may be.
    Bound,
    /// The path inside.
    Path,
    /// The speed along it.
    Speed,
    /// The controls that follow it.
    Tracker,
}

impl Stage {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Scenario => "scenario",
            Self::Perception => "perception",
            Self::Decider => "decider",
            Self::Bound => "bound",
            Self::Path => "path",
            Self::Speed => "speed",
            Self::Tracker => "tracker",
        }
    }
}

/// How a fault is planted.
#[derive(Clone, Copy, Debug)]
pub enum Plant {
    /// Settings of the decider that are wrong.
    Config(fn(&mut Config)),
    /// The planner takes its car for another one.
    Car(fn(&mut VehicleParams)),
    /// On the frame before the decider.
    Frame(fn(&mut Frame, &mut Past)),
    /// On what the decider remembers, before each tick.
    Memory(fn(&mut Context)),
    /// In place of an answer: it may panic or never end.
    Answer(fn(&Frame)),
    /// On what one of the planner's tasks hands on.
    HandsOn(TaskName, fn(&mut LinePlan, &mut Past)),
    /// On the decision after the decider.
    Decision(fn(&mut Decision, &mut Past)),
    /// On the trajectory before the tracker, once a tick.
    Trajectory(fn(&mut Vec<TrajectoryPoint>, &mut Past)),
    /// The tracker takes its car for another one, or has other gains.
    Tracker(fn(&mut VehicleParams, &mut TrackerConfig)),
    /// On the controls after the tracker, at every step of the physics.
    Controls(fn(&mut Controls, &mut Past)),
}

impl Plant {
    /// Where it is planted, in a word or two.
    pub fn name(self) -> &'static str {
        match self {
            Self::Config(_) => "configuration",
            Self::Car(_) => "car believed in",
            Self::Frame(_) => "frame",
            Self::Memory(_) => "memory",
            Self::Answer(_) => "answer",
            Self::HandsOn(..) => "task's output",
            Self::Decision(_) => "decision",
            Self::Trajectory(_) => "trajectory",
            Self::Tracker(_) => "tracker",
            Self::Controls(_) => "controls",
        }
    }
}

impl Spec {
    /// A fault without an occasion.
    pub(super) const fn new(name: &'static str, what: &'static str, stage: Stage, plant: Plant) -> Self {
        Self {
            name,
            what,
            stage,
            plant,
            occasion: &[],
        }
    }

    /// The same with failures that give it an occasion.
    pub(super) const fn when(self, occasion: &'static [(Part, f64, f64)]) -> Self {
        Self { occasion, ..self }
    }

    /// Where it is likely to show: those are looked at before all else.
    pub fn shows_in(&self) -> Vec<Hint> {
        hints::shows_in(self.name)
    }

    /// Why no gate has seen it yet, where that is known to be so.
    pub fn unseen(&self) -> Option<&'static str> {
        hints::unseen(self.name)
    }
}
