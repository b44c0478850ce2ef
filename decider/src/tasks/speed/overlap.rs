//! When and where moving obstacles will be on the path: the entries of an ST graph, in a simple form.

use super::limits::is_within;
use crate::frame::ObstacleId;
use crate::tasks::path::Path;
use crate::tasks::scene::{Moving, Scene, TimedBox};

/// A stretch of the path that an obstacle occupies at one time, in terms of the rear axle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occupied {
    /// Seconds from the frame's time.
    pub t: f64,
    /// Distance at which the front bumper touches it, m.
    pub low: f64,
    /// Distance at which the rear bumper has left it, m.
    pub high: f64,
}

/// All that one obstacle occupies of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Which obstacle.
    pub id: ObstacleId,
    /// By ascending time; not empty.
    pub occupied: Vec<Occupied>,
    /// Its speed along the path when it is first on it, m/s.
    pub s_dot: f64,
    /// Whether it is on the path already.
    pub is_present: bool,
    /// Seconds between two entries.
    pub period: f64,
}

impl Claim {
    /// What is occupied at a time, between the given ones by interpolation.
    pub fn at(&self, t: f64) -> Option<Occupied> {
        let above = self.occupied.partition_point(|o| o.t <= t);
        let before = above.checked_sub(1).map(|k| self.occupied[k]);
        let after = self.occupied.get(above).copied();
        match (before, after) {
            (Some(a), Some(b)) if b.t - a.t <= self.period * 1.5 => {
                let share = (t - a.t) / (b.t - a.t);
                Some(Occupied {
                    t,
                    low: a.low + (b.low - a.low) * share,
                    high: a.high + (b.high - a.high) * share,
                })
            }
            (Some(a), _) if t - a.t <= self.period => Some(Occupied { t, ..a }),
            (_, Some(b)) if b.t - t <= self.period => Some(Occupied { t, ..b }),
            _ => None,
        }
    }
}

/// The claims of all moving obstacles on a path, in the scene's order.
pub fn claims(scene: &Scene, path: &Path) -> Vec<Claim> {
    scene
        .moving
        .iter()
        .filter_map(|moving| claim(scene, path, moving))
        .collect()
}

/// Slower than this along the line nobody comes up from behind, m/s.
const COMING_UP: f64 = 0.5;

/// Whether an obstacle comes from behind: then it has to keep clear of the ego, and braking would only bring
/// it nearer. Whether a lane may be entered before it is asked when the lane is chosen.
fn comes_from_behind(scene: &Scene, now: &TimedBox) -> bool {
    let vehicle = scene.vehicle;
    let ego_center = scene.ego.s + (vehicle.front_edge_to_center - vehicle.back_edge_to_center) / 2.0;
    now.at.s < ego_center && now.s_dot > COMING_UP
}

fn claim(scene: &Scene, path: &Path, moving: &Moving) -> Option<Claim> {
    if comes_from_behind(scene, &moving.boxes[0]) {
        return None;
    }
    let mut s_dot = None;
    let mut occupied = Vec::new();
    for there in &moving.boxes {
        if let Some(entry) = occupancy(scene, path, there) {
            s_dot.get_or_insert(there.s_dot);
            occupied.push(entry);
        }
    }
    let first = occupied.first()?;
    let period = match moving.boxes[..] {
        [a, b, ..] => b.t - a.t,
        _ => f64::MAX,
    };
    let is_present = first.t <= 0.0;
    Some(Claim {
        id: moving.id,
        is_present,
        occupied,
        s_dot: s_dot.unwrap_or(0.0),
        period,
    })
}

/// The stretch that a box takes from the path, if the car would touch it there.
fn occupancy(scene: &Scene, path: &Path, there: &TimedBox) -> Option<Occupied> {
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
    meets.then(|| Occupied {
        t: there.t,
        low: path.distance_at(start_s - vehicle.front_edge_to_center),
        high: path.distance_at(end_s + vehicle.back_edge_to_center),
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
