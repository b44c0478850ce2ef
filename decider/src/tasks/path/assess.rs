//! From an offset profile to a path: inside its bound, not bent too much, and clear of every standing body.
//!
//! The whole footprint is checked at every point, a metre apart: a car is five metres long, so nothing slips
//! between two of them.

use super::Path;
use super::corridor::Corridor;
use super::profile::Profile;
use super::table::{LineTable, Row, STEP};
use crate::decision::{PathPoint, Rejection};
use crate::frame::ObstacleId;
use crate::geometry::{ConvexPolygon, Pose, Vec2, angle};
use crate::tasks::scene::{Body, Scene};

/// Length at the end of a path that the original leaves unchecked, m.
const UNCHECKED_TAIL: f64 = 10.5;

/// Curvature above the limit that a path may start with, 1/m: what the car does now it does.
const START_EXCESS: f64 = 0.02;

/// Over which distance that excess has to go, m.
const START_LENGTH: f64 = 5.0;

/// Points without which there is no path to speak of.
const LEAST_POINTS: usize = 4;

pub(super) fn assess(
    scene: &Scene,
    table: &LineTable,
    corridor: &Corridor,
    profile: &Profile,
) -> Result<Path, Rejection> {
    let inside = |(k, l): (usize, &[f64; 4])| {
        let ((lo, hi), tolerance) = (corridor.limits[k], corridor.tolerance[k]);
        l[0] >= lo - tolerance && l[0] <= hi + tolerance
    };
    if !profile.l.iter().enumerate().all(inside) {
        return Err(Rejection::LeavesBound);
    }
    let mut points = to_points(table, profile);
    let limit = scene.vehicle.max_kappa() * scene.config.path.curvature_share;
    let bends = |p: &PathPoint| p.kappa.abs() > limit + start_excess(p.distance) || !p.kappa.is_finite();
    if let Some(k) = (1..points.len()).find(|k| bends(&points[*k])) {
        // A road that cannot be driven on is driven as far as it can.
        let near = &table.rows[k.saturating_sub(1)..(k + 2).min(table.rows.len())];
        if k < LEAST_POINTS || near.iter().all(|row| row.kappa.abs() <= limit) {
            return Err(Rejection::Curvature);
        }
        points.truncate(k);
    }
    if leaves_road(scene, table, &points, corridor.road_tolerance) {
        return Err(Rejection::LeavesRoad);
    }
    until_contact(scene, points)
}

/// Curvature above the limit that is allowed at a distance from the start, 1/m.
pub(super) fn start_excess(distance: f64) -> f64 {
    START_EXCESS * (1.0 - distance / START_LENGTH).max(0.0)
}

/// Whether a corner of the body leaves the road surface where it has not been off it from the start. Front and rear
/// are held against the road where they are: in a tight bend that is not beside the rear axle.
fn leaves_road(scene: &Scene, table: &LineTable, points: &[PathPoint], tolerance: f64) -> bool {
    let vehicle = scene.vehicle;
    let beyond = |row: &Row, at: Vec2| {
        let l = row.forward.x * (at.y - row.position.y) - row.forward.y * (at.x - row.position.x);
        (l + vehicle.half_width() - row.road.0).max(vehicle.half_width() - l - row.road.1)
    };
    let row = |k: usize| &table.rows[k.min(table.rows.len() - 1)];
    let ahead = rows_in(vehicle.front_edge_to_center);
    let behind = rows_in(vehicle.back_edge_to_center);
    let overhang = |(k, point): (usize, &PathPoint)| {
        let front = point.pose.advanced(vehicle.front_edge_to_center).position();
        let rear = point.pose.advanced(-vehicle.back_edge_to_center).position();
        beyond(row(k + ahead), front).max(beyond(row(k.saturating_sub(behind)), rear))
    };
    let mut overhangs = points.iter().enumerate().map(overhang);
    let allowed = overhangs.next().unwrap_or(0.0).max(0.0) + tolerance;
    overhangs.any(|overhang| overhang > allowed)
}

/// How many rows of the table a length takes.
fn rows_in(length: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a few metres, not negative"
    )]
    let count = (length / STEP).round() as usize;
    count
}

/// A path as far as the body touches nothing.
pub(crate) fn until_contact(scene: &Scene, mut points: Vec<PathPoint>) -> Result<Path, Rejection> {
    let contact = first_contact(scene, &points);
    if let Some((k, id)) = contact {
        points.truncate(k);
        if points.len() < 2 || points[k - 1].distance < scene.config.path.least_reach {
            return Err(Rejection::Touches(id));
        }
    }
    Ok(Path {
        points,
        blocked_by: contact.map(|(_, id)| id),
        leads_to_goal: false,
        is_reused: false,
    })
}

/// The profile in world coordinates (the original's Frenet-to-Cartesian conversion).
pub(crate) fn to_points(table: &LineTable, profile: &Profile) -> Vec<PathPoint> {
    let mut points: Vec<PathPoint> = Vec::with_capacity(profile.l.len());
    for (row, l) in table.rows.iter().zip(&profile.l) {
        let (pose, kappa) = to_world(row, *l);
        let distance = points.last().map_or(0.0, |last: &PathPoint| {
            last.distance + (pose.position() - last.pose.position()).norm()
        });
        points.push(PathPoint {
            distance,
            s: row.s,
            l: l[0],
            pose,
            kappa,
        });
    }
    points
}

fn to_world(row: &Row, [l, dl, ddl, _]: [f64; 4]) -> (Pose, f64) {
    let stretch = 1.0 - row.kappa * l;
    let turn = libm::atan2(dl, stretch);
    let (sin, cos) = angle::sin_cos(turn);
    let tan = sin / cos;
    let bend = ddl + (row.dkappa * l + row.kappa * dl) * tan;
    let kappa = (bend * cos * cos / stretch + row.kappa) * cos / stretch;
    let left = Vec2::new(-row.forward.y, row.forward.x);
    let position = row.position + left * l;
    (
        Pose::new(position.x, position.y, angle::wrap(row.theta + turn)),
        kappa,
    )
}

/// The first point at which the body would touch a standing one, and which.
fn first_contact(scene: &Scene, points: &[PathPoint]) -> Option<(usize, ObstacleId)> {
    if scene.bodies.is_empty() {
        return None;
    }
    let config = &scene.config.path;
    let vehicle = scene.vehicle;
    let checked = if config.corner_collision_check {
        let end = points.last()?.distance - UNCHECKED_TAIL;
        points.partition_point(|p| p.distance < end)
    } else {
        points.len()
    };
    let radius = vehicle.front_edge_to_center + vehicle.half_width() + config.clearance;
    let near: Vec<&Body> = scene
        .bodies
        .iter()
        .filter(|body| is_near(body, points, radius))
        .collect();
    points[..checked].iter().enumerate().find_map(|(k, point)| {
        let mut footprint = None;
        near.iter().find_map(|body| {
            let reach = radius + body.radius;
            if (body.center - point.pose.position()).norm_squared() > reach * reach {
                return None;
            }
            let footprint = footprint.get_or_insert_with(|| {
                ConvexPolygon::rectangle(
                    point.pose,
                    vehicle.front_edge_to_center + config.clearance,
                    vehicle.back_edge_to_center + config.clearance,
                    vehicle.half_width() + config.clearance,
                )
            });
            touches(footprint, body, config.corner_collision_check).then_some((k, body.id))
        })
    })
}

fn touches(footprint: &ConvexPolygon, body: &Body, corners_only: bool) -> bool {
    if corners_only {
        return footprint
            .vertices()
            .iter()
            .any(|corner| body.outline.contains(*corner));
    }
    footprint.overlaps(&body.outline)
}

/// Whether a body is near the stretch that the path covers at all.
fn is_near(body: &Body, points: &[PathPoint], radius: f64) -> bool {
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return false;
    };
    let middle = (first.pose.position() + last.pose.position()) / 2.0;
    let reach = last.distance / 2.0 + radius + body.radius;
    (body.center - middle).norm_squared() <= reach * reach
}
