//! The station–time picture of what lies on a path: boundaries of obstacles, speed limits and speed profiles.
//!
//! `t` counts seconds from the planning start, `s` metres along the chosen path from its first point, for the
//! centre of the rear axle: a boundary at `s` says where the ego's own reference point may not be. Values and traps are
//! those of the original's `STBoundary`, `SpeedLimit`, `SpeedData` and `StGraphData`; what aborts the original is an
//! error here, and there is no empty boundary: what would be one is `None`.

mod boundary;
mod overlap;
mod queries;
mod speed_data;
mod speed_limit;
#[cfg(test)]
mod tests;

pub use boundary::{BoundaryType, StBoundary, StBoundaryError, StPair};
pub use queries::SRange;
pub use speed_data::{SpeedData, SpeedPoint};
pub use speed_limit::{SpeedLimit, SpeedLimitError};

use serde::{Deserialize, Serialize};

/// Nothing farther than this along the path matters to the speed, m (the original's `speed_lon_decision_horizon`).
pub const S_HORIZON: f64 = 200.0;

/// A point of the graph.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StPoint {
    /// Time, s.
    pub t: f64,
    /// Distance along the path, m.
    pub s: f64,
}

impl StPoint {
    /// A point from its two numbers.
    pub const fn new(t: f64, s: f64) -> Self {
        Self { t, s }
    }
}

/// Twice the signed area of the triangle `origin`, `a`, `b` in the plane `(t, s)`: positive when `b` lies to the left.
pub fn cross(origin: StPoint, a: StPoint, b: StPoint) -> f64 {
    (a.t - origin.t) * (b.s - origin.s) - (a.s - origin.s) * (b.t - origin.t)
}

/// Speed to drive where the task names none, m/s (the original's `default_cruise_speed`).
const DEFAULT_CRUISE_SPEED: f64 = 5.0;

/// An obstacle on the path.
#[derive(Clone, Debug, PartialEq)]
pub struct StObstacle {
    /// What it occupies.
    pub boundary: StBoundary,
    /// Whether distance is kept to it beyond not touching it: so it is with bodies for which no stop has been
    /// decided; fences and zones, and what one stops for, have their distance in their boundary.
    pub repels: bool,
}

/// What the speed along a path is planned from.
#[derive(Clone, Debug, PartialEq)]
pub struct StGraphData {
    /// The obstacles on the path, in a stable order.
    pub obstacles: Vec<StObstacle>,
    /// Speed at the start, m/s.
    pub init_v: f64,
    /// Acceleration at the start, m/s².
    pub init_a: f64,
    /// The speed limit along the path.
    pub speed_limit: SpeedLimit,
    /// Speed asked for where nothing limits it, m/s; not positive for none in particular.
    pub cruise_speed: f64,
    /// Length of the path, m.
    pub path_length: f64,
    /// How far ahead the speed is planned, s.
    pub total_time: f64,
}

impl StGraphData {
    /// Speed to drive where nothing limits it, m/s.
    pub fn cruise_speed(&self) -> f64 {
        if self.cruise_speed > 0.0 {
            self.cruise_speed
        } else {
            DEFAULT_CRUISE_SPEED
        }
    }
}
