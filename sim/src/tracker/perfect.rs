//! A tracker without error: where a trajectory has the car at a time.

use super::foot::Moment;
use corridor_decider::decision::TrajectoryPoint;
use corridor_decider::frame::EgoState;
use corridor_decider::geometry::{Pose, angle};
use corridor_decider::vehicle::VehicleParams;

/// The ego `time` seconds after the trajectory's time 0, one step of `dt` seconds after it was as `ego` says.
///
/// Without a trajectory: full braking on the arc that it drives. What is no number moves nothing.
pub(crate) fn perfect(
    ego: &EgoState,
    trajectory: &[TrajectoryPoint],
    time: f64,
    vehicle: &VehicleParams,
    dt: f64,
) -> EgoState {
    if trajectory.is_empty() {
        return braked(ego, vehicle, dt);
    }
    let now = Moment::at(trajectory, time);
    let from = &trajectory[now.index];
    let to = trajectory.get(now.index + 1).unwrap_or(from);
    let span = to.t - from.t;
    let part = if span > 0.0 {
        ((time - from.t) / span).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let way = to.pose.position() - from.pose.position();
    let place = from.pose.position() + way * part;
    let turn = angle::difference(to.pose.theta, from.pose.theta);
    let kappa = from.kappa + (to.kappa - from.kappa) * part;
    let there = EgoState {
        pose: Pose::new(place.x, place.y, angle::wrap(from.pose.theta + turn * part)),
        v: now.v,
        a: now.a,
        yaw_rate: now.v * kappa,
        steer: libm::atan(vehicle.wheel_base * kappa),
    };
    let numbers = [
        there.pose.x,
        there.pose.y,
        there.pose.theta,
        there.v,
        there.a,
        kappa,
    ];
    if numbers.iter().all(|number| number.is_finite()) {
        there
    } else {
        *ego
    }
}

/// The ego after one step of full braking, the wheels as they are.
fn braked(ego: &EgoState, vehicle: &VehicleParams, dt: f64) -> EgoState {
    let v = (ego.v + vehicle.max_deceleration * dt).max(0.0);
    let kappa = libm::tan(ego.steer) / vehicle.wheel_base;
    let way = f64::midpoint(ego.v, v) * dt;
    let halfway = Pose::new(ego.pose.x, ego.pose.y, ego.pose.theta + kappa * way / 2.0);
    let place = halfway.advanced(way);
    EgoState {
        pose: Pose::new(place.x, place.y, angle::wrap(ego.pose.theta + kappa * way)),
        v,
        a: (v - ego.v) / dt,
        yaw_rate: v * kappa,
        steer: ego.steer,
    }
}
