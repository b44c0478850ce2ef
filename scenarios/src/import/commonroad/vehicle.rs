//! The ego of CommonRoad scenarios: the benchmark's vehicle 2, a BMW 320i.
//!
//! Goals and gaps of the collection are made for the benchmark's vehicles, which are narrower than this project's
//! own. Size and axles are those of the CommonRoad vehicle models, version 3; steering angle, drive and brakes
//! stay those of the project's car and lie inside the benchmark's limits.

use corridor_decider::vehicle::VehicleParams;

/// Number of the vehicle in the benchmark.
pub const VEHICLE_TYPE: u32 = 2;

/// Overall length, m.
const LENGTH: f64 = 4.508;

/// Overall width, m.
const WIDTH: f64 = 1.610;

/// From the centre of gravity to the front axle, m.
const TO_FRONT_AXLE: f64 = 1.156_195_706_4;

/// From the centre of gravity, which the benchmark takes for the middle of the body, to the rear axle, m.
const TO_REAR_AXLE: f64 = 1.422_717_093_6;

/// Largest rate of the road-wheel angle, rad/s.
const STEERING_RATE: f64 = 0.4;

/// The vehicle.
pub fn vehicle() -> VehicleParams {
    let project = VehicleParams::default();
    let wheel_base = TO_FRONT_AXLE + TO_REAR_AXLE;
    // The same road-wheel angle on a shorter wheel base turns proportionally tighter.
    let min_turn_radius = project.min_turn_radius * wheel_base / project.wheel_base;
    VehicleParams {
        length: LENGTH,
        width: WIDTH,
        front_edge_to_center: LENGTH / 2.0 + TO_REAR_AXLE,
        back_edge_to_center: LENGTH / 2.0 - TO_REAR_AXLE,
        wheel_base,
        min_turn_radius,
        max_steer_angle_rate: STEERING_RATE * project.steer_ratio,
        ..project
    }
}
