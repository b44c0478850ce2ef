//! Settings of the routing, with the original's names and defaults (`routing_config.pb.txt`).

use serde::{Deserialize, Serialize};

/// From this heading change on a lane through a junction is a turn, rad: 45°.
const TURN: f64 = std::f64::consts::FRAC_PI_4;

/// From this heading change on it is a U-turn, rad: 150°.
const U_TURN: f64 = std::f64::consts::PI * 5.0 / 6.0;

/// What driving costs, in metres at the base speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RoutingConfig {
    /// Speed at which a metre costs 1, m/s; faster lanes cost less.
    pub base_speed: f64,
    /// Cost of a left turn.
    pub left_turn_penalty: f64,
    /// Cost of a right turn.
    pub right_turn_penalty: f64,
    /// Cost of a U-turn.
    pub uturn_penalty: f64,
    /// Cost of a change of lane.
    pub change_penalty: f64,
    /// Crossable length below which a change costs more, m.
    pub base_changing_length: f64,
    /// Least length over which a change is possible at all, m.
    pub min_length_for_lane_change: f64,
}

impl Default for RoutingConfig {
    fn default() -> Self {
        Self {
            base_speed: 4.167,
            left_turn_penalty: 50.0,
            right_turn_penalty: 20.0,
            uturn_penalty: 100.0,
            change_penalty: 500.0,
            base_changing_length: 50.0,
            min_length_for_lane_change: 1.0,
        }
    }
}

impl RoutingConfig {
    /// Cost of a metre of a lane with this speed limit (infinite: none known).
    pub(super) fn rate(&self, speed_limit: f64) -> f64 {
        if speed_limit.is_finite() && speed_limit >= self.base_speed {
            (self.base_speed / speed_limit).sqrt()
        } else {
            1.0
        }
    }

    /// Cost of a change over a crossable length: dearer where there is little room for it.
    pub(super) fn change_cost(&self, crossable: f64) -> f64 {
        let share = (crossable / self.base_changing_length).min(1.0);
        self.change_penalty / (share * share.sqrt())
    }

    /// Cost of turning by an angle, left positive.
    pub(super) fn turn_penalty(&self, turned: f64) -> f64 {
        if turned.abs() >= U_TURN {
            self.uturn_penalty
        } else if turned >= TURN {
            self.left_turn_penalty
        } else if turned <= -TURN {
            self.right_turn_penalty
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_are_those_of_the_original() {
        let config = RoutingConfig::default();
        assert!((config.rate(4.167 * 4.0) - 0.5).abs() < 1e-12);
        assert!((config.rate(2.0) - 1.0).abs() < 1e-12);
        assert!((config.rate(f64::INFINITY) - 1.0).abs() < 1e-12);
        assert!((config.change_cost(80.0) - 500.0).abs() < 1e-12);
        // 500 · (12.5 / 50)^-1.5
        assert!((config.change_cost(12.5) - 4000.0).abs() < 1e-9);
    }
}
