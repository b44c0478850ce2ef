//! From the world to what a decider sees of it: obstacles in range, with predictions, and the ego.
//!
//! Perception is ideal but for two things: numbers are rounded to [`RESOLUTION`], and nobody's intentions are
//! seen. Who follows a line is expected to go on along it at the speed and offset of now; all others go straight
//! on. Only recorded traffic is expected to do what it then does: a record is what such a scene gives for a
//! prediction. A car that stands in traffic and a pedestrian who waits are not static: they are predicted to stay.

use crate::agents::Agents;
use crate::world::{ObstacleBody, World};
use corridor_decider::frame::{EgoState, Obstacle, PredictedPose};
use corridor_decider::geometry::{Pose, Vec2};
use std::f64::consts::PI;

/// How far the sensors see from the ego's reference point to an obstacle's centre, m: who goes out to pass has to
/// see what comes in the time that takes.
pub const SENSOR_RANGE: f64 = 200.0;

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

/// Puts the true futures in the place of the predictions.
pub fn foresee(obstacles: &mut [Obstacle], world: &World, agents: &Agents) {
    if obstacles.iter().all(|obstacle| obstacle.prediction.is_empty()) {
        return;
    }
    let mut futures = agents.futures(&world.ego(), world.dt());
    for obstacle in obstacles.iter_mut().filter(|o| !o.prediction.is_empty()) {
        let future = std::mem::take(&mut futures[obstacle.id.0 as usize]);
        obstacle.prediction = future.into_iter().map(rounded).collect();
    }
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
    Obstacle {
        id: body.id,
        kind: body.kind,
        pose: round_pose(body.pose),
        shape: body.shape.clone(),
        velocity: Vec2::new(round(body.velocity.x), round(body.velocity.y)),
        is_static: !agents.moves(body.id),
        prediction: agents.predict(body.id).into_iter().map(rounded).collect(),
    }
}

fn rounded(expected: PredictedPose) -> PredictedPose {
    PredictedPose {
        t: expected.t,
        pose: round_pose(expected.pose),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{along, line, road, scenario};
    use crate::world::PhysicsConfig;
    use corridor_scenarios::scenario::{Behaviour, Trigger};

    fn scene() -> (World, Agents) {
        let line = line(&road(Pose::new(0.0, 0.0, 0.0), 0.0, 600.0));
        let behaviours = vec![
            Behaviour::Parked(Pose::new(40.0, -3.0, PI)),
            Behaviour::ConstantSpeed(along(&line, 30.0, 3.5, 1.0 / 3.0)),
            Behaviour::Parked(Pose::new(250.0, 0.0, 0.0)),
            Behaviour::Pedestrian {
                from: Vec2::new(90.0, 0.0),
                to: Vec2::new(90.0, 9.0),
                speed: 1.5,
                trigger: Trigger::Time(0.5),
            },
        ];
        let scenario = scenario(Pose::new(0.0, 0.0, 0.0), 10.0, behaviours);
        let mut world = World::new(&scenario, &PhysicsConfig::default());
        let mut agents = Agents::new(&scenario);
        for _ in 0..77 {
            let moved = agents.advance(&world.ego(), world.dt());
            world.step(
                crate::trace::Controls {
                    steer: 0.1,
                    acceleration: 0.3,
                },
                moved,
            );
        }
        (world, agents)
    }

    #[test]
    fn what_is_far_is_not_seen_and_only_the_parked_is_static() {
        let (world, agents) = scene();
        let seen = observe(&world, &agents, SENSOR_RANGE);
        let ids: Vec<(u32, bool, usize)> = seen
            .iter()
            .map(|o| (o.id.0, o.is_static, o.prediction.len()))
            .collect();
        assert_eq!(ids, [(0, true, 0), (1, false, 17), (3, false, 17)]);
        assert_eq!(seen[2].velocity, Vec2::new(0.0, 1.5), "it has begun to walk");
    }

    #[test]
    fn numbers_are_short_near_and_survive_a_file() {
        let (world, agents) = scene();
        let seen = observe(&world, &agents, SENSOR_RANGE);
        let (body, car) = (&world.obstacles()[1], &seen[1]);
        let off = (car.pose.x - body.pose.x).abs();
        assert!(off > 0.0 && off <= 0.5 / RESOLUTION);
        assert_eq!(car.velocity, Vec2::new(0.3333, 0.0));
        let angle = seen[0].pose.theta;
        assert!(angle <= PI && PI - angle < 1.0 / RESOLUTION, "{angle}");
        let text = serde_json::to_string(&(&seen, localise(&world))).unwrap();
        let decimals = |number: &str| number.split('.').nth(1).map_or(0, str::len);
        let numbers = text.split(|c: char| !(c.is_ascii_digit() || c == '.'));
        assert!(numbers.map(decimals).all(|count| count <= 4), "{text}");
        let back: (Vec<Obstacle>, EgoState) = serde_json::from_str(&text).unwrap();
        assert_eq!(back, (seen, localise(&world)));
    }
}
