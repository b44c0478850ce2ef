//! Faults of the path: its shape, its checks, and what of it is handed to the tracker.

use super::planted::Past;
use super::spec::{Plant, Spec, Stage};
use corridor_decider::config::Config;
use corridor_decider::decision::{PathPoint, TrajectoryPoint};
use corridor_decider::geometry::{Pose, Vec2, angle};
use corridor_decider::planner::{LinePlan, TaskName};
use corridor_decider::reference_line::{LineQuery, SlPoint};

/// From the rear axle to the front one, m.
const WHEEL_BASE: f64 = 2.8448;

/// How far beside its place a path is laid, m.
const BESIDE: f64 = 0.5;

/// How far a path goes on beyond what ends it, m.
const ON: f64 = 30.0;

const fn on_path(name: &'static str, what: &'static str, change: fn(&mut LinePlan, &mut Past)) -> Spec {
    Spec::new(
        name,
        what,
        Stage::Path,
        Plant::HandsOn(TaskName::PathAssessment, change),
    )
}

const fn on_trajectory(
    name: &'static str,
    what: &'static str,
    change: fn(&mut Vec<TrajectoryPoint>, &mut Past),
) -> Spec {
    Spec::new(name, what, Stage::Path, Plant::Trajectory(change))
}

const fn configured(name: &'static str, what: &'static str, change: fn(&mut Config)) -> Spec {
    Spec::new(name, what, Stage::Path, Plant::Config(change))
}

pub(super) const FAULTS: &[Spec] = &[
    on_path(
        "path_mirrored",
        "`l` of the path has the wrong sign.",
        |plan, _| laid_again(plan, |l| -l),
    ),
    on_path(
        "path_scaled",
        "`l` of the path is a fifth too large.",
        |plan, _| laid_again(plan, |l| 1.2 * l),
    ),
    on_path(
        "path_along_the_line",
        "The path is the line itself: offsets are lost.",
        |plan, _| laid_again(plan, |_| 0.0),
    ),
    on_path(
        "path_through_what_ends_it",
        "What the body would touch does not end the path; it goes on for 30 m.",
        |plan, _| {
            if let Some((_, path)) = plan.chosen.as_mut().filter(|(_, path)| path.blocked_by.is_some()) {
                path.blocked_by = None;
                path.leads_to_goal = true;
            }
            extend(plan, ON);
        },
    ),
    configured(
        "curvature_unbounded",
        "Paths may bend ten times as much as the steering can.",
        |config| {
            config.path.curvature_share *= 10.0;
        },
    ),
    configured(
        "bound_tolerance_of_a_metre",
        "Paths may leave their bound by a metre.",
        |config| {
            config.path.bound_tolerance = 1.0;
        },
    ),
    configured(
        "path_smoothed_too_long",
        "The smoother looks over six seconds: bends are cut.",
        |config| {
            config.path.smoothing_time *= 10.0;
        },
    ),
    on_trajectory(
        "front_axle_for_rear_axle",
        "The path is one for the front axle, and the rear one follows it.",
        |points, _| {
            for point in points.iter_mut() {
                point.pose = point.pose.advanced(WHEEL_BASE);
            }
        },
    ),
    on_trajectory(
        "trajectory_beside",
        "What the tracker is given lies half a metre left of what was planned.",
        |points, _| {
            for point in points {
                let place = point.pose.to_world(Vec2::new(0.0, BESIDE));
                point.pose = Pose::new(place.x, place.y, point.pose.theta);
            }
        },
    ),
    on_trajectory(
        "trajectory_mirrored",
        "What the tracker is given is mirrored at the car's axis.",
        |points, _| {
            let Some(axis) = points.first().map(|point| point.pose) else {
                return;
            };
            for point in points {
                let local = axis.to_local(point.pose.position());
                let place = axis.to_world(Vec2::new(local.x, -local.y));
                let turn = angle::difference(point.pose.theta, axis.theta);
                point.pose = Pose::new(place.x, place.y, angle::wrap(axis.theta - turn));
                point.kappa = -point.kappa;
            }
        },
    ),
    on_trajectory(
        "curvature_sign",
        "The curvature that the tracker is given has the wrong sign.",
        |points, _| {
            for point in points.iter_mut() {
                point.kappa = -point.kappa;
            }
        },
    ),
    on_trajectory(
        "headings_of_the_path_in_degrees",
        "The headings that the tracker is given are in degrees.",
        |points, _| {
            for point in points.iter_mut() {
                point.pose.theta = angle::wrap(point.pose.theta.to_degrees());
            }
        },
    ),
];

/// Lays the chosen path again with other offsets.
fn laid_again(plan: &mut LinePlan, offset: impl Fn(f64) -> f64) {
    let line = plan.scene.line;
    let Some((_, path)) = plan.chosen.as_mut() else {
        return;
    };
    for point in &mut path.points {
        point.l = offset(point.l);
        let place = line.to_cartesian(SlPoint {
            s: point.s,
            l: point.l,
        });
        (point.pose.x, point.pose.y) = (place.x, place.y);
    }
    let places: Vec<Vec2> = path.points.iter().map(|point| point.pose.position()).collect();
    let mut distance = path.points.first().map_or(0.0, |first| first.distance);
    for (k, point) in path.points.iter_mut().enumerate() {
        if k > 0 {
            distance += (places[k] - places[k - 1]).norm();
        }
        point.distance = distance;
        let (from, to) = (k.saturating_sub(1), (k + 1).min(places.len() - 1));
        let along = places[to] - places[from];
        point.pose.theta = libm::atan2(along.y, along.x);
    }
}

/// Makes the chosen path go on at its last offset.
pub(super) fn extend(plan: &mut LinePlan, by: f64) {
    let line = plan.scene.line;
    let Some((_, path)) = plan.chosen.as_mut() else {
        return;
    };
    let Some(last) = path.points.last().copied() else {
        return;
    };
    let mut ahead = 1.0;
    while ahead <= by {
        let s = last.s + ahead;
        let at = line.point(s);
        let place = line.to_cartesian(SlPoint { s, l: last.l });
        path.points.push(PathPoint {
            distance: last.distance + ahead,
            s,
            l: last.l,
            pose: Pose::new(place.x, place.y, at.theta),
            kappa: at.kappa,
        });
        ahead += 1.0;
    }
}
