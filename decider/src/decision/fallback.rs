//! Which rung of the chain of fallbacks a tick ended on, and what led there.

use crate::frame::ObstacleId;
use crate::planner::TaskName;
use crate::trajectory::Unfit;
use serde::{Deserialize, Serialize};

/// What failed, and what is driven instead.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fallback {
    /// What failed.
    pub cause: FallbackCause,
    /// Where the path comes from; `None`: it is this tick's own, or there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path: Option<PathRung>,
    /// Where the speed comes from; `None`: there is no path to have a speed on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed: Option<SpeedRung>,
}

/// What led to a fallback.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FallbackCause {
    /// A task failed.
    Task(TaskName),
    /// The trajectory that the tasks made is not fit to be driven.
    Trajectory(Unfit),
    /// There was nothing to plan with.
    Context(ContextFailure),
    /// No sampled trajectory may be driven (lattice planner).
    NoSampledTrajectory,
}

/// Why a tick cannot be planned at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ContextFailure {
    /// Place or motion of the ego is not known.
    NoLocalisation,
    /// There is no line to plan along.
    NoReferenceLine,
    /// A standing ego overlaps this obstacle.
    Overlap(ObstacleId),
}

/// Sources of a path, best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PathRung {
    /// The path of the tick before.
    LastPath,
    /// This tick's path in the own lane.
    SelfLane,
    /// Beside the reference line, as far from it as the car is.
    OffsetLine,
    /// On as the wheels are set.
    HeldArc,
}

/// Sources of a speed that stops, gentlest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SpeedRung {
    /// The optimum with the usual jerk.
    Optimised,
    /// The optimum with the jerk of an emergency.
    EmergencyJerk,
    /// Braking that rises as fast as it can, is held and let go.
    Ramp,
    /// Constant braking.
    ConstantDeceleration,
    /// The gentlest constant braking that touches nothing (lattice planner).
    LatticeBackup,
    /// The hardest braking, where all else touches something and this does, too (lattice planner).
    LatticeLastResort,
}
