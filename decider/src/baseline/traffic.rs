//! Where obstacles will be if they keep their velocity, in the plane and along the line.

use super::Scene;
use super::idm::Leader;
use super::rollout::{STEP, STEPS};
use crate::frame::{Obstacle, ObstacleId};
use crate::geometry::{ConvexPolygon, Pose, Vec2};

/// What is farther from the car than this matters to none of the planners, m: twice the way to stop from 20 m/s.
const RANGE: f64 = 120.0;

/// Slower than this an obstacle stays where it is, m/s.
const STANDS: f64 = 0.05;

/// Room to the sides of the path that what is in it has to leave, m.
const SIDEWAYS: f64 = 0.1;

/// An obstacle at one time.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Moment {
    /// Its middle, and its outline, in world coordinates.
    pub(super) center: Vec2,
    pub(super) outline: ConvexPolygon,
    /// From and to along the line, m.
    s: (f64, f64),
    /// From right to left across it, m.
    l: (f64, f64),
}

/// An obstacle over time.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Body {
    pub(super) id: ObstacleId,
    /// Radius of the circle around its middle that holds it, m.
    pub(super) radius: f64,
    velocity: Vec2,
    /// One per step; one in all if it stands.
    moments: Vec<Moment>,
}

impl Body {
    fn of(obstacle: &Obstacle, scene: &Scene) -> Self {
        let stands = obstacle.is_static || obstacle.speed() < STANDS;
        let velocity = if stands { Vec2::zeros() } else { obstacle.velocity };
        let mut near = f64::NAN;
        let count = if stands { 1 } else { STEPS + 1 };
        let moment = |k: usize| {
            let moved = obstacle.pose.position() + velocity * (k as f64 * STEP);
            let pose = Pose::new(moved.x, moved.y, obstacle.pose.theta);
            Moment::of(obstacle, pose, scene, &mut near)
        };
        let corners = obstacle.shape.vertices().iter();
        Self {
            id: obstacle.id,
            radius: corners.map(nalgebra::Matrix::norm).fold(0.0, f64::max),
            velocity,
            moments: (0..count).map(moment).collect(),
        }
    }

    /// Where it is after so many steps.
    pub(super) fn at(&self, step: usize) -> &Moment {
        &self.moments[step.min(self.moments.len() - 1)]
    }
}

impl Moment {
    /// `near` is a station of the obstacle a moment ago, not-a-number if there is none.
    fn of(obstacle: &Obstacle, pose: Pose, scene: &Scene, near: &mut f64) -> Self {
        let outline = obstacle.shape.at(pose);
        let (mut s, mut l) = ((f64::MAX, -f64::MAX), (f64::MAX, -f64::MAX));
        for vertex in outline.vertices() {
            let at = (scene.project)(*vertex, *near);
            *near = at.s;
            s = (s.0.min(at.s), s.1.max(at.s));
            l = (l.0.min(at.l), l.1.max(at.l));
        }
        Self {
            center: pose.position(),
            outline,
            s,
            l,
        }
    }
}

impl Moment {
    /// Whether it is behind the car and in its way: it looks out for itself, and would not drive through the car.
    fn follows(&self, scene: &Scene) -> bool {
        let ([s, ..], [l, ..]) = (scene.initial.s, scene.initial.l);
        let reach = scene.vehicle.half_width() + SIDEWAYS;
        self.s.1 < s - scene.vehicle.back_edge_to_center && self.l.0 < l + reach && self.l.1 > l - reach
    }
}

/// What a planner sees of the obstacles. Nothing by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Traffic {
    pub(super) bodies: Vec<Body>,
}

impl Traffic {
    /// The obstacles near the car.
    pub fn new(scene: &Scene) -> Self {
        let ego = scene.line.at(scene.initial.s[0]).pose.position();
        let is_near = |obstacle: &&Obstacle| (obstacle.pose.position() - ego).norm_squared() <= RANGE * RANGE;
        let near = scene.obstacles.iter().filter(is_near);
        let bodies = near.map(|obstacle| Body::of(obstacle, scene));
        Self {
            bodies: bodies.filter(|body| !body.at(0).follows(scene)).collect(),
        }
    }

    /// The nearest body ahead of the rear axle at station `s` in the path whose offset at a station is told by `path`.
    pub(super) fn leader(
        &self,
        scene: &Scene,
        step: usize,
        s: f64,
        path: impl Fn(f64) -> f64,
    ) -> Option<(ObstacleId, Leader)> {
        let reach = scene.vehicle.half_width() + SIDEWAYS;
        let is_in_path = |there: &Moment| {
            let offsets = [path(s.max(there.s.0)), path(s.max(there.s.1))];
            let low = offsets[0].min(offsets[1]) - reach;
            let high = offsets[0].max(offsets[1]) + reach;
            there.s.0 > s && there.l.0 < high && there.l.1 > low
        };
        let ahead = self.bodies.iter().filter(|body| is_in_path(body.at(step)));
        let nearest = ahead.min_by(|a, b| {
            let by_place = a.at(step).s.0.total_cmp(&b.at(step).s.0);
            by_place.then(a.id.cmp(&b.id))
        })?;
        let rear = nearest.at(step).s.0;
        let leader = Leader {
            gap: rear - s - scene.vehicle.front_edge_to_center,
            speed: nearest.velocity.dot(&scene.line.at(rear).pose.forward()),
        };
        Some((nearest.id, leader))
    }
}
