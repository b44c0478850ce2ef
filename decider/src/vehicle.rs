//! Dimensions and limits of the ego vehicle.

use crate::geometry::{ConvexPolygon, Pose};
use serde::{Deserialize, Serialize};

/// The ego's body and what its actuators can do. Defaults: the original's reference sedan (MKZ).
///
/// The reference point is the centre of the rear axle, on the ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct VehicleParams {
    /// Overall length, m.
    pub length: f64,
    /// Overall width, m.
    pub width: f64,
    /// Rear axle to front bumper, m.
    pub front_edge_to_center: f64,
    /// Rear axle to rear bumper, m.
    pub back_edge_to_center: f64,
    /// Distance between the axles, m.
    pub wheel_base: f64,
    /// Smallest turning radius of the rear axle, m.
    pub min_turn_radius: f64,
    /// Largest steering-wheel angle to either side, rad.
    pub max_steer_angle: f64,
    /// Largest steering-wheel rate, rad/s.
    pub max_steer_angle_rate: f64,
    /// Steering-wheel angle over road-wheel angle.
    pub steer_ratio: f64,
    /// Largest acceleration of the drive, m/s².
    pub max_acceleration: f64,
    /// Hardest braking, m/s², negative.
    pub max_deceleration: f64,
    /// Below this speed the car counts as stopped, m/s.
    pub max_abs_speed_when_stopped: f64,
}

impl Default for VehicleParams {
    fn default() -> Self {
        Self {
            length: 4.933,
            width: 2.11,
            front_edge_to_center: 3.89,
            back_edge_to_center: 1.043,
            wheel_base: 2.8448,
            min_turn_radius: 5.053_861_471_61,
            max_steer_angle: 8.203_047_484_37,
            max_steer_angle_rate: 8.552_11,
            steer_ratio: 16.0,
            max_acceleration: 2.0,
            max_deceleration: -6.0,
            max_abs_speed_when_stopped: 0.2,
        }
    }
}

impl VehicleParams {
    /// Half the overall width, m.
    pub fn half_width(&self) -> f64 {
        self.width / 2.0
    }

    /// Largest curvature the steering can hold, 1/m: `tan(road-wheel angle) / wheel base`.
    pub fn max_kappa(&self) -> f64 {
        libm::tan(self.max_steer_angle / self.steer_ratio) / self.wheel_base
    }

    /// The ground the body covers with its rear axle at `rear_axle`.
    pub fn footprint(&self, rear_axle: Pose) -> ConvexPolygon {
        ConvexPolygon::rectangle(
            rear_axle,
            self.front_edge_to_center,
            self.back_edge_to_center,
            self.half_width(),
        )
    }

    /// The middle of the body with its rear axle at `rear_axle`.
    pub fn center(&self, rear_axle: Pose) -> Pose {
        rear_axle.advanced((self.front_edge_to_center - self.back_edge_to_center) / 2.0)
    }
}
