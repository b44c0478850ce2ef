//! The car of the reference search: a kinematic single-track model at its limits.
//!
//! State at the rear axle in world axes, SI units. Acceleration takes effect at once and the wheels turn at their
//! largest rate: what the car can do, and nothing that it cannot. Speeds never become negative: backing out of a
//! collision counts for nothing.

use crate::world::GRAVITY;
use corridor_decider::frame::EgoState;
use corridor_decider::geometry::{Pose, Vec2};
use corridor_decider::vehicle::VehicleParams;

/// Largest lateral acceleration, in units of gravity. Together with the hardest braking of 6 m/s² it stays inside the
/// friction circle of a dry road (0.9), and single-track and real cars still agree there.
const LATERAL: f64 = 0.6;

/// Slower than this a yaw rate says nothing about curvature, m/s.
const CREEPING: f64 = 1.0;

/// How much faster than it was, or than it should cruise, the car may get, m/s: to leave a gap behind, not to race.
const FASTER: f64 = 5.0;

/// What the car can do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Largest acceleration, m/s².
    pub acceleration: f64,
    /// Hardest braking, m/s², negative.
    pub braking: f64,
    /// Largest curvature, 1/m.
    pub kappa: f64,
    /// Largest lateral acceleration, m/s².
    pub lateral: f64,
    /// Fastest turn of the road wheels, rad/s.
    pub steer_rate: f64,
    /// Distance between the axles, m.
    pub wheel_base: f64,
    /// Top speed, m/s.
    pub speed: f64,
}

impl Limits {
    /// The limits of a car that starts at one speed and cruises at another.
    pub fn of(vehicle: &VehicleParams, start_speed: f64, cruise_speed: f64) -> Self {
        Self {
            acceleration: vehicle.max_acceleration,
            braking: vehicle.max_deceleration,
            kappa: vehicle.max_kappa(),
            lateral: LATERAL * GRAVITY,
            steer_rate: vehicle.max_steer_angle_rate / vehicle.steer_ratio,
            wheel_base: vehicle.wheel_base,
            speed: start_speed.max(cruise_speed) + FASTER,
        }
    }

    /// Largest curvature at one speed, 1/m.
    pub fn kappa_at(&self, v: f64) -> f64 {
        if v * v * self.kappa <= self.lateral {
            self.kappa
        } else {
            self.lateral / (v * v)
        }
    }

    /// Fastest change of curvature, 1/(m s): the derivative of `tan(wheel angle) / wheel base`.
    pub fn kappa_rate(&self, kappa: f64) -> f64 {
        let tan = self.wheel_base * kappa;
        self.steer_rate * (1.0 + tan * tan) / self.wheel_base
    }
}

/// The car at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarState {
    /// Rear axle.
    pub place: Vec2,
    /// Unit vector along its heading.
    pub forward: Vec2,
    /// Speed, m/s.
    pub v: f64,
    /// Curvature that it drives, 1/m.
    pub kappa: f64,
}

/// What is asked of the car over a while.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command {
    /// Acceleration, m/s².
    pub acceleration: f64,
    /// Curvature to turn the wheels to, 1/m.
    pub kappa: f64,
}

impl CarState {
    /// The car as it was in a run.
    pub fn of(ego: &EgoState, limits: &Limits) -> Self {
        let steered = libm::tan(ego.steer) / limits.wheel_base;
        let kappa = if ego.v > CREEPING {
            ego.yaw_rate / ego.v
        } else {
            steered
        };
        Self {
            place: ego.pose.position(),
            forward: ego.pose.forward(),
            v: ego.v.max(0.0),
            kappa: kappa.clamp(-limits.kappa, limits.kappa),
        }
    }

    /// The pose of its rear axle.
    pub fn pose(&self) -> Pose {
        let theta = libm::atan2(self.forward.y, self.forward.x);
        Pose::new(self.place.x, self.place.y, theta)
    }

    /// The car `dt` seconds later. The curvature goes to the commanded one as fast as the wheels turn and no further
    /// than the speed allows; then an arc at the mean speed.
    #[must_use]
    pub fn advanced(&self, command: Command, limits: &Limits, dt: f64) -> Self {
        let v = (self.v + command.acceleration * dt).clamp(0.0, limits.speed.max(self.v));
        let most = limits.kappa_at(v);
        let turn = limits.kappa_rate(self.kappa) * dt;
        let wanted = command.kappa.clamp(-most, most);
        let kappa = self.kappa + (wanted - self.kappa).clamp(-turn, turn);
        let way = f64::midpoint(self.v, v) * dt;
        // Half the arc's turn: the chord points there. Without a sine: the angles of a step are small.
        let half = turned(self.forward, kappa * way / 2.0);
        Self {
            place: self.place + half * way,
            forward: turned(half, kappa * way / 2.0),
            v,
            kappa,
        }
    }
}

/// A unit vector turned by a small angle, which is exact to its third power; it stays a unit vector.
fn turned(of: Vec2, by: f64) -> Vec2 {
    let h = by / 2.0;
    let scale = 1.0 / (1.0 + h * h);
    let (cos, sin) = ((1.0 - h * h) * scale, 2.0 * h * scale);
    Vec2::new(of.x * cos - of.y * sin, of.x * sin + of.y * cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits() -> Limits {
        Limits::of(&VehicleParams::default(), 10.0, 10.0)
    }

    fn start(v: f64) -> CarState {
        CarState {
            place: Vec2::zeros(),
            forward: Vec2::x(),
            v,
            kappa: 0.0,
        }
    }

    fn drive(mut car: CarState, command: Command, seconds: f64) -> CarState {
        let mut t = 0.0;
        while t < seconds - 1e-9 {
            car = car.advanced(command, &limits(), 0.01);
            t += 0.01;
        }
        car
    }

    #[test]
    fn full_braking_stops_after_v_squared_over_two_a() {
        let brake = Command {
            acceleration: -6.0,
            kappa: 0.0,
        };
        let car = drive(start(12.0), brake, 4.0);
        assert!((car.place.x - 12.0).abs() < 0.01 && car.v == 0.0, "{car:?}");
    }

    #[test]
    fn a_steady_turn_is_a_circle() {
        let mut car = start(5.0);
        car.kappa = 0.1;
        let turn = Command {
            acceleration: 0.0,
            kappa: 0.1,
        };
        let quarter = core::f64::consts::FRAC_PI_2 / 0.1 / 5.0;
        let car = drive(car, turn, (quarter * 100.0).round() / 100.0);
        assert!((car.place - Vec2::new(10.0, 10.0)).norm() < 0.03, "{car:?}");
    }

    #[test]
    fn the_wheels_need_their_time_and_speed_takes_curvature() {
        let left = Command {
            acceleration: 0.0,
            kappa: 1.0,
        };
        let slow = drive(start(2.0), left, 0.5);
        let angle = libm::atan(slow.kappa * limits().wheel_base);
        assert!((angle - 0.5 * limits().steer_rate).abs() < 2e-3, "{angle}");
        let fast = drive(start(20.0), left, 3.0);
        assert!((fast.v * fast.v * fast.kappa - limits().lateral).abs() < 1e-9);
    }
}
