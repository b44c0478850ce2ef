//! Knobs of the lattice planner. Names are the original's where it has them.

use serde::{Deserialize, Serialize};

/// What each cost counts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Weights {
    /// Departing from the guide speed, and not getting on.
    pub lon_objective: f64,
    /// Longitudinal jerk.
    pub lon_jerk: f64,
    /// Nearness to obstacles along the line.
    pub lon_collision: f64,
    /// Fast bends.
    pub centripetal_acceleration: f64,
    /// Departing from the line.
    pub lat_offset: f64,
    /// Acceleration across the line.
    pub lat_comfort: f64,
}

impl Default for Weights {
    fn default() -> Self {
        Self {
            lon_objective: 10.0,
            lon_jerk: 1.0,
            lon_collision: 5.0,
            centripetal_acceleration: 1.5,
            lat_offset: 2.0,
            lat_comfort: 10.0,
        }
    }
}

/// Settings of the lattice planner.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LatticeConfig {
    /// Whether the smoothest way past what stands is a lateral curve, too.
    pub lateral_optimization: bool,
    /// What each cost counts.
    pub weights: Weights,
    /// What a line costs that is not the preferred one.
    pub cost_non_priority_reference_line: f64,
    /// The same while the car is asked to change lanes: more than the change costs at any speed, less than braking.
    pub cost_unheeded_command: f64,
}

impl Default for LatticeConfig {
    fn default() -> Self {
        Self {
            lateral_optimization: true,
            weights: Weights::default(),
            cost_non_priority_reference_line: 5.0,
            cost_unheeded_command: 100.0,
        }
    }
}
