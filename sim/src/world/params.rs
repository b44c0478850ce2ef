//! What the physics needs to know beyond the vehicle's dimensions. SI units.

use corridor_decider::vehicle::VehicleParams;
use serde::{Deserialize, Serialize};

/// Standard gravity, m/s².
pub const GRAVITY: f64 = 9.806_65;

/// Settings of the world.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PhysicsConfig {
    /// Length of one physics step, s.
    pub dt: f64,
    /// The ego's dynamics.
    pub dynamics: DynamicsParams,
}

impl Default for PhysicsConfig {
    fn default() -> Self {
        Self {
            dt: 0.01,
            dynamics: DynamicsParams::default(),
        }
    }
}

/// How the ego's body, tyres and actuators behave. Defaults: a mid-size sedan that understeers gently.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DynamicsParams {
    /// Mass, kg.
    pub mass: f64,
    /// Yaw inertia about the centre of mass, kg m².
    pub yaw_inertia: f64,
    /// Rear axle to centre of mass, m, forward positive.
    pub center_of_mass: f64,
    /// Cornering stiffness of the front axle, both tyres, N/rad.
    pub front_stiffness: f64,
    /// Cornering stiffness of the rear axle, both tyres, N/rad.
    pub rear_stiffness: f64,
    /// Friction coefficient between tyres and road.
    pub friction: f64,
    /// Time constant of the drive, s.
    pub drive_lag: f64,
    /// Time constant of the brakes, s.
    pub brake_lag: f64,
    /// Time constant of the steering, s.
    pub steer_lag: f64,
    /// Fastest change of the acceleration, m/s³.
    pub jerk_limit: f64,
}

impl Default for DynamicsParams {
    fn default() -> Self {
        Self {
            mass: 2000.0,
            yaw_inertia: 3200.0,
            center_of_mass: 1.4,
            // With these two a steady turn at 1 m/s² needs 0.0022 rad more than the geometry says (1.2° per g).
            front_stiffness: 110_000.0,
            rear_stiffness: 150_000.0,
            friction: 0.9,
            drive_lag: 0.2,
            brake_lag: 0.1,
            steer_lag: 0.06,
            // Full braking builds up within 0.3 s, as brake assistants do.
            jerk_limit: 20.0,
        }
    }
}

impl DynamicsParams {
    /// Vertical load of the (front, rear) axle at rest, N. Load transfer is left out.
    pub fn axle_loads(&self, vehicle: &VehicleParams) -> (f64, f64) {
        let weight = self.mass * GRAVITY;
        let front = weight * self.center_of_mass / vehicle.wheel_base;
        (front, weight - front)
    }

    /// Extra road-wheel angle that a steady turn needs per lateral acceleration, rad/(m/s²); positive:
    /// understeer. The linear single-track model: `m/L · (l_r/C_f − l_f/C_r)`.
    pub fn understeer_gradient(&self, vehicle: &VehicleParams) -> f64 {
        let (front, rear) = self.axle_loads(vehicle);
        (front / self.front_stiffness - rear / self.rear_stiffness) / GRAVITY
    }

    /// Slip angle of the rear axle in a steady turn per lateral acceleration, rad/(m/s²).
    pub fn rear_slip_gradient(&self, vehicle: &VehicleParams) -> f64 {
        self.axle_loads(vehicle).1 / self.rear_stiffness / GRAVITY
    }
}
