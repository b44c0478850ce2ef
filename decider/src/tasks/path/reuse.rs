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

/// Whether the car is on an old path, which may have been found along another line.
pub fn is_on(scene: &Scene, old: &[PathPoint]) -> bool {
    let next = old.partition_point(|p| p.s <= scene.ego.s);
    let Some((before, after)) = next
        .checked_sub(1)
        .and_then(|k| Some((old.get(k)?, old.get(next)?)))
    else {
        return false;
    };
    let share = (scene.ego.s - before.s) / (after.s - before.s);
    let (a, b) = (before.pose.position(), after.pose.position());
    (a + (b - a) * share - scene.start.pose.position()).norm() <= ON_PATH
}

/// What is left of an old path along the same line, as far as it is still clear. `None` if the ego is not on it or
/// nothing of it is left.
pub fn reuse(scene: &Scene, old: &[PathPoint]) -> Option<Path> {
    let here = scene.ego.s;
    let next = old.partition_point(|p| p.s <= here + LEAST_STEP);
    if !is_on(scene, old) {
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
    for point in old.get(next..)? {
        let last = &points[points.len() - 1];
        let step = (point.pose.position() - last.pose.position()).norm();
        points.push(PathPoint {
            distance: last.distance + step,
            ..*point
        });
    }
    if points.len() < 2 {
        return None;
    }
    let path = assess::until_contact(scene, points).ok()?;
    Some(Path {
        is_reused: true,
        ..path
    })
}
