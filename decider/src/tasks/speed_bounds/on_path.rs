//! The moving obstacles on a path, as boundaries of the ST graph.

use super::track::Track;
use crate::frame::{Obstacle, ObstacleId};
use crate::st_graph::StBoundary;
use crate::tasks::path::Path;
use crate::tasks::scene::{Moving, Scene, TimedBox};

/// Slower than this along the line nobody comes up from behind, m/s.
const COMING_UP: f64 = 0.5;

/// An obstacle slower than this along the path crosses it rather than leads, m/s.
const LEADER_SPEED: f64 = 0.5;

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
    let config = &scene.config.speed;
    let track = Track::new(
        scene.vehicle,
        &path.points,
        config.lateral_margin,
        config.total_time,
    );
    let Some(track) = track else { return Vec::new() };
    let there = |moving: &Moving| {
        let seen = |obstacle: &&Obstacle| obstacle.id == moving.id;
        let obstacle = scene.frame.obstacles.iter().find(seen)?;
        there(scene, &track, moving, obstacle, margin(moving.id))
    };
    scene.moving.iter().filter_map(there).collect()
}

fn there(scene: &Scene, track: &Track, moving: &Moving, obstacle: &Obstacle, margin: f64) -> Option<OnPath> {
    if comes_from_behind(scene, &moving.boxes[0]) {
        return None;
    }
    let boundary = track.occupied(obstacle)?;
    let first = moving.boxes.iter().find(|there| there.t >= boundary.min_t());
    let s_dot = first.map_or(0.0, |there| there.s_dot);
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

/// Whether an obstacle comes from behind: then it has to keep clear of the ego, and braking would only bring
/// it nearer. Whether a lane may be entered before it is asked when the lane is chosen.
fn comes_from_behind(scene: &Scene, now: &TimedBox) -> bool {
    let vehicle = scene.vehicle;
    let ego_center = scene.ego.s + (vehicle.front_edge_to_center - vehicle.back_edge_to_center) / 2.0;
    now.at.s < ego_center && now.s_dot > COMING_UP
}
