//! Settings of everything that has to do with speed.

use crate::piecewise_jerk::SpeedWeights;
use serde::{Deserialize, Serialize};

/// Settings of the speed layer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpeedConfig {
    /// Comfortable acceleration, m/s².
    pub acceleration: f64,
    /// Comfortable braking, m/s², positive.
    pub braking: f64,
    /// Braking that is still planned for, m/s², positive: beyond it is an emergency.
    pub hard_braking: f64,
    /// Comfortable jerk, m/s³.
    pub jerk: f64,
    /// Jerk of an emergency, m/s³.
    pub emergency_jerk: f64,
    /// Lateral acceleration in bends, m/s².
    pub lateral_acceleration: f64,
    /// Gap to something that blocks the path, m (the original's `min_stop_distance_obstacle`).
    pub stop_distance: f64,
    /// The same where it may be passed through another lane: a car that cannot reverse needs the room.
    pub pull_out_distance: f64,
    /// Least such gap where the car came upon it late, m.
    pub least_stop_distance: f64,
    /// Gap to a leader at standstill, m.
    pub follow_distance: f64,
    /// Time gap to a leader, s.
    pub follow_time: f64,
    /// Room beside the path within which a moving obstacle claims it, m.
    pub lateral_margin: f64,
    /// Time that has to lie between the ego's and a crossing obstacle's use of the same place, s.
    pub yield_time: f64,
    /// Share of the cruise speed driven while waiting for a gap in the lane to change to.
    pub gap_seeking_share: f64,
    /// How far ahead the speed is planned, s.
    pub total_time: f64,
    /// What the optimiser's departing from its guide, and its jerk, cost.
    pub weights: SpeedWeights,
    /// Fastest change of acceleration that is planned for, m/s³.
    pub planned_jerk: f64,
    /// Whether an unsafe gap in the sense of RSS makes the tick fall back.
    pub enable_rss_fallback: bool,
    /// How far before its place a pull-over stops, m: within the tolerance, on its near side.
    pub pull_over_early: f64,
}

impl Default for SpeedConfig {
    fn default() -> Self {
        Self {
            acceleration: 1.8,
            braking: 2.0,
            hard_braking: 3.5,
            jerk: 3.0,
            emergency_jerk: 20.0,
            lateral_acceleration: 2.5,
            stop_distance: 6.0,
            pull_out_distance: 9.0,
            least_stop_distance: 1.5,
            follow_distance: 4.0,
            follow_time: 1.4,
            lateral_margin: 0.3,
            yield_time: 1.5,
            gap_seeking_share: 0.85,
            total_time: 7.0,
            weights: SpeedWeights {
                kappa_penalty: 0.0,
                ..SpeedWeights::default()
            },
            planned_jerk: 4.0,
            enable_rss_fallback: false,
            pull_over_early: 0.25,
        }
    }
}
