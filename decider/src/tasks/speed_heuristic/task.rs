//! The task as the stage runs it: from what is on the path to a first profile.

use super::search;
use crate::context::Context;
use crate::planner::{LinePlan, TaskError};
use crate::st_graph::{S_HORIZON, SpeedData, SpeedLimit, SpeedPoint, StGraphData, StObstacle};
use crate::tasks::speed_bounds::Envelope;

/// With less than this to the wall there is nothing to search, m.
const NO_WAY: f64 = 0.5;

/// Distance between the entries of the speed limit, m.
const LIMIT_STEP: f64 = 1.0;

/// Searches the first profile up to the wall.
///
/// # Errors
/// [`TaskError::SpeedHeuristic`] where there is none.
pub fn run(plan: &mut LinePlan, _: &mut Context) -> Result<(), TaskError> {
    let (Some(envelope), Some(wall)) = (&plan.envelope, plan.wall) else {
        return Err(TaskError::NoPath);
    };
    let scene = &plan.scene;
    let total_time = scene.config.speed.total_time;
    if wall.distance < NO_WAY {
        plan.heuristic = Some(standing(total_time));
        return Ok(());
    }
    let way = wall.distance.min(S_HORIZON);
    let obstacle = |boundary| StObstacle {
        boundary,
        repels: true,
    };
    let graph = StGraphData {
        obstacles: plan
            .on_path
            .iter()
            .map(|there| obstacle(there.boundary.clone()))
            .collect(),
        init_v: scene.start.v,
        init_a: scene.start.a,
        speed_limit: limit(envelope, way),
        cruise_speed: scene.cruise_speed,
        path_length: way,
        total_time,
    };
    let config = scene.config.speed_heuristic(scene.is_change_lane);
    let found = search(config, scene.vehicle, &graph)?;
    plan.heuristic = Some(lasting(found.speed, total_time));
    Ok(())
}

/// The speed limit along the path.
fn limit(envelope: &Envelope, length: f64) -> SpeedLimit {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a path's length"
    )]
    let count = (length / LIMIT_STEP).ceil() as usize + 1;
    let entry = |k: usize| {
        let s = k as f64 * LIMIT_STEP;
        (s, envelope.at(s))
    };
    SpeedLimit::new((0..count.max(2)).map(entry).collect()).expect("two or more entries in ascending order")
}

fn standing(total_time: f64) -> SpeedData {
    let at = |t| SpeedPoint {
        t,
        ..SpeedPoint::default()
    };
    SpeedData::new(vec![at(0.0), at(total_time)])
}

/// A profile that reaches the wall early stays there.
fn lasting(mut profile: SpeedData, total_time: f64) -> SpeedData {
    if let Some(last) = profile.points.last().copied().filter(|last| last.t < total_time) {
        profile.points.push(SpeedPoint {
            t: total_time,
            v: 0.0,
            a: 0.0,
            ..last
        });
    }
    profile
}
