//! `PATH_DECIDER`: how the chosen path passes each standing obstacle: not at all, at a distance, or not.
//!
//! What blocks the path is stopped for, as far before it as can be done in comfort; a body that the path touches
//! would be the path's blocker already, so what is beside it is nudged around, and what is far aside is ignored.

use super::object_decision::{Fence, Lateral, Longitudinal};
use super::path::Path;
use super::path_bounds::ObstacleSl;
use super::piecewise_jerk_speed::stop_before;
use super::scene::Scene;
use crate::context::Context;
use crate::frame::ObstacleId;
use crate::planner::{LinePlan, TaskError};
use crate::tasks::lane_borrow;

/// Obstacles farther than this beside the body are ignored, m (the original's `lateral_ignore_buffer`).
const LATERAL_IGNORE: f64 = 3.0;

/// Distance kept by a nudge, m (the original's `static_obstacle_buffer`).
const NUDGE: f64 = 0.3;

/// How far beyond the path's end its blocker is still said to be, m.
const BEYOND_END: f64 = 1.0;

/// Decides about every standing obstacle.
///
/// # Errors
/// [`TaskError::NoPath`] without a path.
pub fn run(plan: &mut LinePlan, _: &mut Context) -> Result<(), TaskError> {
    let path = plan.path().ok_or(TaskError::NoPath)?.clone();
    for k in 0..plan.scene.obstacles.len() {
        let obstacle = plan.scene.obstacles[k];
        if !obstacle.is_static || obstacle.is_virtual {
            continue;
        }
        if path.blocked_by == Some(obstacle.id) {
            let distance = before_blocker(plan, &path, obstacle.id);
            plan.stop_before_blocker = Some(distance);
            let fence = Fence {
                distance: distance - contact(&plan.scene, &path, &obstacle),
                s: path.points[0].s + distance,
            };
            plan.decisions[k].add_longitudinal(Longitudinal::Stop(fence));
        } else {
            let lateral = beside(&plan.scene, &path, &obstacle);
            plan.decisions[k].add_lateral(lateral);
            plan.decisions[k].ignore_the_rest();
        }
    }
    if let Some(id) = path.blocked_by.filter(|_| plan.stop_before_blocker.is_none()) {
        plan.stop_before_blocker = Some(before_blocker(plan, &path, id));
    }
    Ok(())
}

/// At what distance an obstacle is passed, by the point of the path that comes nearest to it.
fn beside(scene: &Scene, path: &Path, obstacle: &ObstacleSl) -> Lateral {
    let first = path.points.partition_point(|p| p.s < obstacle.start_s);
    let last = path.points.partition_point(|p| p.s <= obstacle.end_s);
    let gap = |l: f64| (obstacle.start_l - l).max(l - obstacle.end_l);
    let near = path.points[first..last.max(first)]
        .iter()
        .chain(path.points.get(last));
    let Some(l) = near.map(|p| p.l).min_by(|a, b| gap(*a).total_cmp(&gap(*b))) else {
        return Lateral::Ignore;
    };
    let half_width = scene.vehicle.half_width();
    if gap(l) > half_width + LATERAL_IGNORE {
        Lateral::Ignore
    } else if obstacle.end_l < l {
        Lateral::Nudge(NUDGE)
    } else {
        Lateral::Nudge(-NUDGE)
    }
}

/// Where the front bumper touches an obstacle, m along the path.
fn contact(scene: &Scene, path: &Path, obstacle: &ObstacleSl) -> f64 {
    path.distance_at(obstacle.start_s - scene.vehicle.front_edge_to_center)
}

/// Where to stand before a blocker: the wanted gap if it can be kept in comfort, else what is left of it. Pulling
/// out takes more room than standing.
fn before_blocker(plan: &LinePlan, path: &Path, id: ObstacleId) -> f64 {
    let scene = &plan.scene;
    let config = &scene.config.speed;
    let contact = scene
        .obstacle(id)
        .map_or(path.length(), |obstacle| contact(scene, path, obstacle));
    let contact = contact.min(path.length() + BEYOND_END);
    let may_pull_out = plan
        .borrow_leads_on
        .unwrap_or_else(|| lane_borrow::is_permitted(scene));
    let gap = if may_pull_out {
        config.pull_out_distance
    } else {
        config.stop_distance
    };
    stop_before(config, scene.start.v, contact, gap)
        .min(path.length())
        .max(0.0)
}
