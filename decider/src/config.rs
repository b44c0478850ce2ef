//! Every knob of the decider. Names in `path_bounds` are the original's.

use crate::lane_follow_map::{LaneFollowConfig, LaneFollowQuirks};
use crate::tasks::lane_borrow::LaneBorrowConfig;
use crate::tasks::path::PathConfig;
use crate::tasks::path_bounds::PathBoundsConfig;
use crate::tasks::speed::SpeedConfig;
use serde::{Deserialize, Serialize};

/// Settings of all tasks.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Config {
    /// Path bounds, quirks included.
    pub path_bounds: PathBoundsConfig,
    /// Borrowing a neighbouring lane.
    pub lane_borrow: LaneBorrowConfig,
    /// Sampling and assessing paths.
    pub path: PathConfig,
    /// Speed along a path.
    pub speed: SpeedConfig,
    /// How far the lines along a route reach.
    pub lane_follow: LaneFollowConfig,
}

impl Config {
    /// The original as shipped, defects included.
    pub fn apollo() -> Self {
        Self {
            path_bounds: PathBoundsConfig::apollo(),
            lane_borrow: LaneBorrowConfig::apollo(),
            path: PathConfig {
                corner_collision_check: true,
                ..PathConfig::default()
            },
            lane_follow: LaneFollowConfig {
                quirks: LaneFollowQuirks::apollo(),
                ..LaneFollowConfig::default()
            },
            ..Self::default()
        }
    }
}
