//! Settings of the search; names and values are the original's `DpStSpeedOptimizerConfig`.

use crate::vehicle::VehicleParams;
use serde::{Deserialize, Serialize};

/// Grid, weights and limits of the search.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpeedHeuristicConfig {
    /// Time between two columns, s.
    pub unit_t: f64,
    /// Rows of the dense part of a column.
    pub dense_dimension_s: u32,
    /// Distance between two rows of it, m.
    pub dense_unit_s: f64,
    /// Distance between two rows beyond it, m.
    pub sparse_unit_s: f64,
    /// Weight of nearness to obstacles.
    pub obstacle_weight: f64,
    /// Cost of nearness to obstacles, per m².
    pub default_obstacle_cost: f64,
    /// Unit of the costs of speed.
    pub default_speed_cost: f64,
    /// Of a relative excess over the limit, squared.
    pub exceed_speed_penalty: f64,
    /// Of a relative shortfall below the limit.
    pub low_speed_penalty: f64,
    /// Of a difference to the cruise speed, per m/s.
    pub reference_speed_penalty: f64,
    /// Of standing in a zone to keep clear.
    pub keep_clear_low_speed_penalty: f64,
    /// Of acceleration.
    pub accel_penalty: f64,
    /// Of braking.
    pub decel_penalty: f64,
    /// Of jerk forward.
    pub positive_jerk_coeff: f64,
    /// Of jerk backward.
    pub negative_jerk_coeff: f64,
    /// Largest acceleration, m/s².
    pub max_acceleration: f64,
    /// Hardest braking, m/s², negative.
    pub max_deceleration: f64,
    /// Of each metre that is left at a time.
    pub spatial_potential_penalty: f64,
    /// Distance to an obstacle ahead that costs nothing, m.
    pub safe_distance: f64,
    /// Distance to an obstacle behind that costs nothing, m (the original's safe overtaking gap).
    pub safe_overtaking_gap: f64,
    /// Fastest speed at which a predecessor is looked for, m/s (the original's `planning_upper_speed_limit`).
    pub upper_speed_limit: f64,
}

impl Default for SpeedHeuristicConfig {
    /// Along the ego's own lane.
    fn default() -> Self {
        Self {
            unit_t: 1.0,
            dense_dimension_s: 101,
            dense_unit_s: 0.1,
            sparse_unit_s: 1.0,
            obstacle_weight: 1.0,
            default_obstacle_cost: 1e4,
            default_speed_cost: 1e3,
            exceed_speed_penalty: 1e3,
            low_speed_penalty: 10.0,
            reference_speed_penalty: 10.0,
            keep_clear_low_speed_penalty: 10.0,
            accel_penalty: 1.0,
            decel_penalty: 1.0,
            positive_jerk_coeff: 1.0,
            negative_jerk_coeff: 1.0,
            max_acceleration: 2.0,
            max_deceleration: -4.0,
            spatial_potential_penalty: 1e2,
            safe_distance: 20.0,
            safe_overtaking_gap: 20.0,
            upper_speed_limit: 31.3,
        }
    }
}

impl SpeedHeuristicConfig {
    /// Along a line into another lane: coarser, gentler, and in more of a hurry.
    pub fn lane_change() -> Self {
        Self {
            dense_dimension_s: 21,
            dense_unit_s: 0.25,
            max_deceleration: -2.5,
            spatial_potential_penalty: 1e5,
            ..Self::default()
        }
    }

    /// Hardest braking and largest acceleration that both these settings and a vehicle allow, m/s².
    pub(super) fn acceleration_range(&self, vehicle: &VehicleParams) -> (f64, f64) {
        let braking = vehicle.max_deceleration.abs().min(self.max_deceleration.abs());
        (
            -braking,
            vehicle.max_acceleration.abs().min(self.max_acceleration),
        )
    }
}
