//! The speed that the road ahead allows: limits of the map and lateral acceleration in bends.

use crate::decision::PathPoint;
use crate::tasks::path::Path;
use crate::tasks::path_bounds::ObstacleSl;
use crate::tasks::scene::Scene;

/// Curvature below this limits no speed worth driving, 1/m.
const STRAIGHT: f64 = 1e-4;

/// Share of the steering's rate that a path may use.
const STEERING_SHARE: f64 = 0.7;

/// However fast the curvature changes, this slow is slow enough, m/s.
const STEERING_CRAWL: f64 = 0.5;

/// With this much room beside the body, m, nobody slows down for what stands there.
const AMPLE_ROOM: f64 = 0.8;

/// Speed with no room at all, m/s, and how it grows with the room, 1/s: 17 km/h at 0.3 m, 36 km/h at 0.65 m.
const NARROW: (f64, f64) = (0.5, 14.0);

/// The fastest speed at each point of a path, reachable with comfortable braking.
#[derive(Clone, Debug)]
pub struct Envelope {
    /// Speed per metre of path.
    speeds: Vec<f64>,
    step: f64,
}

impl Envelope {
    /// The limits of one path.
    pub fn new(scene: &Scene, path: &Path) -> Self {
        let config = &scene.config.speed;
        let mut speeds: Vec<f64> = path
            .points
            .iter()
            .map(|point| {
                let bend = (config.lateral_acceleration / point.kappa.abs().max(STRAIGHT)).sqrt();
                let limit = scene.line.sample_at(point.s).speed_limit.unwrap_or(f64::MAX);
                bend.min(limit).min(scene.cruise_speed)
            })
            .collect();
        for (k, pair) in path.points.windows(2).enumerate() {
            let limit = steering_limit(scene, &pair[0], &pair[1]);
            speeds[k] = speeds[k].min(limit);
            speeds[k + 1] = speeds[k + 1].min(limit);
        }
        for (speed, pair) in speeds.iter_mut().zip(path.points.windows(2)) {
            let slope = (pair[1].l - pair[0].l) / (pair[1].s - pair[0].s);
            *speed = speed.min(room_limit(scene, &pair[0], slope));
        }
        for k in (0..speeds.len() - 1).rev() {
            let gap = path.points[k + 1].distance - path.points[k].distance;
            let reachable = (speeds[k + 1] * speeds[k + 1] + 2.0 * config.braking * gap).sqrt();
            speeds[k] = speeds[k].min(reachable);
        }
        let step = (path.length() / (speeds.len() - 1) as f64).max(1e-6);
        Self { speeds, step }
    }

    /// The limit at a distance along the path; the last one goes on.
    pub fn at(&self, distance: f64) -> f64 {
        let place = (distance / self.step).max(0.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "not negative, clamped below"
        )]
        let k = (place as usize).min(self.speeds.len() - 1);
        let next = self.speeds[(k + 1).min(self.speeds.len() - 1)];
        self.speeds[k] + (next - self.speeds[k]) * (place - k as f64).min(1.0)
    }
}

/// The speed at which the steering keeps up with the change of curvature between two points.
fn steering_limit(scene: &Scene, from: &PathPoint, to: &PathPoint) -> f64 {
    let vehicle = scene.vehicle;
    let rate = vehicle.max_steer_angle_rate / vehicle.steer_ratio / vehicle.wheel_base * STEERING_SHARE;
    let change = (to.kappa - from.kappa).abs() / (to.distance - from.distance).max(1e-6);
    (rate / change.max(STRAIGHT)).max(STEERING_CRAWL)
}

/// The speed that the room beside the body allows, where something stands.
fn room_limit(scene: &Scene, point: &PathPoint, slope: f64) -> f64 {
    let vehicle = scene.vehicle;
    let beside = |obstacle: &&ObstacleSl| {
        obstacle.is_static
            && point.s + vehicle.front_edge_to_center > obstacle.start_s
            && point.s - vehicle.back_edge_to_center < obstacle.end_s
    };
    let room_at = |s: f64, obstacle: &ObstacleSl| {
        let ahead = (s - point.s).clamp(-vehicle.back_edge_to_center, vehicle.front_edge_to_center);
        let l = point.l + slope * ahead;
        (obstacle.start_l - l).max(l - obstacle.end_l) - vehicle.half_width()
    };
    // The body crosses the line at an angle: what counts is where its ends are beside the obstacle.
    let room =
        |obstacle: &ObstacleSl| room_at(obstacle.start_s, obstacle).min(room_at(obstacle.end_s, obstacle));
    let room = scene
        .obstacles
        .iter()
        .filter(beside)
        .map(room)
        .fold(f64::MAX, f64::min);
    if room >= AMPLE_ROOM {
        f64::MAX
    } else {
        (NARROW.0 + NARROW.1 * room).max(NARROW.0)
    }
}
