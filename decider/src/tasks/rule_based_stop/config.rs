//! Settings of the stops by rule; names are the original's where it has them.

use crate::tasks::lane_change::perception::Fan;
use serde::{Deserialize, Serialize};

/// Settings of the rule-based stop decider.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RuleBasedStopConfig {
    /// Whether the car stops and looks before it goes out into the lane of oncoming traffic, where something hides
    /// that. Off: here nothing hides anything from the perception, and whether traffic leaves time is asked anyway.
    pub enable_side_pass_stop: bool,
    /// Not faster than this the car has stopped, m/s.
    pub max_adc_stop_speed: f64,
    /// Not farther than this before the place it has stopped there, m.
    pub max_valid_stop_distance: f64,
    /// Length of the beams of the look, m.
    pub search_beam_length: f64,
    /// Angle between two of them, rad.
    pub search_beam_radius_intensity: f64,
    /// Angle of all of them, rad.
    pub search_range: f64,
    /// What takes a wider angle hides the lane, rad.
    pub is_block_angle_threshold: f64,
    /// Whether the car waits well before the end of a lane that it has to leave.
    pub enable_lane_change_urgency_check: bool,
    /// From this far before its end on, m.
    pub approach_distance_for_lane_change: f64,
    /// This far before its end, m.
    pub urgent_distance_for_lane_change: f64,
}

impl Default for RuleBasedStopConfig {
    fn default() -> Self {
        let fan = Fan::default();
        Self {
            enable_side_pass_stop: false,
            max_adc_stop_speed: 0.5,
            max_valid_stop_distance: 1.0,
            search_beam_length: fan.length,
            search_beam_radius_intensity: fan.step,
            search_range: fan.range,
            is_block_angle_threshold: fan.threshold,
            enable_lane_change_urgency_check: false,
            approach_distance_for_lane_change: 80.0,
            urgent_distance_for_lane_change: 50.0,
        }
    }
}

impl RuleBasedStopConfig {
    /// The original as shipped.
    pub fn apollo() -> Self {
        Self {
            enable_side_pass_stop: true,
            ..Self::default()
        }
    }

    /// The beams of the look.
    pub(super) fn fan(&self) -> Fan {
        Fan {
            length: self.search_beam_length,
            step: self.search_beam_radius_intensity,
            range: self.search_range,
            threshold: self.is_block_angle_threshold,
        }
    }
}
