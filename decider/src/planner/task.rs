//! The names of the tasks, in the original's words, and which function each of them is.

use super::plan::LinePlan;
use crate::context::Context;
use crate::decision::{PathRung, SpeedRung};
use crate::frame::ObstacleId;
use crate::tasks::path_bounds::PathBoundsError;
use crate::tasks::speed_decider::SpeedDeciderError;
use crate::tasks::speed_heuristic::SpeedHeuristicError;
use crate::tasks::{
    lane_borrow, lane_change, path, path_assessment, path_bounds, path_decider, path_reuse,
    piecewise_jerk_speed, rss, rule_based_stop, speed_bounds, speed_decider, speed_heuristic,
};
use serde::{Deserialize, Serialize};
use std::fmt;

/// A task of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TaskName {
    /// Whether the target lane is free.
    LaneChange,
    /// Whether the way of the tick before may still be driven.
    PathReuse,
    /// Which neighbouring lanes may be used to pass.
    LaneBorrow,
    /// How far left and right the car may be.
    PathBounds,
    /// The best path inside each bound.
    PiecewiseJerkPath,
    /// The same, sampled instead of optimised.
    SampledPath,
    /// Which of them is driven.
    PathAssessment,
    /// How the path passes each standing obstacle.
    PathDecider,
    /// Where the car stands on its path.
    RuleBasedStop,
    /// What moving obstacles will occupy of the path.
    SpeedBoundsPriori,
    /// A first, coarse speed profile.
    SpeedHeuristic,
    /// Before or after which moving obstacle the car passes.
    SpeedDecider,
    /// What of the path stays free by these decisions.
    SpeedBoundsFinal,
    /// The smoothest speed profile that keeps them.
    PiecewiseJerkSpeed,
    /// The same with the bends where the car will be.
    PiecewiseJerkNonlinearSpeed,
    /// Whether the gap ahead is safe in the sense of RSS.
    Rss,
}

/// A part of the planner that can be made to fail, to see what comes of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A task of the stage.
    Task(TaskName),
    /// A source of a path for a tick whose own failed.
    Path(PathRung),
    /// A source of a speed for a tick whose own failed.
    Speed(SpeedRung),
}

/// What a task is: it reads and extends the plan, and remembers in the context.
pub(super) type Run = fn(&mut LinePlan, &mut Context) -> Result<(), TaskError>;

/// Why a task failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TaskError {
    /// The lane to change to is not free.
    #[error("the lane to change to is not free")]
    LaneChangeNotClear,
    /// There are no bounds.
    #[error(transparent)]
    PathBounds(#[from] PathBoundsError),
    /// No path inside any of the bounds.
    #[error("no bound has a drivable path")]
    NoPath,
    /// No profile through the ST graph.
    #[error(transparent)]
    SpeedHeuristic(#[from] SpeedHeuristicError),
    /// The profile cannot be decided by.
    #[error(transparent)]
    SpeedDecider(#[from] SpeedDeciderError),
    /// An obstacle that can no more be stayed behind without an emergency.
    #[error("obstacle {} cannot be stayed behind without an emergency", .0.0)]
    Unavoidable(ObstacleId),
    /// The optimiser's problem has no solution.
    #[error("no profile keeps the bounds")]
    Infeasible,
    /// The optimiser gave up.
    #[error("the optimiser gave up")]
    NotSolved,
    /// The gap ahead is shorter than RSS asks for, and that is a veto.
    #[error("the gap ahead is shorter than is safe")]
    Unsafe,
    /// A failure asked for from outside, to see what comes of it.
    #[error("failed on request")]
    OnRequest,
}

impl TaskName {
    pub(super) fn run(self) -> Run {
        match self {
            Self::LaneChange => lane_change::run,
            Self::PathReuse => path_reuse::run,
            Self::LaneBorrow => lane_borrow::run,
            Self::PathBounds => path_bounds::run,
            Self::PiecewiseJerkPath => path::run,
            Self::SampledPath => path::run_sampled,
            Self::PathAssessment => path_assessment::run,
            Self::PathDecider => path_decider::run,
            Self::RuleBasedStop => rule_based_stop::run,
            Self::SpeedBoundsPriori => speed_bounds::run_priori,
            Self::SpeedHeuristic => speed_heuristic::run,
            Self::SpeedDecider => speed_decider::run,
            Self::SpeedBoundsFinal => speed_bounds::run_final,
            Self::PiecewiseJerkSpeed => piecewise_jerk_speed::run,
            Self::PiecewiseJerkNonlinearSpeed => piecewise_jerk_speed::run_nonlinear,
            Self::Rss => rss::run,
        }
    }
}

impl fmt::Display for TaskName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}
