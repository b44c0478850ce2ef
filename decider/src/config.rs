//! Every knob of the decider. Names in `path_bounds` are the original's.

use crate::lane_follow_map::{LaneFollowConfig, LaneFollowQuirks};
use crate::lattice::LatticeConfig;
use crate::planner::{LANE_FOLLOW, TaskName};
use crate::quirks::Quirks;
use crate::tasks::lane_borrow::LaneBorrowConfig;
use crate::tasks::lane_change::LaneChangeConfig;
use crate::tasks::path::PathConfig;
use crate::tasks::path_bounds::PathBoundsConfig;
use crate::tasks::piecewise_jerk_speed::SpeedConfig;
use crate::tasks::rule_based_stop::RuleBasedStopConfig;
use crate::tasks::speed_heuristic::SpeedHeuristicConfig;
use serde::{Deserialize, Serialize};

/// Which planner decides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PlannerKind {
    /// Path bounds, a path inside one, a speed along it.
    #[default]
    LaneFollow,
    /// Sampled motions along and across the line.
    Lattice,
    /// A baseline: keeps its lane and its speed, sees nothing.
    Blind,
    /// A baseline: keeps its lane, follows what is nearest in its path.
    Idm,
    /// A baseline: the best of several speeds and offsets, by forward simulation.
    PdmClosed,
}

/// Settings of all tasks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Config {
    /// Which planner decides.
    pub planner: PlannerKind,
    /// The lattice planner.
    pub lattice: LatticeConfig,
    /// The tasks of the stage, in the order in which they run.
    pub tasks: Vec<TaskName>,
    /// When lanes are changed.
    pub lane_change: LaneChangeConfig,
    /// Path bounds, quirks included.
    pub path_bounds: PathBoundsConfig,
    /// Borrowing a neighbouring lane.
    pub lane_borrow: LaneBorrowConfig,
    /// Sampling and assessing paths.
    pub path: PathConfig,
    /// Stops by rule.
    pub rule_based_stop: RuleBasedStopConfig,
    /// Speed along a path.
    pub speed: SpeedConfig,
    /// Defects of the original in the pipeline and its fallbacks.
    pub quirks: Quirks,
    /// How far the lines along a route reach.
    pub lane_follow: LaneFollowConfig,
    /// The search over the ST graph along the own lane.
    pub speed_heuristic: SpeedHeuristicConfig,
    /// The same into another lane.
    pub speed_heuristic_lane_change: SpeedHeuristicConfig,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            planner: PlannerKind::default(),
            lattice: LatticeConfig::default(),
            tasks: LANE_FOLLOW.to_vec(),
            lane_change: LaneChangeConfig::default(),
            path_bounds: PathBoundsConfig::default(),
            lane_borrow: LaneBorrowConfig::default(),
            path: PathConfig::default(),
            rule_based_stop: RuleBasedStopConfig::default(),
            speed: SpeedConfig::default(),
            speed_heuristic: SpeedHeuristicConfig::default(),
            speed_heuristic_lane_change: SpeedHeuristicConfig::lane_change(),
            quirks: Quirks::default(),
            lane_follow: LaneFollowConfig::default(),
        }
    }
}

impl Config {
    /// The settings of the search over the ST graph along a line.
    pub fn speed_heuristic(&self, is_change_lane: bool) -> &SpeedHeuristicConfig {
        if is_change_lane {
            &self.speed_heuristic_lane_change
        } else {
            &self.speed_heuristic
        }
    }

    /// The original as shipped, defects included.
    pub fn apollo() -> Self {
        Self {
            path_bounds: PathBoundsConfig::apollo(),
            lane_borrow: LaneBorrowConfig::apollo(),
            path: PathConfig {
                corner_collision_check: true,
                ..PathConfig::default()
            },
            rule_based_stop: RuleBasedStopConfig::apollo(),
            quirks: Quirks::apollo(),
            lane_follow: LaneFollowConfig {
                quirks: LaneFollowQuirks::apollo(),
                ..LaneFollowConfig::default()
            },
            ..Self::default()
        }
    }
}
