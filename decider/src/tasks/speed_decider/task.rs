//! The task as the stage runs it: from the first profile to a decision about each moving obstacle.

use super::{Object, Question, decide};
use crate::context::Context;
use crate::frame::{Obstacle, ObstacleKind};
use crate::planner::{LinePlan, TaskError};

/// Decides about the moving obstacles on the path.
///
/// # Errors
/// [`TaskError::SpeedDecider`] where the profile goes through one.
pub fn run(plan: &mut LinePlan, context: &mut Context) -> Result<(), TaskError> {
    let (Some(profile), Some(path), Some(wall)) = (&plan.heuristic, plan.path(), plan.wall) else {
        return Err(TaskError::NoPath);
    };
    let scene = &plan.scene;
    let front = |distance: f64| path.station_at(distance) + scene.vehicle.front_edge_to_center;
    let question = Question {
        profile,
        init_v: scene.start.v,
        init_theta: scene.start.pose.theta,
        ego_start_s: scene.ego.s - scene.vehicle.back_edge_to_center,
        ego_length: scene.vehicle.length,
        main_stop_s: front(wall.distance),
        now: scene.frame.time,
        front_station: &front,
    };
    let moving: Vec<usize> = (0..scene.obstacles.len())
        .filter(|k| !scene.obstacles[*k].is_static)
        .collect();
    let mut objects: Vec<Object> = moving.iter().map(|k| object(plan, *k)).collect();
    let result = decide(&question, &mut objects, &mut context.pedestrians);
    let decisions: Vec<_> = objects.iter().map(|object| object.decision).collect();
    for (k, decision) in moving.into_iter().zip(decisions) {
        plan.decisions[k] = decision;
    }
    result.map_err(Into::into)
}

fn object<'a>(plan: &'a LinePlan, k: usize) -> Object<'a> {
    let scene = &plan.scene;
    let sl = &scene.obstacles[k];
    let seen: Option<&Obstacle> = scene.frame.obstacles.iter().find(|obstacle| obstacle.id == sl.id);
    let there = plan.on_path.iter().find(|there| there.id == sl.id);
    Object {
        id: sl.id,
        boundary: there.map(|there| &there.boundary),
        is_virtual: false,
        is_pedestrian: seen.is_some_and(|obstacle| obstacle.kind == ObstacleKind::Pedestrian),
        is_blocking: there.is_some(),
        is_on_lane: true,
        speed: sl.speed,
        velocity: seen.map_or_else(Default::default, |obstacle| obstacle.velocity),
        station: (sl.start_s, sl.end_s),
        offset: (sl.start_l, sl.end_l),
        decision: plan.decisions[k],
        reason: None,
    }
}
