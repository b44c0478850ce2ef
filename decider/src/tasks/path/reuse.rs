//! Going on along the path of the tick before (the use of the original's `PATH_REUSE_DECIDER` and of the first
//! rung of its fallback chain).
//!
//! A way that was found a tick ago is not lost because the next search, from a place a hand's breadth further
//! on, misses it by a hair.

use super::{Path, assess};
use crate::decision::PathPoint;
use crate::tasks::scene::Scene;

/// Farther than this from the old path the ego is not on it any more, m.
const ON_PATH: f64 = 0.1;

/// The old path's first point that is kept lies at least this far ahead, m, so that no two points coincide.
const LEAST_STEP: f64 = 0.2;

/// What is left of an old path along the same line, as far as it is still clear. `None` if the ego is not on it or
/// nothing of it is left.
pub fn reuse(scene: &Scene, old: &[PathPoint]) -> Option<Path> {
    let here = scene.ego.s;
    let next = old.partition_point(|p| p.s <= here + LEAST_STEP);
    let (before, after) = (old.get(next.checked_sub(1)?)?, old.get(next)?);
    let share = (here - before.s) / (after.s - before.s);
    if (before.l + (after.l - before.l) * share - scene.ego.l).abs() > ON_PATH {
        return None;
    }
    let start = PathPoint {
        distance: 0.0,
        s: here,
        l: scene.ego.l,
        pose: scene.start.pose,
        kappa: scene.start.kappa,
    };
    let mut points = vec![start];
    for point in &old[next..] {
        let last = &points[points.len() - 1];
        let step = (point.pose.position() - last.pose.position()).norm();
        points.push(PathPoint {
            distance: last.distance + step,
            ..*point
        });
    }
    assess::until_contact(scene, points).ok()
}
