//! A tick that cannot be planned at all: no place, no line, or a standing car inside an obstacle.
//!
//! The original publishes the car's own pose thirty times over, a target that stands still at 15 m/s, or an empty
//! trajectory. Here the car stops along the trajectory of the tick before; where there is none it brakes as hard as
//! it can with its wheels as they are. Only a car that stands is told to stay where it is.

use super::{BrakingLimits, braking_profile, held_arc, speed};
use crate::context::{Context, LastTrajectory};
use crate::decision::{ContextFailure, Decision, FallbackCause, Outcome, SpeedRung, TrajectoryPoint};
use crate::frame::Frame;
use crate::geometry::{Pose, angle};
use crate::quirks::Quirks;
use crate::tasks::start_point::{StartPoint, at_time, is_near};
use crate::trajectory;
use crate::vehicle::VehicleParams;

/// Longest time that a car may drive blind along an old trajectory, s.
const MAX_BLIND_TIME: f64 = 1.5;

/// An older trajectory is not followed, s.
const MAX_AGE: f64 = 0.5;

/// No car is faster than this, brakes, or turns faster, m/s, m/s² and rad/s: who says so does not know.
const PLAUSIBLE: f64 = 100.0;

/// How far ahead a car that stands is told to stay, s.
const HOLD_TIME: f64 = 3.0;

/// Slower than this an overlap with an obstacle is a state and no accident under way, m/s (the original's 1e-3).
const STANDS: f64 = 1e-3;

/// What keeps a frame from being planned, if anything does.
pub fn context_failure(frame: &Frame, start: &StartPoint, vehicle: &VehicleParams) -> Option<ContextFailure> {
    let ego = &frame.ego;
    let place = [ego.pose.x, ego.pose.y, ego.pose.theta];
    let motion = [ego.v, ego.a, ego.yaw_rate];
    let is_known = place.iter().all(|number| number.is_finite())
        && motion.iter().all(|number| number.abs() <= PLAUSIBLE);
    if !is_known {
        return Some(ContextFailure::NoLocalisation);
    }
    if frame.lines.is_empty() {
        return Some(ContextFailure::NoReferenceLine);
    }
    if ego.v.abs() >= STANDS || start.v >= STANDS {
        return None;
    }
    let body = vehicle.footprint(ego.pose);
    let overlapped = frame
        .obstacles
        .iter()
        .find(|obstacle| obstacle.footprint().overlaps(&body));
    overlapped.map(|obstacle| ContextFailure::Overlap(obstacle.id))
}

/// What is driven instead.
pub fn without_context(
    frame: &Frame,
    failure: ContextFailure,
    context: &mut Context,
    vehicle: &VehicleParams,
    quirks: &Quirks,
) -> Decision {
    let since = *context.blind_since.get_or_insert(frame.time);
    let last = context
        .last
        .as_ref()
        .filter(|last| frame.time - last.time <= MAX_AGE && frame.time - since <= MAX_BLIND_TIME);
    let cause = FallbackCause::Context(failure);
    let known = failure != ContextFailure::NoLocalisation;
    let stands = frame.ego.v.abs() <= vehicle.max_abs_speed_when_stopped;
    if known && (stands || quirks.frozen_pose) {
        return Decision::without_path(Outcome::Hold, cause, None, hold(frame.ego.pose));
    }
    if let Some((rung, trajectory)) = last.and_then(|last| stop_along(last, frame, known, vehicle)) {
        return Decision::without_path(Outcome::BlindStop, cause, Some(rung), trajectory);
    }
    let trajectory = if known {
        brake_on_arc(&StartPoint::measured(frame), vehicle)
    } else {
        Vec::new()
    };
    Decision::without_path(Outcome::EmergencyStop, cause, None, trajectory)
}

/// The end of the chain: as hard as it can, the wheels as they are.
pub(crate) fn brake_on_arc(start: &StartPoint, vehicle: &VehicleParams) -> Vec<TrajectoryPoint> {
    let limits = BrakingLimits::EMERGENCY.with_max_deceleration(vehicle.max_deceleration);
    let profile = braking_profile(start.v, start.a, limits);
    trajectory::on(&profile, |distance| {
        (held_arc::pose(start, distance), start.kappa)
    })
}

/// A car that stands, standing.
fn hold(pose: Pose) -> Vec<TrajectoryPoint> {
    let standing = |t: f64| TrajectoryPoint {
        t,
        distance: 0.0,
        pose,
        kappa: 0.0,
        v: 0.0,
        a: 0.0,
    };
    [0.0, HOLD_TIME].map(standing).to_vec()
}

/// A stop on what is left of the last trajectory, from the motion that is measured or, failing that, planned.
fn stop_along(
    last: &LastTrajectory,
    frame: &Frame,
    is_localised: bool,
    vehicle: &VehicleParams,
) -> Option<(SpeedRung, Vec<TrajectoryPoint>)> {
    let now = at_time(&last.points, frame.time - last.time)?;
    if is_localised && !is_near(&now, frame) {
        return None;
    }
    let planned = StartPoint {
        pose: now.pose,
        kappa: now.kappa,
        v: now.v,
        a: now.a,
    };
    let start = if is_localised {
        StartPoint::measured(frame)
    } else {
        planned
    };
    let (rung, profile) = speed::stopping(&start, vehicle, None, &|_| false);
    let at = |distance| along(&last.points, now.distance + distance);
    Some((rung, trajectory::on(&profile, at)))
}

/// Pose and curvature at a distance along a trajectory; its end goes on straight.
fn along(points: &[TrajectoryPoint], distance: f64) -> (Pose, f64) {
    let above = points.partition_point(|p| p.distance <= distance);
    let Some(a) = above.checked_sub(1).map(|k| points[k]) else {
        return (points[0].pose, points[0].kappa);
    };
    let Some(b) = points.get(above) else {
        return (a.pose.advanced(distance - a.distance), 0.0);
    };
    let share = (distance - a.distance) / (b.distance - a.distance);
    let at = a.pose.position() + (b.pose.position() - a.pose.position()) * share;
    let turn = angle::difference(b.pose.theta, a.pose.theta);
    let theta = angle::wrap(a.pose.theta + turn * share);
    (
        Pose::new(at.x, at.y, theta),
        a.kappa + (b.kappa - a.kappa) * share,
    )
}
