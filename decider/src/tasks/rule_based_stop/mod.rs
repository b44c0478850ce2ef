//! `RULE_BASED_STOP_DECIDER`: where the car stands on its path, whatever moves: the place to pull over, before what
//! blocks the path, the end of the route, or the end of the path; and, where that is asked for, to look before it goes
//! out of its lane, or to wait for the one that it has to change to.

mod config;
mod side_pass;
mod urgency;

pub use config::RuleBasedStopConfig;

use super::path::Path;
use super::path_bounds::Label;
use super::scene::Scene;
use crate::context::Context;
use crate::decision::{Stop, StopCause};
use crate::planner::{LinePlan, TaskError};
use crate::reference_line::LineQuery;

/// A path that ends this near to the end of its line ends with it, m.
const END_TOLERANCE: f64 = 2.0;

/// Finds the wall of the chosen path.
///
/// # Errors
/// [`TaskError::NoPath`] without one.
pub fn run(plan: &mut LinePlan, context: &mut Context) -> Result<(), TaskError> {
    let path = plan.path().ok_or(TaskError::NoPath)?;
    let place = pull_over(plan, context, path).filter(|stop| stop.distance <= path.length());
    let end = place.unwrap_or_else(|| end_of(plan, path));
    let look = side_pass::stop(plan, path, context);
    let wait = urgency::stop(&plan.scene, path);
    let walls = [look, wait].into_iter().flatten();
    plan.wall = Some(walls.fold(end, nearer));
    Ok(())
}

fn nearer(one: Stop, other: Stop) -> Stop {
    if other.distance < one.distance { other } else { one }
}

/// The place to stand at the road's edge: one chosen to stop at needs no gap beyond what its own search has kept.
fn pull_over(plan: &LinePlan, context: &Context, path: &Path) -> Option<Stop> {
    let place = context
        .bounds
        .pull_over
        .place
        .filter(|_| plan.label() == Some(Label::PullOver))?;
    let scene = &plan.scene;
    let s = scene.line.to_frenet(place.position).s - scene.config.speed.pull_over_early;
    Some(Stop {
        distance: path.distance_at(s).max(0.0),
        cause: StopCause::PullOver,
    })
}

/// What ends the path.
fn end_of(plan: &LinePlan, path: &Path) -> Stop {
    let fence = plan.stop_before_blocker;
    if let (Some(id), Some(fence)) = (path.blocked_by, fence) {
        return Stop {
            distance: fence,
            cause: StopCause::Blocked(id),
        };
    }
    let cause = if ends_with_line(&plan.scene, path) {
        StopCause::Destination
    } else {
        StopCause::PathEnd
    };
    Stop {
        distance: path.length(),
        cause,
    }
}

fn ends_with_line(scene: &Scene, path: &Path) -> bool {
    path.end_s() + END_TOLERANCE > scene.line.length()
}
