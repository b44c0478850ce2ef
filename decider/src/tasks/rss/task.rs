//! The task as the stage runs it: from the scene to what RSS says about the gap ahead.

use super::{RssBox, RssObstacle, assess, is_on_lane};
use crate::context::Context;
use crate::planner::{LinePlan, TaskError};
use crate::reference_line::LineQuery;
use crate::tasks::path_bounds::ObstacleSl;

/// Assesses the gap ahead.
///
/// # Errors
/// [`TaskError::Unsafe`] where it is too short and the settings make that a veto.
pub fn run(plan: &mut LinePlan, _: &mut Context) -> Result<(), TaskError> {
    let scene = &plan.scene;
    let vehicle = scene.vehicle;
    let ego = RssBox {
        station: (scene.ego.s - vehicle.back_edge_to_center, scene.ego_end_s()),
        offset: (
            scene.ego.l - vehicle.half_width(),
            scene.ego.l + vehicle.half_width(),
        ),
    };
    let obstacle = |obstacle: &ObstacleSl| {
        let place = RssBox {
            station: (obstacle.start_s, obstacle.end_s),
            offset: (obstacle.start_l, obstacle.end_l),
        };
        let middle = f64::midpoint(obstacle.start_s, obstacle.end_s);
        let (left, right) = scene
            .line
            .lane_width(middle.clamp(0.0, scene.line.length()))
            .unwrap_or((0.0, 0.0));
        RssObstacle {
            place,
            speed: obstacle.speed,
            is_on_lane: is_on_lane(place.offset, left, right),
        }
    };
    let obstacles: Vec<RssObstacle> = scene.obstacles.iter().map(obstacle).collect();
    let state = assess(ego, scene.start.v, &obstacles);
    plan.rss = Some(state);
    if !state.is_safe && scene.config.speed.enable_rss_fallback {
        return Err(TaskError::Unsafe);
    }
    Ok(())
}
