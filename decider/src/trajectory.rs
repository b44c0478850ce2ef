//! Path and speed combined into a trajectory, and whether it is fit to be driven.
//!
//! The original samples a hundredth of a second apart at first; here all points are a tenth apart, as the speed
//! profiles are. A trajectory that a check rejects is never published: the tick falls back.

use crate::decision::{PathPoint, TrajectoryPoint};
use crate::geometry::{Pose, angle};
use crate::planner::LinePlan;
use crate::st_graph::SpeedData;
use crate::tasks::start_point::StartPoint;
use serde::{Deserialize, Serialize};

/// Speeds of a trajectory that is fit, m/s (the original's constraint checker).
const SPEEDS: (f64, f64) = (-0.1, 40.0);

/// How far the first point may be from where planning starts: m, rad, m/s.
const START: (f64, f64, f64) = (0.3, 0.1, 0.5);

/// How much harder than its brakes a car may be asked to brake, m/s².
const BRAKING_TOLERANCE: f64 = 0.5;

/// How much faster than its drive it may be asked to accelerate, m/s²: what a start point measured on a car that still
/// speeds up may have.
const DRIVE_TOLERANCE: f64 = 2.0;

/// How far back rounding may step along a path, m.
const BACK: f64 = 1e-6;

/// What is wrong with a trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, thiserror::Error)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Unfit {
    /// There is no path or no speed to combine.
    #[error("there is no path or no speed")]
    Incomplete,
    /// The path ends before the speed profile does.
    #[error("the path ends before the car stops")]
    PathTooShort,
    /// A number is none.
    #[error("a number is not finite")]
    NotFinite,
    /// Time or distance steps back.
    #[error("time or distance steps back")]
    StepsBack,
    /// It does not begin where the car is.
    #[error("it does not begin where the car is")]
    Apart,
    /// The car cannot do what it asks for.
    #[error("it asks for more than the car can do")]
    BeyondLimits,
}

/// The trajectory of a plan that succeeded.
///
/// # Errors
/// [`Unfit`] if it may not be driven.
pub fn normal(plan: &LinePlan) -> Result<Vec<TrajectoryPoint>, Unfit> {
    let (Some(path), Some(speed)) = (plan.path(), &plan.speed) else {
        return Err(Unfit::Incomplete);
    };
    let points = along(&path.points, speed).ok_or(Unfit::PathTooShort)?;
    let vehicle = plan.scene.vehicle;
    let range = (
        vehicle.max_deceleration - BRAKING_TOLERANCE,
        vehicle.max_acceleration + DRIVE_TOLERANCE,
    );
    check(&points, &plan.scene.start, range)?;
    Ok(points)
}

/// A speed profile along the points of a path; `None` if it leads beyond them.
pub fn along(path: &[PathPoint], speed: &SpeedData) -> Option<Vec<TrajectoryPoint>> {
    let length = path.last()?.distance;
    let fits = path.len() >= 2 && speed.points.iter().all(|point| point.s <= length + BACK);
    fits.then(|| on(speed, |distance| at(path, distance)))
}

/// A speed profile along anything that has a pose and a curvature at a distance.
pub fn on(speed: &SpeedData, at: impl Fn(f64) -> (Pose, f64)) -> Vec<TrajectoryPoint> {
    let point = |p: &crate::st_graph::SpeedPoint| {
        let (pose, kappa) = at(p.s);
        TrajectoryPoint {
            t: p.t,
            distance: p.s,
            pose,
            kappa,
            v: p.v,
            a: p.a,
        }
    };
    speed.points.iter().map(point).collect()
}

/// Pose and curvature at a distance along a path of two or more points, linear between them; an end goes on straight.
pub fn at(path: &[PathPoint], distance: f64) -> (Pose, f64) {
    let above = path
        .partition_point(|p| p.distance <= distance)
        .clamp(1, path.len() - 1);
    let (a, b) = (&path[above - 1], &path[above]);
    let share = (distance - a.distance) / (b.distance - a.distance);
    let mix = |x: f64, y: f64| x + (y - x) * share;
    let turn = angle::difference(b.pose.theta, a.pose.theta);
    let pose = Pose::new(
        mix(a.pose.x, b.pose.x),
        mix(a.pose.y, b.pose.y),
        angle::wrap(a.pose.theta + turn * share),
    );
    (pose, mix(a.kappa, b.kappa))
}

/// Whether a trajectory may be driven from `start`, its accelerations in `range`.
///
/// # Errors
/// [`Unfit`] for the first thing that is wrong with it.
pub fn check(points: &[TrajectoryPoint], start: &StartPoint, range: (f64, f64)) -> Result<(), Unfit> {
    let Some(first) = points.first().filter(|_| points.len() >= 2) else {
        return Err(Unfit::Incomplete);
    };
    let is_finite = |p: &TrajectoryPoint| {
        let numbers = [
            p.t,
            p.distance,
            p.pose.x,
            p.pose.y,
            p.pose.theta,
            p.kappa,
            p.v,
            p.a,
        ];
        numbers.iter().all(|number| number.is_finite())
    };
    if !points.iter().all(is_finite) {
        return Err(Unfit::NotFinite);
    }
    let steps_back =
        |pair: &[TrajectoryPoint]| pair[1].t <= pair[0].t || pair[1].distance < pair[0].distance - BACK;
    if points.windows(2).any(steps_back) {
        return Err(Unfit::StepsBack);
    }
    let apart = (first.pose.position() - start.pose.position()).norm() > START.0
        || angle::difference(first.pose.theta, start.pose.theta).abs() > START.1
        || (first.v - start.v).abs() > START.2;
    if apart {
        return Err(Unfit::Apart);
    }
    let is_possible =
        |p: &TrajectoryPoint| (SPEEDS.0..=SPEEDS.1).contains(&p.v) && (range.0..=range.1).contains(&p.a);
    if points.iter().skip(1).all(is_possible) {
        Ok(())
    } else {
        Err(Unfit::BeyondLimits)
    }
}
