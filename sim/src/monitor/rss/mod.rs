//! Safe distances in the sense of Responsibility-Sensitive Safety (Shalev-Shwartz, Shammah, Shashua 2017).
//!
//! Pure formulas for one pair; magnitudes are positive, braking too. The values are those of ad-rss-lib. They are
//! conservative: 0.4 m beside a row of parked cars is not safe by them for a car that drifts at 0.5 m/s. So what comes
//! of them is reported and never a gate.

mod watch;

pub(super) use watch::RssWatch;

use serde::{Deserialize, Serialize};

/// What everyone is supposed to do in danger. SI units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RssProfile {
    /// Time until the ego responds, s.
    pub response_time: f64,
    /// Time until the others do, s.
    pub response_time_others: f64,
    /// Largest acceleration while responding, m/s².
    pub acceleration: f64,
    /// Least braking that everyone does in danger, m/s².
    pub min_braking: f64,
    /// Hardest braking that anyone may do, m/s².
    pub max_braking: f64,
    /// Least braking of who is in the right lane and meets somebody in it, m/s².
    pub min_braking_correct: f64,
    /// Largest lateral acceleration while responding, m/s².
    pub lateral_acceleration: f64,
    /// Least lateral braking that everyone does in danger, m/s².
    pub lateral_braking: f64,
    /// Room that small lateral movements take of each, m.
    pub lateral_fluctuation: f64,
    /// Room on top of the longitudinal distance, m.
    pub margin: f64,
}

impl Default for RssProfile {
    fn default() -> Self {
        Self {
            response_time: 1.0,
            response_time_others: 2.0,
            acceleration: 3.5,
            min_braking: 4.0,
            max_braking: 8.0,
            min_braking_correct: 3.0,
            lateral_acceleration: 0.2,
            lateral_braking: 0.8,
            lateral_fluctuation: 0.1,
            margin: 0.0,
        }
    }
}

impl RssProfile {
    /// Whether every distance is finite: nobody may be without brakes.
    pub fn is_sound(&self) -> bool {
        [
            self.min_braking,
            self.max_braking,
            self.min_braking_correct,
            self.lateral_braking,
        ]
        .into_iter()
        .all(|braking| braking > 0.0)
    }

    /// Safe distance between two that go the same way, m; `v` of the rear and of the front, not negative. `response`
    /// is the rear's.
    pub fn same_direction(&self, rear: f64, front: f64, response: f64) -> f64 {
        let stop = self.way(rear, response, self.min_braking);
        (stop - front * front / (2.0 * self.max_braking)).max(0.0) + self.margin
    }

    /// Safe distance between two that come towards each other, m; both speeds positive, the first in its right lane.
    pub fn opposite_direction(&self, (correct, response): (f64, f64), (other, their): (f64, f64)) -> f64 {
        self.way(correct, response, self.min_braking_correct)
            + self.way(other, their, self.min_braking)
            + self.margin
    }

    /// Way of who accelerates for `response`, then brakes to a stop.
    fn way(&self, v: f64, response: f64, braking: f64) -> f64 {
        let (a, after) = (self.acceleration, v + response * self.acceleration);
        v * response + 0.5 * a * response * response + after * after / (2.0 * braking)
    }

    /// Safe distance to the side, m; velocities to the left positive. Who stands for good has a response of 0 and a
    /// velocity of 0 and goes nowhere.
    pub fn lateral(&self, right: Lateral, left: Lateral) -> f64 {
        // The right one may come to the left, the left one to the right.
        let approach = self.offset(right.v, right.response) + self.offset(-left.v, left.response);
        (approach + self.lateral_fluctuation).max(0.0)
    }

    /// How far one comes that accelerates for `response`, then brakes if it still moves that way.
    fn offset(&self, v: f64, response: f64) -> f64 {
        let a = self.lateral_acceleration;
        let after = v + response * a;
        let drift = v * response + 0.5 * a * response * response;
        let toward = after.max(0.0);
        drift + toward * toward / (2.0 * self.lateral_braking)
    }
}

/// One of two side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lateral {
    /// Velocity to the left, m/s.
    pub v: f64,
    /// Time until it responds, s.
    pub response: f64,
}

#[cfg(test)]
mod tests;
