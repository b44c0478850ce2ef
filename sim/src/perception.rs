//! From the world to what a decider sees of it: obstacles in range, with predictions, and the ego.
//!
//! Perception is ideal but for two things: numbers are rounded to [`RESOLUTION`], and nobody's intentions are
//! seen. Who follows a line is expected to go on along it at the speed and offset of now; all others go straight
//! on. A car that stands in traffic and a pedestrian who waits are not static: they are predicted to stay.

use crate::agents::Agents;
use crate::world::{ObstacleBody, World};
use corridor_decider::frame::{EgoState, Obstacle, PredictedPose};
use corridor_decider::geometry::{Pose, Vec2};
use std::f64::consts::PI;

/// How far the sensors see from the ego's reference point to an obstacle's centre, m.
pub const SENSOR_RANGE: f64 = 120.0;

/// Units per metre, radian and metre per second to which numbers are rounded, 1/m: a tenth of a millimetre.
/// Finer than any decision, and short in a file.
pub const RESOLUTION: f64 = 1e4;

/// The obstacles within `range` metres of the ego, in ascending order of identity.
pub fn observe(world: &World, agents: &Agents, range: f64) -> Vec<Obstacle> {
    let ego = world.ego().pose.position();
    let in_range = |body: &&ObstacleBody| (body.pose.position() - ego).norm_squared() <= range * range;
    world
        .obstacles()
        .iter()
        .filter(in_range)
        .map(|body| perceive(body, agents))
        .collect()
}

/// The ego as localised: rounded like everything else.
pub fn localise(world: &World) -> EgoState {
    let ego = world.ego();
    EgoState {
        pose: round_pose(ego.pose),
        v: round(ego.v),
        a: round(ego.a),
        yaw_rate: round(ego.yaw_rate),
        steer: round(ego.steer),
    }
}

fn perceive(body: &ObstacleBody, agents: &Agents) -> Obstacle {
    let seen = |expected: PredictedPose| PredictedPose {
        t: expected.t,
        pose: round_pose(expected.pose),
    };
    Obstacle {
        id: body.id,
        kind: body.kind,
        pose: round_pose(body.pose),
        shape: body.shape.clone(),
        velocity: Vec2::new(round(body.velocity.x), round(body.velocity.y)),
        is_static: !agents.moves(body.id),
        prediction: agents.predict(body.id).into_iter().map(seen).collect(),
    }
}

/// The nearest number with four decimals.
fn round(value: f64) -> f64 {
    // The sum turns a negative zero into the plain one, which prints shorter.
    (value * RESOLUTION).round() / RESOLUTION + 0.0
}

fn round_pose(pose: Pose) -> Pose {
    // π itself would round out of the half-open range of angles.
    let widest = (PI * RESOLUTION).floor() / RESOLUTION;
    Pose::new(
        round(pose.x),
        round(pose.y),
        round(pose.theta).clamp(-widest, widest),
    )
}
