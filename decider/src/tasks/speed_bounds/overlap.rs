//! When and where moving obstacles will be on the path: the boundaries of the ST graph (the original's
//! `STBoundaryMapper`).
//!
//! Bodies are compared as boxes in the Frenet frame of the line. Who comes up from behind is not on the path.

use super::limits::is_within;
use crate::frame::ObstacleId;
use crate::tasks::path::Path;
use crate::st_graph::{StBoundary, StPair};
use crate::tasks::scene::{Moving, Scene, TimedBox};

/// A moving obstacle on the path.
#[derive(Clone, Debug, PartialEq)]
pub struct OnPath {
    /// Which obstacle.
    pub id: ObstacleId,
    /// What it occupies, and what is decided about it.
    pub boundary: StBoundary,
    /// Its speed along the line when it is first on the path, m/s.
    pub s_dot: f64,
}

/// The moving obstacles on a path, in the scene's order. Who crosses it occupies it `margin` seconds longer before and
/// after.
pub(super) fn on_path(scene: &Scene, path: &Path, margin: impl Fn(ObstacleId) -> f64) -> Vec<OnPath> {
    let moving = scene.moving.iter();
    moving.filter_map(|moving| there(scene, path, moving, margin(moving.id))).collect()
}

/// An obstacle slower than this along the path crosses it rather than leads, m/s.
const LEADER_SPEED: f64 = 0.5;

/// How long an obstacle that is seen on the path at one moment alone is there, s.
const MOMENT: f64 = 0.1;

/// Slower than this along the line nobody comes up from behind, m/s.
const COMING_UP: f64 = 0.5;

/// Whether an obstacle comes from behind: then it has to keep clear of the ego, and braking would only bring
/// it nearer. Whether a lane may be entered before it is asked when the lane is chosen.
fn comes_from_behind(scene: &Scene, now: &TimedBox) -> bool {
    let vehicle = scene.vehicle;
    let ego_center = scene.ego.s + (vehicle.front_edge_to_center - vehicle.back_edge_to_center) / 2.0;
    now.at.s < ego_center && now.s_dot > COMING_UP
}

fn there(scene: &Scene, path: &Path, moving: &Moving, margin: f64) -> Option<OnPath> {
    if comes_from_behind(scene, &moving.boxes[0]) {
        return None;
    }
    let mut s_dot = None;
    let mut pairs = Vec::new();
    for there in &moving.boxes {
        if let Some(pair) = occupancy(scene, path, there) {
            s_dot.get_or_insert(there.s_dot);
            pairs.push(pair);
        }
    }
    if let [only] = pairs[..] {
        pairs.push(StPair { t: only.t + MOMENT, ..only });
    }
    let boundary = StBoundary::reduced(pairs).ok()?;
    let s_dot = s_dot.unwrap_or(0.0);
    let leads = s_dot > LEADER_SPEED && boundary.min_t() <= 0.0;
    let boundary = if leads {
        boundary
    } else {
        boundary.expanded_by_t(margin).unwrap_or(boundary)
    };
    Some(OnPath {
        id: moving.id,
        boundary,
        s_dot,
    })
}

/// The stretch that a box takes from the path, if the car would touch it there.
fn occupancy(scene: &Scene, path: &Path, there: &TimedBox) -> Option<StPair> {
    let vehicle = scene.vehicle;
    let (start_s, end_s) = (there.at.s - there.half_length, there.at.s + there.half_length);
    let behind = end_s < path.points[0].s - vehicle.back_edge_to_center;
    if behind || start_s > path.end_s() + vehicle.front_edge_to_center || !is_within(scene.line, there.at.s) {
        return None;
    }
    // The body is over a station of the obstacle from when its front gets there to when its rear leaves.
    let reach = vehicle.half_width() + scene.config.speed.lateral_margin + there.half_width;
    let first = path
        .points
        .partition_point(|p| p.s < start_s - vehicle.front_edge_to_center);
    let last = path
        .points
        .partition_point(|p| p.s <= end_s + vehicle.back_edge_to_center);
    let near = &path.points[first.min(path.points.len() - 1)..last.max(first + 1).min(path.points.len())];
    let meets = near.iter().any(|p| {
        // Where the body is beside the obstacle, not where its rear axle is.
        let ahead = (there.at.s - p.s).clamp(-vehicle.back_edge_to_center, vehicle.front_edge_to_center);
        let slope = slope_at(path, p.s);
        (p.l + slope * ahead - there.at.l).abs() < reach
    });
    meets.then(|| {
        let lower = path.distance_at(start_s - vehicle.front_edge_to_center);
        StPair::new(there.t, lower, path.distance_at(end_s + vehicle.back_edge_to_center))
    })
}

/// `dl/ds` of the path at a station.
fn slope_at(path: &Path, s: f64) -> f64 {
    let k = path
        .points
        .partition_point(|p| p.s <= s)
        .clamp(1, path.points.len() - 1);
    let (a, b) = (&path.points[k - 1], &path.points[k]);
    (b.l - a.l) / (b.s - a.s)
}
