//! The knobs of route following, and the original's defects.

use serde::{Deserialize, Serialize};

/// How far to look, and when a car has been moved rather than driven.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LaneFollowConfig {
    /// How far behind the car its lanes begin, m (`look_backward_distance`).
    pub look_back: f64,
    /// How far ahead of a slow car its lanes reach, m (`look_forward_short_distance`).
    pub look_ahead_short: f64,
    /// How far ahead of a fast car its lanes reach, m (`look_forward_long_distance`).
    pub look_ahead_long: f64,
    /// A car is fast when it drives further than the short distance in this time, s (`look_forward_time_sec`).
    pub look_ahead_time: f64,
    /// A car further than this from where it was a tick ago has been moved, m
    /// (`replan_lateral_distance_threshold` and `replan_longitudinal_distance_threshold`, together).
    pub jump_distance: f64,
    /// Defects of the original.
    pub quirks: LaneFollowQuirks,
}

impl Default for LaneFollowConfig {
    fn default() -> Self {
        Self {
            look_back: 50.0,
            look_ahead_short: 180.0,
            look_ahead_long: 250.0,
            look_ahead_time: 8.0,
            jump_distance: 0.5 + 2.5,
            quirks: LaneFollowQuirks::default(),
        }
    }
}

impl LaneFollowConfig {
    /// How far ahead of a car at `speed` (m/s) its lanes reach, m.
    pub fn look_ahead(&self, speed: f64) -> f64 {
        if speed * self.look_ahead_time > self.look_ahead_short {
            self.look_ahead_long
        } else {
            self.look_ahead_short
        }
    }
}

/// Defects of the original that can be switched on one by one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LaneFollowQuirks {
    /// A waypoint that is not on the route hides all later ones.
    pub lost_waypoint_hides_later_ones: bool,
    /// Once the destination is next to pass it stays so, even for a car that rolls back before another waypoint.
    pub destination_stays_next: bool,
    /// The first lane segment of the route is not preferred among the lanes that lead to another.
    pub first_entry_precedes_nothing: bool,
}

impl LaneFollowQuirks {
    /// All of them, as in the original.
    pub fn apollo() -> Self {
        Self {
            lost_waypoint_hides_later_ones: true,
            destination_stays_next: true,
            first_entry_precedes_nothing: true,
        }
    }
}
