//! `[vehicle]`: the ego's body where it differs from the reference sedan.

use super::number::{Acceleration, Braking, Number, Size};
use serde::Deserialize;

/// Overrides of the ego's body. The length is that of its two parts before and behind the rear axle.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Vehicle {
    /// Overall width, m.
    pub width: Option<Number<Size>>,
    /// Rear axle to front bumper, m.
    pub front_edge_to_center: Option<Number<Size>>,
    /// Rear axle to rear bumper, m.
    pub back_edge_to_center: Option<Number<Size>>,
    /// Distance between the axles, m.
    pub wheel_base: Option<Number<Size>>,
    /// Smallest turning radius of the rear axle, m.
    pub min_turn_radius: Option<Number<Size>>,
    /// Largest acceleration of the drive, m/s².
    pub max_acceleration: Option<Number<Acceleration>>,
    /// Hardest braking, m/s², negative.
    pub max_deceleration: Option<Number<Braking>>,
}
