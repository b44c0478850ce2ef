//! The world: the ego as a rigid body with tyres, and everything it may run into.
//!
//! World axes: metres east and north of the map's origin, angles counter-clockwise. The ego's reference point is
//! the centre of its rear axle. Nothing outside this folder knows which physics engine is used.

mod actuators;
mod axles;
mod bodies;
mod clearance;
mod hash;
mod params;
#[cfg(test)]
mod tests;

pub use bodies::{BodyPose, ObstacleBody};
pub use clearance::CLEARANCE_HORIZON;
pub(crate) use hash::Fnv;
pub use params::{DynamicsParams, GRAVITY, PhysicsConfig};

use crate::agents;
use crate::trace::Controls;
use actuators::Actuators;
use axles::{Axles, BodyVelocity};
use bodies::{ego_body, ego_collider, from_rapier, obstacle_body, obstacle_collider, to_rapier};
use clearance::{Outline, Proximity};
use corridor_decider::frame::{EgoState, ObstacleId};
use corridor_decider::geometry::{ConvexPolygon, Pose};
use corridor_decider::vehicle::VehicleParams;
use corridor_scenarios::Scenario;
use rapier2d::dynamics::RigidBodyHandle;
use rapier2d::geometry::ColliderHandle;
use rapier2d::math::{Pose as RapierPose, Rot2, Vector};
use rapier2d::pipeline::PhysicsWorld;

/// An obstacle in the engine.
struct EngineBody {
    handle: RigidBodyHandle,
    /// Whether it is near enough to take part.
    engaged: bool,
}

/// Sub-steps of the contact solver. The ego's own motion needs one; a collision ends the run, so its aftermath
/// need not be beautiful.
const SOLVER_ITERATIONS: usize = 1;

/// An obstacle takes part in the engine's work from this distance on, and until that one, m. Two cars that meet at
/// 40 m/s each close 0.8 m in a step; nothing can be touched unseen. Bodies farther off would cost three times
/// what the ego's own motion does and change nothing.
const ENGAGE: f64 = 5.0;
const RELEASE: f64 = 8.0;

/// The ego and the obstacles, advanced in fixed steps.
pub struct World {
    physics: PhysicsWorld,
    ego_body: RigidBodyHandle,
    ego_collider: ColliderHandle,
    obstacle_bodies: Vec<EngineBody>,
    obstacles: Vec<ObstacleBody>,
    outlines: Vec<Outline>,
    ego_outline: Outline,
    proximity: Proximity,
    touched: Vec<ObstacleId>,
    vehicle: VehicleParams,
    dynamics: DynamicsParams,
    actuators: Actuators,
    axles: Axles,
    ego: EgoState,
    dt: f64,
}

impl World {
    /// The scenario's world at its start.
    pub fn new(scenario: &Scenario, config: &PhysicsConfig) -> Self {
        let mut physics = PhysicsWorld {
            gravity: Vector::ZERO,
            ..PhysicsWorld::default()
        };
        physics.integration_parameters.dt = config.dt;
        physics.integration_parameters.num_solver_iterations = SOLVER_ITERATIONS;
        let (vehicle, start) = (scenario.vehicle, scenario.ego);
        let (ego_body, ego_collider) = physics.insert(
            ego_body(start.pose, start.speed, &config.dynamics),
            ego_collider(&vehicle),
        );
        let mut world = Self {
            physics,
            ego_body,
            ego_collider,
            obstacle_bodies: Vec::new(),
            obstacles: Vec::new(),
            outlines: Vec::new(),
            ego_outline: Outline::new(&vehicle.footprint(Pose::new(0.0, 0.0, 0.0)), start.pose),
            proximity: Proximity::default(),
            touched: Vec::new(),
            vehicle,
            dynamics: config.dynamics,
            actuators: Actuators::new(),
            axles: Axles::new(&vehicle, &config.dynamics, config.dt),
            ego: EgoState {
                pose: start.pose,
                v: start.speed,
                a: 0.0,
                yaw_rate: 0.0,
                steer: 0.0,
            },
            dt: config.dt,
        };
        for obstacle in &scenario.obstacles {
            world.insert(obstacle);
        }
        world.engage_near_obstacles();
        world.proximity.update(&world.ego_outline, &world.outlines);
        world
    }

    fn insert(&mut self, obstacle: &corridor_scenarios::scenario::Obstacle) {
        let start = agents::start_of(obstacle);
        let body = obstacle_body(start.pose, agents::can_move(obstacle));
        let (handle, _) = self.physics.insert(body, obstacle_collider(&obstacle.shape));
        let engaged = false;
        self.obstacle_bodies.push(EngineBody { handle, engaged });
        self.outlines.push(Outline::new(&obstacle.shape, start.pose));
        self.obstacles.push(ObstacleBody {
            id: start.id,
            kind: obstacle.kind,
            shape: obstacle.shape.clone(),
            pose: start.pose,
            velocity: start.velocity,
        });
    }

    /// One physics step: the actuators follow `controls`, the obstacles named in `moved` go to their new
    /// poses, the ego moves by its tyres and by what hits it.
    pub fn step(&mut self, controls: Controls, moved: &[BodyPose]) {
        self.actuators
            .advance(controls, &self.vehicle, &self.dynamics, self.dt);
        self.move_obstacles(moved);
        self.engage_near_obstacles();
        self.push_ego();
        self.physics.step();
        self.read_ego();
        self.read_contacts();
        self.proximity.update(&self.ego_outline, &self.outlines);
    }

    /// Length of one step, s.
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// The ego's motion now.
    pub fn ego(&self) -> EgoState {
        self.ego
    }

    /// The ground the ego covers now.
    pub fn ego_footprint(&self) -> ConvexPolygon {
        self.vehicle.footprint(self.ego.pose)
    }

    /// All obstacles; the place of one is its [`ObstacleId`].
    pub fn obstacles(&self) -> &[ObstacleBody] {
        &self.obstacles
    }

    /// Distance to the nearest obstacle, m, and which; `None` when none is within [`CLEARANCE_HORIZON`].
    pub fn clearance(&self) -> Option<(f64, ObstacleId)> {
        self.proximity.nearest
    }

    /// Obstacles whose outline overlaps the ego's now, in ascending order. Touching is not overlapping.
    pub fn overlaps(&self) -> impl Iterator<Item = ObstacleId> + '_ {
        self.proximity.overlaps.iter().copied()
    }

    /// Obstacles that the engine's contact solver has pushed the ego away from so far. Speculative, up to
    /// centimetres early: a cross-check of [`World::overlaps`] and nothing more.
    pub fn contacts_seen(&self) -> &[ObstacleId] {
        &self.touched
    }

    /// Hash over the exact bits of everything that moves: ego, actuators, obstacles in their order.
    pub fn state_hash(&self) -> u64 {
        let mut hash = Fnv::new();
        let body = &self.physics.bodies[self.ego_body];
        let (place, turn) = (body.translation(), body.rotation());
        hash.numbers([place.x, place.y, turn.re, turn.im]);
        hash.numbers([body.linvel().x, body.linvel().y, body.angvel()]);
        hash.numbers([self.actuators.steer, self.actuators.acceleration, self.ego.a]);
        for obstacle in &self.obstacles {
            hash.numbers([obstacle.pose.x, obstacle.pose.y, obstacle.pose.theta]);
            hash.numbers([obstacle.velocity.x, obstacle.velocity.y]);
        }
        hash.finish()
    }

    fn move_obstacles(&mut self, moved: &[BodyPose]) {
        for to in moved {
            let place = to.id.0 as usize;
            let Some(obstacle) = self.obstacles.get_mut(place) else {
                continue;
            };
            obstacle.velocity = to.velocity;
            if obstacle.pose == to.pose {
                continue;
            }
            obstacle.pose = to.pose;
            let pose = to_rapier(to.pose);
            self.outlines[place].move_to(to.pose, pose);
            let body = &self.obstacle_bodies[place];
            if body.engaged {
                self.physics.bodies[body.handle].set_next_kinematic_position(pose);
            }
        }
    }

    /// Lets the obstacles near the ego take part in the engine's work, and no others.
    fn engage_near_obstacles(&mut self) {
        for (body, outline) in self.obstacle_bodies.iter_mut().zip(&self.outlines) {
            let limit = if body.engaged { RELEASE } else { ENGAGE };
            let near = !self.ego_outline.is_beyond(outline, limit);
            if near != body.engaged {
                let in_engine = &mut self.physics.bodies[body.handle];
                in_engine.set_position(outline.placed(), true);
                in_engine.set_enabled(near);
                body.engaged = near;
            }
        }
    }

    /// Replaces the ego's velocity by the one its tyres leave it with.
    fn push_ego(&mut self) {
        let body = &mut self.physics.bodies[self.ego_body];
        let (velocity, yaw) = (body.linvel(), body.angvel());
        let frame = mid_step_frame(*body.rotation(), yaw * self.dt);
        let local = frame.inverse_transform_vector(velocity);
        let before = BodyVelocity {
            forward: local.x,
            left: local.y,
            yaw,
        };
        let after = self
            .axles
            .step(before, self.actuators.steer, self.actuators.acceleration);
        let velocity = frame.transform_vector(Vector::new(after.forward, after.left));
        body.set_linvel(velocity, true);
        body.set_angvel(after.yaw, true);
    }

    fn read_ego(&mut self) {
        let body = &self.physics.bodies[self.ego_body];
        let pose = from_rapier(body.position());
        let v = body.rotation().inverse_transform_vector(body.linvel()).x;
        self.ego = EgoState {
            pose,
            v,
            a: (v - self.ego.v) / self.dt,
            yaw_rate: body.angvel(),
            steer: self.actuators.steer,
        };
        let placed: RapierPose = *body.position();
        self.ego_outline.move_to(pose, placed);
    }

    fn read_contacts(&mut self) {
        for pair in self.physics.narrow_phase.contact_pairs_with(self.ego_collider) {
            if !pair.has_any_active_contact() {
                continue;
            }
            let other = if pair.collider1 == self.ego_collider {
                pair.collider2
            } else {
                pair.collider1
            };
            let parent = self.physics.colliders.get(other).and_then(|c| c.parent());
            let place = self.obstacle_bodies.iter().position(|b| Some(b.handle) == parent);
            if let Some(obstacle) = place.map(|place| self.obstacles[place].id)
                && !self.touched.contains(&obstacle)
            {
                self.touched.push(obstacle);
            }
        }
    }
}

/// The body's axes halfway through a step in which it turns by `turn` rad. Tyres that act along these keep
/// the error of a turning step at second order. Without a sine: `tan(turn/4)` is `turn/4` here.
fn mid_step_frame(rotation: Rot2, turn: f64) -> Rot2 {
    let h = turn / 4.0;
    let scale = 1.0 / (1.0 + h * h);
    rotation * Rot2::from_cos_sin_unchecked((1.0 - h * h) * scale, 2.0 * h * scale)
}
