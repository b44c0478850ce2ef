//! The world: the ego as a rigid body with tyres, and everything it may run into.
//!
//! World axes: metres east and north of the map's origin, angles counter-clockwise. The ego's reference point is
//! the centre of its rear axle. Nothing outside this folder knows which physics engine is used.

mod actuators;
mod axles;
mod bodies;
mod clearance;
#[cfg(test)]
mod collision_tests;
mod hash;
mod motion;
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
use axles::Axles;
use bodies::{ego_body, ego_collider, from_rapier, obstacle_body, obstacle_collider, to_rapier};
use clearance::{Outline, Proximity};
use corridor_decider::frame::{EgoState, ObstacleId};
use corridor_decider::geometry::{ConvexPolygon, Pose};
use corridor_decider::vehicle::VehicleParams;
use corridor_scenarios::Scenario;
use motion::Motion;
use rapier2d::dynamics::RigidBodyHandle;
use rapier2d::geometry::{Collider, ColliderHandle};
use rapier2d::math::Vector;
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

/// The engine is asked while something may come nearer than this in the coming step, m; its contacts begin two
/// centimetres apart.
const CONTACT_MARGIN: f64 = 0.1;
/// Once asked, it goes on until nothing is within this many times that distance.
const RELEASE_FACTOR: f64 = 2.0;
/// Obstacles whose circle is farther than this from the ego's take no part even then, m.
const ENGAGE: f64 = 2.0;

/// The ego and the obstacles, advanced in fixed steps.
pub struct World {
    physics: PhysicsWorld,
    ego_body: RigidBodyHandle,
    /// Whether the engine's ego is where the ego is.
    engine_in_step: bool,
    motion: Motion,
    ego_collider: ColliderHandle,
    obstacle_bodies: Vec<EngineBody>,
    obstacles: Vec<ObstacleBody>,
    outlines: Vec<Outline>,
    ego_outline: Outline,
    proximity: Proximity,
    touched: Vec<ObstacleId>,
    pushed: Vec<ObstacleId>,
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
        // No sweeping: a step is shorter than any body, and a clamped ego would hide an overlap.
        physics.integration_parameters.max_ccd_substeps = 0;
        let (vehicle, start) = (scenario.vehicle, scenario.ego);
        let (ego_body, ego_collider) =
            physics.insert(ego_body(start.pose, &config.dynamics), ego_collider(&vehicle));
        let velocity = start.pose.forward() * start.speed;
        let motion = Motion {
            pose: to_rapier(start.pose),
            velocity: Vector::new(velocity.x, velocity.y),
            yaw: 0.0,
        };
        let mut world = Self {
            physics,
            ego_body,
            engine_in_step: false,
            motion,
            ego_collider,
            obstacle_bodies: Vec::new(),
            obstacles: Vec::new(),
            outlines: Vec::new(),
            ego_outline: Outline::new(&vehicle.footprint(Pose::new(0.0, 0.0, 0.0)), start.pose),
            proximity: Proximity::default(),
            touched: Vec::new(),
            pushed: Vec::new(),
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
        self.pushed.clear();
        self.actuators
            .advance(controls, &self.vehicle, &self.dynamics, self.dt);
        self.move_obstacles(moved);
        self.push_ego();
        if self.engage_near_obstacles() {
            self.step_engine();
        } else {
            self.motion.coast(self.center_of_mass(), self.dt);
            self.engine_in_step = false;
        }
        self.read_ego();
        self.proximity.update(&self.ego_outline, &self.outlines);
    }

    /// One step without physics for the ego: it is put where `ego` says, the obstacles named in `moved` go to their
    /// new poses. Overlaps are found as ever.
    pub fn place(&mut self, ego: EgoState, moved: &[BodyPose]) {
        self.pushed.clear();
        self.move_obstacles(moved);
        let velocity = ego.pose.forward() * ego.v;
        let swing = ego.pose.forward() * (ego.yaw_rate * self.dynamics.center_of_mass);
        self.motion = Motion {
            pose: to_rapier(ego.pose),
            velocity: Vector::new(velocity.x - swing.y, velocity.y + swing.x),
            yaw: ego.yaw_rate,
        };
        self.actuators.hold(ego.steer, ego.a);
        self.engine_in_step = false;
        self.read_ego();
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

    /// Obstacles that hit the ego in this step: their outlines overlap, or would have by the end of the step
    /// had the engine not pushed the bodies apart. Without the latter a body that shoves the ego would never
    /// count, because it never gets inside.
    pub fn hits(&self) -> impl Iterator<Item = ObstacleId> + '_ {
        let pushed = self
            .pushed
            .iter()
            .copied()
            .filter(|id| !self.proximity.overlaps.contains(id));
        self.overlaps().chain(pushed)
    }

    /// Obstacles that the engine's contact solver has pushed the ego away from so far. Speculative, up to
    /// centimetres early: a cross-check of [`World::overlaps`] and nothing more.
    pub fn contacts_seen(&self) -> &[ObstacleId] {
        &self.touched
    }

    /// Hash over the exact bits of everything that moves: ego, actuators, obstacles in their order.
    pub fn state_hash(&self) -> u64 {
        let mut hash = Fnv::new();
        let Motion { pose, velocity, yaw } = self.motion;
        hash.numbers([
            pose.translation.x,
            pose.translation.y,
            pose.rotation.re,
            pose.rotation.im,
        ]);
        hash.numbers([velocity.x, velocity.y, yaw]);
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

    /// Lets the obstacles near the ego take part in the engine's work, and no others. Says whether any does.
    fn engage_near_obstacles(&mut self) -> bool {
        let contact_possible = self.contact_possible();
        let mut any = false;
        for (body, outline) in self.obstacle_bodies.iter_mut().zip(&self.outlines) {
            let near = contact_possible && !self.ego_outline.is_beyond(outline, ENGAGE);
            if near != body.engaged {
                let in_engine = &mut self.physics.bodies[body.handle];
                in_engine.set_position(outline.placed(), true);
                in_engine.set_enabled(near);
                body.engaged = near;
            }
            any |= near;
        }
        any
    }

    /// Whether the ego and the nearest obstacle may touch in the coming step.
    fn contact_possible(&self) -> bool {
        let fastest = |v: f64, o: &ObstacleBody| v.max(o.velocity.norm_squared());
        let obstacle_speed = self.obstacles.iter().fold(0.0, fastest).sqrt();
        let ego_speed = self.motion.velocity.length() + self.motion.yaw.abs() * self.vehicle.length;
        let range = CONTACT_MARGIN + (ego_speed + obstacle_speed) * self.dt;
        let limit = if self.engine_in_step {
            RELEASE_FACTOR * range
        } else {
            range
        };
        self.clearance().is_some_and(|(distance, _)| distance <= limit)
    }

    fn center_of_mass(&self) -> Vector {
        Vector::new(self.dynamics.center_of_mass, 0.0)
    }

    /// Replaces the ego's velocity by the one its tyres leave it with.
    fn push_ego(&mut self) {
        let Actuators {
            steer, acceleration, ..
        } = self.actuators;
        let axles = &self.axles;
        self.motion
            .push(self.dt, |before| axles.step(before, steer, acceleration));
    }

    /// Moves the ego by the engine, which lets it collide.
    fn step_engine(&mut self) {
        let body = &mut self.physics.bodies[self.ego_body];
        if !self.engine_in_step {
            body.set_position(self.motion.pose, true);
            self.engine_in_step = true;
        }
        body.set_linvel(self.motion.velocity, true);
        body.set_angvel(self.motion.yaw, true);
        self.physics.step();
        let body = &self.physics.bodies[self.ego_body];
        self.motion = Motion {
            pose: *body.position(),
            velocity: body.linvel(),
            yaw: body.angvel(),
        };
        self.read_contacts();
    }

    fn read_ego(&mut self) {
        let pose = from_rapier(&self.motion.pose);
        let v = self.motion.speed();
        self.ego = EgoState {
            pose,
            v,
            a: (v - self.ego.v) / self.dt,
            yaw_rate: self.motion.yaw,
            steer: self.actuators.steer,
        };
        self.ego_outline.move_to(pose, self.motion.pose);
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
            let parent = self.physics.colliders.get(other).and_then(Collider::parent);
            let place = self.obstacle_bodies.iter().position(|b| Some(b.handle) == parent);
            let Some(obstacle) = place.map(|place| self.obstacles[place].id) else {
                continue;
            };
            if !self.touched.contains(&obstacle) {
                self.touched.push(obstacle);
            }
            if pair.total_impulse_magnitude() > 0.0 {
                self.pushed.push(obstacle);
            }
        }
    }
}
