//! Speed along a path: cruise, bends, stops, leaders and crossing traffic.
//!
//! A simple layer with one function. The profile is integrated forward in time by the rule "accelerate as the
//! tightest constraint allows"; constraints are the speed limit ahead (`limits`), a stop, and the stretches
//! of the path that moving obstacles will occupy (`overlap`).

mod limits;
mod overlap;
mod profile;
mod rules;

pub use overlap::{Claim, claims};

use super::path::Path;
use super::scene::Scene;
use crate::decision::{Stop, StopCause, TrajectoryPoint};
use crate::frame::ObstacleId;
use serde::{Deserialize, Serialize};

/// Settings of the speed layer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpeedConfig {
    /// Comfortable acceleration, m/s².
    pub acceleration: f64,
    /// Comfortable braking, m/s², positive.
    pub braking: f64,
    /// Braking that is still planned for, m/s², positive: beyond it is an emergency.
    pub hard_braking: f64,
    /// Comfortable jerk, m/s³.
    pub jerk: f64,
    /// Jerk of an emergency, m/s³.
    pub emergency_jerk: f64,
    /// Lateral acceleration in bends, m/s².
    pub lateral_acceleration: f64,
    /// Gap to something that blocks the path, m (the original's `min_stop_distance_obstacle`).
    pub stop_distance: f64,
    /// The same where it may be passed through another lane: a car that cannot reverse needs the room.
    pub pull_out_distance: f64,
    /// Least such gap where the car came upon it late, m.
    pub least_stop_distance: f64,
    /// Gap to a leader at standstill, m.
    pub follow_distance: f64,
    /// Time gap to a leader, s.
    pub follow_time: f64,
    /// Room beside the path within which a moving obstacle claims it, m.
    pub lateral_margin: f64,
    /// Time that has to lie between the ego's and a crossing obstacle's use of the same place, s.
    pub yield_time: f64,
    /// Share of the cruise speed driven while waiting for a gap in the lane to change to.
    pub gap_seeking_share: f64,
    /// How far before its place a pull-over stops, m: within the tolerance, on its near side.
    pub pull_over_early: f64,
}

impl Default for SpeedConfig {
    fn default() -> Self {
        Self {
            acceleration: 1.8,
            braking: 2.0,
            hard_braking: 3.5,
            jerk: 3.0,
            emergency_jerk: 20.0,
            lateral_acceleration: 2.5,
            stop_distance: 6.0,
            pull_out_distance: 9.0,
            least_stop_distance: 1.5,
            follow_distance: 4.0,
            follow_time: 1.4,
            lateral_margin: 0.3,
            yield_time: 1.5,
            gap_seeking_share: 0.85,
            pull_over_early: 0.25,
        }
    }
}

/// A trajectory and what it slows down for.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// The trajectory, a tenth of a second apart.
    pub trajectory: Vec<TrajectoryPoint>,
    /// The constraint that holds the car back most, if one does.
    pub stop: Option<Stop>,
}

/// What a plan has to know beside the scene and the path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Purpose {
    /// A place to stop at for its own sake.
    pub stop_at: Option<Stop>,
    /// What the last tick slowed down for.
    pub before: Option<Stop>,
    /// Whether what blocks the path may be passed through another lane, now or when that is free.
    pub may_pull_out: bool,
}

/// Plans the speed along `path`.
pub fn plan(scene: &Scene, path: &Path, purpose: Purpose) -> Planned {
    let stop = nearest_stop(scene, path, purpose);
    let claims = claims(scene, path);
    let envelope = limits::Envelope::new(scene, path);
    let yielded_to = purpose.before.and_then(|stop| match stop.cause {
        StopCause::Yield(id) => Some(id),
        _ => None,
    });
    profile::integrate(scene, path, &envelope, stop, &claims, yielded_to)
}

/// The first of the given stop, the path's blocker and the path's end.
fn nearest_stop(scene: &Scene, path: &Path, purpose: Purpose) -> Stop {
    let end = match path.blocked_by {
        Some(id) => Stop {
            distance: before_blocker(scene, path, id, purpose.may_pull_out),
            cause: StopCause::Blocked(id),
        },
        None if ends_with_line(scene, path) => Stop {
            distance: path.length(),
            cause: StopCause::Destination,
        },
        None => Stop {
            distance: path.length(),
            cause: StopCause::PathEnd,
        },
    };
    // A place chosen to stop at needs no gap beyond what its own search has kept.
    purpose
        .stop_at
        .filter(|stop| stop.distance <= path.length())
        .unwrap_or(end)
}

fn ends_with_line(scene: &Scene, path: &Path) -> bool {
    use crate::reference_line::LineQuery;
    path.end_s() + 2.0 > scene.line.length()
}

/// Where to stand before a blocker: the wanted gap if it can be kept in comfort, else what is left of it. Pulling
/// out takes more room than standing.
fn before_blocker(scene: &Scene, path: &Path, id: ObstacleId, may_pull_out: bool) -> f64 {
    let config = &scene.config.speed;
    let contact = scene.obstacle(id).map_or(path.length(), |obstacle| {
        distance_at(path, obstacle.start_s - scene.vehicle.front_edge_to_center)
    });
    let contact = contact.min(path.length() + 1.0);
    let gap = if may_pull_out {
        config.pull_out_distance
    } else {
        config.stop_distance
    };
    rules::stop_before(config, scene.start.v, contact, gap)
        .min(path.length())
        .max(0.0)
}

/// Arc length along the path at station `s`, going on straight beyond its end.
pub fn distance_at(path: &Path, s: f64) -> f64 {
    let points = &path.points;
    let above = points.partition_point(|p| p.s <= s).clamp(1, points.len() - 1);
    let (a, b) = (&points[above - 1], &points[above]);
    a.distance + (s - a.s) / (b.s - a.s) * (b.distance - a.distance)
}
