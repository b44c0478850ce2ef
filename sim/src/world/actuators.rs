//! Steering, drive and brakes: how fast what is asked for becomes true.
//!
//! Each actuator is a first-order lag whose rate and range are limited.

use super::params::DynamicsParams;
use crate::trace::Controls;
use corridor_decider::vehicle::VehicleParams;

/// What the actuators do now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Actuators {
    /// Road-wheel angle, rad, left positive.
    pub(super) steer: f64,
    /// Acceleration that drive (positive) or brakes (negative) put on the road, m/s².
    pub(super) acceleration: f64,
    /// What was asked for last.
    target: Controls,
}

impl Actuators {
    /// Wheels straight, pedals free.
    pub(super) fn new() -> Self {
        Self {
            steer: 0.0,
            acceleration: 0.0,
            target: Controls::default(),
        }
    }

    /// Puts the actuators where they are said to be.
    pub(super) fn hold(&mut self, steer: f64, acceleration: f64) {
        (self.steer, self.acceleration) = (steer, acceleration);
    }

    /// Moves the actuators towards `controls` for one step. A command that is not a number is not
    /// understood: the last one stays in force.
    pub(super) fn advance(
        &mut self,
        controls: Controls,
        vehicle: &VehicleParams,
        params: &DynamicsParams,
        dt: f64,
    ) {
        let max_steer = vehicle.max_steer_angle / vehicle.steer_ratio;
        let max_rate = vehicle.max_steer_angle_rate / vehicle.steer_ratio;
        if controls.steer.is_finite() {
            self.target.steer = controls.steer.clamp(-max_steer, max_steer);
        }
        if controls.acceleration.is_finite() {
            self.target.acceleration = controls
                .acceleration
                .clamp(vehicle.max_deceleration, vehicle.max_acceleration);
        }
        self.steer += lag_step(self.target.steer - self.steer, params.steer_lag, max_rate, dt);
        let lag = if self.target.acceleration < self.acceleration {
            params.brake_lag
        } else {
            params.drive_lag
        };
        self.acceleration += lag_step(
            self.target.acceleration - self.acceleration,
            lag,
            params.jerk_limit,
            dt,
        );
    }
}

/// What a lag of time constant `lag` covers of `gap` in one step, at most `max_rate` fast. Implicit Euler:
/// any `lag ≥ 0` is stable and none overshoots.
fn lag_step(gap: f64, lag: f64, max_rate: f64, dt: f64) -> f64 {
    (gap * (dt / (lag + dt))).clamp(-max_rate * dt, max_rate * dt)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(actuators: &mut Actuators, controls: Controls, steps: usize) {
        let (vehicle, params) = (VehicleParams::default(), DynamicsParams::default());
        for _ in 0..steps {
            actuators.advance(controls, &vehicle, &params, 0.01);
        }
    }

    #[test]
    fn the_wheels_turn_at_their_rate_to_their_limit_and_stay() {
        let mut actuators = Actuators::new();
        let far = Controls {
            steer: 9.0,
            acceleration: 0.0,
        };
        run(&mut actuators, far, 50);
        let rate = 8.552_11 / 16.0;
        assert!(
            (actuators.steer - 0.5 * rate).abs() < 0.01 * rate,
            "{}",
            actuators.steer
        );
        run(&mut actuators, far, 500);
        let limit = 8.203_047_484_37 / 16.0;
        assert!(actuators.steer <= limit && limit - actuators.steer < 1e-6);
    }

    #[test]
    fn braking_builds_up_without_breaking_the_jerk_limit() {
        let mut actuators = Actuators::new();
        let mut last = 0.0;
        for _ in 0..200 {
            run(
                &mut actuators,
                Controls {
                    steer: 0.0,
                    acceleration: -60.0,
                },
                1,
            );
            let jerk = (actuators.acceleration - last) / 0.01;
            assert!((-20.0 - 1e-9..=0.0).contains(&jerk), "jerk {jerk}");
            last = actuators.acceleration;
        }
        assert!((last + 6.0).abs() < 1e-6, "full braking is {last}");
    }

    #[test]
    fn a_command_that_is_no_number_changes_nothing() {
        let (mut a, mut b) = (Actuators::new(), Actuators::new());
        let good = Controls {
            steer: 0.2,
            acceleration: 1.0,
        };
        run(&mut a, good, 20);
        run(&mut b, good, 10);
        run(
            &mut b,
            Controls {
                steer: f64::NAN,
                acceleration: f64::INFINITY,
            },
            10,
        );
        assert_eq!(a, b);
    }
}
