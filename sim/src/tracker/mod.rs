//! The tracker: from a trajectory to steering and acceleration, at the rate of the physics.
//!
//! Lateral: curvature feed-forward with the understeer of the linear single-track model, plus feedback of lateral
//! and heading error that is laid out over distance, so it asks nothing at standstill. Longitudinal:
//! acceleration feed-forward ahead by the actuators' lag, plus feedback of speed and station. Everything at the
//! rear axle. A pure function: the same state and trajectory give the same controls.

mod config;
mod foot;
mod perfect;
#[cfg(test)]
mod tests;

pub use config::TrackerConfig;
pub(crate) use perfect::perfect;

use crate::trace::Controls;
use corridor_decider::decision::TrajectoryPoint;
use corridor_decider::frame::EgoState;
use corridor_decider::geometry::angle;
use corridor_decider::vehicle::VehicleParams;
use foot::{Foot, Moment};

/// Below this speed a trajectory means to stand, m/s.
const STANDING: f64 = 0.05;

/// Braking of the last centimetres, m/s²: what the wheels lose at once when they stand.
const SETTLING: f64 = 0.3;

/// Slower than this the wheels stand, m/s.
const AT_REST: f64 = 1e-3;

/// How far ahead a trajectory must stay at rest for the brakes to be held, s.
const HOLD_PREVIEW: f64 = 0.5;

/// The last metres and the last speed before a stop, m and m/s, in which the trajectory is followed by the place and
/// no more by the clock: only the place counts there.
const FINAL_DISTANCE: f64 = 3.0;
const FINAL_SPEED: f64 = 2.5;

/// Gentler than this nobody brakes for the final metres, m/s²: the car rolls on as the trajectory says.
const GENTLEST_STOP: f64 = 0.2;

/// Shortest distance that is left to stop in, m, so that the braking asked for stays finite.
const NO_DISTANCE: f64 = 0.01;

/// Braking times way left over speed squared: for constant braking, and for braking that fades linearly in time to
/// nothing at the stop.
const SHAPES: (f64, f64) = (1.0 / 2.0, 2.0 / 3.0);

/// Follows trajectories.
#[derive(Clone, Copy, Debug)]
pub struct Tracker {
    vehicle: VehicleParams,
    config: TrackerConfig,
}

impl Tracker {
    /// A tracker for one car.
    pub fn new(vehicle: VehicleParams, config: TrackerConfig) -> Self {
        Self { vehicle, config }
    }

    /// Controls for the ego as it is now, `time_since_frame` seconds after the trajectory's time 0.
    ///
    /// Without a trajectory: full braking, the wheels as they are.
    pub fn track(&self, ego: &EgoState, trajectory: &[TrajectoryPoint], time_since_frame: f64) -> Controls {
        if trajectory.is_empty() {
            return Controls {
                steer: ego.steer,
                acceleration: self.vehicle.max_deceleration,
            };
        }
        let now = Moment::at(trajectory, time_since_frame);
        if stands(trajectory, now, time_since_frame) && ego.v.abs() <= STANDING {
            return Controls {
                steer: ego.steer,
                acceleration: if ego.v.abs() <= AT_REST {
                    -self.config.hold_brake
                } else {
                    -SETTLING
                },
            };
        }
        let foot = Foot::of(trajectory, ego.pose, now.index);
        Controls {
            steer: self.steer(ego, trajectory, &foot),
            acceleration: self.accelerate(ego, trajectory, &foot, now, time_since_frame),
        }
    }

    /// Road-wheel angle, rad.
    fn steer(&self, ego: &EgoState, trajectory: &[TrajectoryPoint], foot: &Foot) -> f64 {
        let config = &self.config;
        let v_squared = ego.v * ego.v;
        let preview = foot.kappa_ahead(trajectory, ego.v.max(0.0) * config.steer_preview);
        // In a steady turn the rear tyres slip, so the car points further into the bend than it goes.
        let slip = config.rear_slip_gradient * v_squared * foot.kappa;
        let heading_error = angle::difference(ego.pose.theta, foot.theta + slip);
        let lambda = (config.feedback_time * ego.v).max(config.feedback_distance);
        let reach = 2.0 * lambda * config.max_approach;
        let lateral_error = foot.l.clamp(-reach, reach);
        let feedback = lateral_error / (lambda * lambda) + 2.0 / lambda * heading_error;
        let kappa = preview - feedback;
        libm::atan(self.vehicle.wheel_base * kappa) + config.understeer_gradient * v_squared * kappa
    }

    /// Acceleration, m/s².
    fn accelerate(
        &self,
        ego: &EgoState,
        trajectory: &[TrajectoryPoint],
        foot: &Foot,
        now: Moment,
        time: f64,
    ) -> f64 {
        let config = &self.config;
        if let Some(braking) = final_braking(ego, trajectory, foot) {
            return braking.max(self.vehicle.max_deceleration);
        }
        let ahead = Moment::at(trajectory, time + config.acceleration_preview);
        let limit = config.max_station_error;
        let behind = (now.distance - foot.distance).clamp(-limit, limit);
        let feedback = config.speed_gain * (now.v - ego.v) + config.station_gain * behind;
        (ahead.a + feedback).clamp(self.vehicle.max_deceleration, self.vehicle.max_acceleration)
    }
}

/// Whether the trajectory wants the car to stand now and for a while.
fn stands(trajectory: &[TrajectoryPoint], now: Moment, time: f64) -> bool {
    let soon = Moment::at(trajectory, time + HOLD_PREVIEW);
    now.v <= STANDING && soon.v <= STANDING
}

/// Where the trajectory ends at rest and near: the braking that stops the car there, m/s², in the shape that the
/// trajectory's own braking has from here on.
fn final_braking(ego: &EgoState, trajectory: &[TrajectoryPoint], foot: &Foot) -> Option<f64> {
    let last = trajectory.last()?;
    let left = last.distance - foot.distance;
    if last.v > STANDING || left > FINAL_DISTANCE || ego.v > FINAL_SPEED {
        return None;
    }
    let (v, a) = foot.motion(trajectory);
    let shape = if v > STANDING {
        (-a * left / (v * v)).clamp(SHAPES.0, SHAPES.1)
    } else {
        SHAPES.0
    };
    let needed = shape * ego.v * ego.v / left.max(NO_DISTANCE);
    (needed >= GENTLEST_STOP || left <= 0.0).then_some(-needed.max(GENTLEST_STOP))
}
