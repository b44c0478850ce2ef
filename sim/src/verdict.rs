//! How a run ended: every metric with its value, its threshold and its worst moment.

use crate::signature::Signature;
use corridor_decider::decision::{Fallback, Outcome};
use serde::{Deserialize, Serialize};

/// The judgement on one run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Whether the run ended as expected and passed every gate.
    pub pass: bool,
    /// How it ended, in one word.
    pub ending: Ending,
    /// One sentence for people: why it passed or failed.
    pub summary: String,
    /// Simulated time, s.
    pub duration: f64,
    /// Every metric, gates first. Names are those of the field.
    pub metrics: Vec<Metric>,
    /// All collisions, first contact each.
    pub collisions: Vec<Collision>,
    /// Ticks per outcome of the decider, by name.
    pub outcomes: Vec<(String, u32)>,
    /// Per rung of the chain of fallbacks how often and why it was needed.
    #[serde(default)]
    pub fallbacks: Vec<FallbackCount>,
    /// What kind of failure it is; absent for a run that passed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub signature: Option<Signature>,
    /// Hash over all ticks' state hashes, hexadecimal.
    pub digest: String,
}

impl Verdict {
    /// The metric of this name.
    pub fn metric(&self, name: &str) -> Option<&Metric> {
        self.metrics.iter().find(|metric| metric.name == name)
    }
}

/// The ticks that ended on one rung for one reason.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FallbackCount {
    /// How they ended.
    pub outcome: Outcome,
    /// The rung and what led there.
    pub fallback: Fallback,
    /// How many.
    pub ticks: u32,
    /// When the first of them was, s.
    pub first: f64,
    /// Longest time between the first and the last of a row of them, s.
    pub longest: f64,
    /// Whether a tick was planned again after the last of them.
    pub recovered: bool,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// The goal was reached.
    GoalReached,
    /// The ego stands at the road's edge.
    PulledOver,
    /// The ego is in the target lane.
    LaneChanged,
    /// The command was refused, as it had to be.
    Refused,
    /// The ego stands behind something that cannot be passed, as it had to.
    StoodStill,
    /// The ego stands at the road's edge, but not where and as it should.
    PulledOverBadly,
    /// Two bodies overlapped.
    Collision,
    /// The time ran out before the expected end.
    Timeout,
    /// The decider failed: a panic, a number that is none, an unordered bound.
    DeciderFailed,
}

/// One measured quantity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Metric {
    /// Its name.
    pub name: String,
    /// Its value; absent where the run gave no occasion to measure it.
    pub value: Option<f64>,
    /// What it is compared with; absent for what is only reported.
    pub threshold: Option<f64>,
    /// Whether it is good enough; true for what is only reported.
    pub pass: bool,
    /// Whether failing it fails the run.
    pub gate: bool,
    /// When it was worst, s.
    pub worst_t: Option<f64>,
    /// Name of the obstacle of its worst moment.
    pub worst_obstacle: Option<String>,
}

/// The first contact of two bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Collision {
    /// When, s.
    pub time: f64,
    /// With what.
    pub obstacle: String,
    /// How.
    pub class: CollisionClass,
    /// Whether the ego is to blame.
    pub at_fault: bool,
    /// Difference of the velocities just before the contact, m/s.
    pub delta_v: f64,
    /// Whether full braking within the last seconds would have avoided it: an estimate.
    #[serde(default)]
    pub avoidable: bool,
}

/// Classes of collisions, as nuPlan draws them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CollisionClass {
    /// The ego stood.
    StoppedEgo,
    /// The other stood.
    StoppedTrack,
    /// The ego's front met a moving one.
    ActiveFront,
    /// A moving one met the ego's rear.
    ActiveRear,
    /// Side by side.
    ActiveLateral,
}
