//! What is driven when a tick cannot be planned: every rung of the chain, and which one it was.
//!
//! A tick has two halves. Where only the speed failed, the fresh path stays and a speed is laid on it that stops.
//! Where the path failed, the best of four other sources is taken that the car can stop on. Where there is nothing to
//! plan with at all, the car stops along the trajectory of the tick before. Each of these says so in the decision.

mod blind;
mod braking;
mod held_arc;
mod path;
mod speed;
mod speed_profile;
#[cfg(test)]
mod tests;

pub(crate) use blind::brake_on_arc;
pub use blind::{context_failure, without_context};
pub use braking::{BrakingLimits, braking_profile};
pub use speed_profile::{constant_deceleration, extract, filled, standstill};

use crate::context::LastPath;
use crate::decision::{Fallback, FallbackCause, Outcome, PathPoint, TrajectoryPoint};
use crate::planner::{LinePlan, Part};
use crate::tasks::path::Path;
use crate::trajectory;

/// What is driven in the end.
#[derive(Clone, Debug, PartialEq)]
pub struct Driven {
    /// The path; empty if there is none.
    pub path: Vec<PathPoint>,
    /// The trajectory along it.
    pub trajectory: Vec<TrajectoryPoint>,
    /// How the tick ends.
    pub outcome: Outcome,
    /// What failed and which rungs these are, if anything failed.
    pub fallback: Option<Fallback>,
}

impl Driven {
    /// This tick's own path and speed.
    pub fn planned(plan: &LinePlan, trajectory: Vec<TrajectoryPoint>) -> Self {
        let path = plan.path();
        let outcome = if path.is_some_and(|path| path.is_reused) {
            Outcome::PathReused
        } else {
            Outcome::Normal
        };
        Self {
            path: path.map(|path| path.points.clone()).unwrap_or_default(),
            trajectory,
            outcome,
            fallback: None,
        }
    }
}

/// What is driven where a plan along a line failed.
pub fn along_line(
    plan: &LinePlan,
    last: Option<&LastPath>,
    cause: FallbackCause,
    fails: &dyn Fn(Part) -> bool,
) -> Driven {
    let scene = &plan.scene;
    let quirks = &scene.config.quirks;
    let is_kept = |path: &&Path| path.points.len() >= 2 && !quirks.fallback_discards_fresh_path;
    let fresh = plan.path().filter(is_kept);
    let (rung, path) = match fresh {
        Some(path) => (None, Some(path.clone())),
        None => match path::find(plan, last, fails) {
            Some((rung, path)) => (Some(rung), Some(path)),
            None => (None, None),
        },
    };
    let Some(path) = path else {
        return emergency_stop(plan, cause);
    };
    let outcome = if rung.is_none() {
        Outcome::SpeedFallback
    } else {
        Outcome::PathFallback
    };
    let target = Some(speed::target(plan, &path));
    let (speed_rung, profile) = speed::stopping(&scene.start, scene.vehicle, target, fails);
    let mut points = path.points;
    // The gate of a fresh path did not ask whether the car can stop on it; the brakes say where that is.
    let needed = profile.points.last().map_or(0.0, |last| last.s);
    path::go_on_straight(&mut points, needed);
    let Some(trajectory) = trajectory::along(&points, &profile) else {
        return emergency_stop(plan, cause);
    };
    Driven {
        path: points,
        trajectory,
        outcome,
        fallback: Some(Fallback {
            cause,
            path: rung,
            speed: Some(speed_rung),
        }),
    }
}

/// The end of the chain.
fn emergency_stop(plan: &LinePlan, cause: FallbackCause) -> Driven {
    Driven {
        path: Vec::new(),
        trajectory: brake_on_arc(&plan.scene.start, plan.scene.vehicle),
        outcome: Outcome::EmergencyStop,
        fallback: Some(Fallback {
            cause,
            path: None,
            speed: None,
        }),
    }
}
