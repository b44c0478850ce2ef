//! The task as the stage runs it: from a plan's scene to its bounds.

use super::{Input, PullOver, PullOverKind};
use crate::context::Context;
use crate::frame::Command;
use crate::geometry::Vec2;
use crate::planner::{LinePlan, TaskError};
use crate::tasks::scene::Scene;

/// Decides the bounds of a plan.
///
/// # Errors
/// [`TaskError::PathBounds`] when there is none to give.
pub fn run(plan: &mut LinePlan, context: &mut Context) -> Result<(), TaskError> {
    let scene = &plan.scene;
    request_pull_over(scene, context);
    let input = Input {
        ego: scene.ego,
        ego_end_s: scene.ego_end_s(),
        obstacles: &scene.obstacles,
        config: &scene.config.path_bounds,
        vehicle: scene.vehicle,
        cruise_speed: scene.frame.cruise_speed,
        is_change_lane: scene.is_change_lane,
        path_reusable: false,
        borrow: &plan.borrow,
        destination: destination(scene),
    };
    plan.bounds = super::decide(scene.line, &input, &mut context.bounds)?;
    Ok(())
}

/// Keeps the pull-over request in step with the command.
fn request_pull_over(scene: &Scene, context: &mut Context) {
    let kind = match scene.frame.command {
        Command::PullOver(_) => Some(PullOverKind::Destination),
        Command::EmergencyPullOver => Some(PullOverKind::Emergency),
        _ => None,
    };
    let state = &mut context.bounds.pull_over;
    match kind {
        Some(kind) if state.is_requested && state.kind == kind => {}
        Some(kind) => {
            *state = PullOver {
                is_requested: true,
                kind,
                place: None,
            }
        }
        None => *state = PullOver::default(),
    }
}

fn destination(scene: &Scene) -> Option<Vec2> {
    match scene.frame.command {
        Command::PullOver(destination) => Some(destination),
        _ => None,
    }
}
