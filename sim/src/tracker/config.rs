//! Gains of the tracker and what it believes of the car. SI units.

use crate::world::DynamicsParams;
use corridor_decider::vehicle::VehicleParams;
use serde::{Deserialize, Serialize};

/// How long the car's yaw takes to follow its wheels, s. Measured in the loop: with it neither lane changes at
/// 15 m/s nor bends at 5 m/s are cut or left wide by more than 6 cm.
const YAW_LAG: f64 = 0.11;

/// Settings of the tracker.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TrackerConfig {
    /// Errors decay over this many seconds of driving: shorter is tighter, and nearer to the steering's lag.
    pub feedback_time: f64,
    /// Errors decay over at least this distance, m, however slow the car is.
    pub feedback_distance: f64,
    /// Steepest angle at which a far-off path is approached, rad.
    pub max_approach: f64,
    /// How far ahead the path's curvature is read, s: lag of the steering and of the car's yaw.
    pub steer_preview: f64,
    /// How far ahead the trajectory's acceleration is read, s: lag of drive and brakes.
    pub acceleration_preview: f64,
    /// Acceleration per error in speed, 1/s.
    pub speed_gain: f64,
    /// Acceleration per error in station, 1/s².
    pub station_gain: f64,
    /// Errors in station beyond this count as this, m.
    pub max_station_error: f64,
    /// Braking that holds the car at rest, m/s², positive.
    pub hold_brake: f64,
    /// Extra road-wheel angle per lateral acceleration, rad/(m/s²).
    pub understeer_gradient: f64,
    /// Slip angle of the rear axle per lateral acceleration, rad/(m/s²).
    pub rear_slip_gradient: f64,
}

impl TrackerConfig {
    /// The usual gains for a car whose tyres are known.
    pub fn for_car(vehicle: &VehicleParams, dynamics: &DynamicsParams) -> Self {
        Self {
            feedback_time: 0.5,
            feedback_distance: 3.0,
            max_approach: 0.35,
            steer_preview: dynamics.steer_lag + YAW_LAG,
            acceleration_preview: dynamics.brake_lag,
            speed_gain: 1.2,
            station_gain: 0.4,
            max_station_error: 1.0,
            hold_brake: 1.0,
            understeer_gradient: dynamics.understeer_gradient(vehicle),
            rear_slip_gradient: dynamics.rear_slip_gradient(vehicle),
        }
    }
}

impl Default for TrackerConfig {
    fn default() -> Self {
        Self::for_car(&VehicleParams::default(), &DynamicsParams::default())
    }
}
