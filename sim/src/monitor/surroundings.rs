//! The ego and the obstacles around it as boxes in the Frenet plane of the scenario's line: who is ahead, who beside.
//!
//! A box holds every vertex of the outline, so it is exact on a straight road and wide by the sagitta of the body in a
//! bend. Velocities are split along and across the line at the body's place. Metres and m/s.

use super::view::{Motion, Sample};
use corridor_decider::frame::ObstacleId;
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle};
use corridor_decider::reference_line::{LineQuery, ReferenceLine};
use corridor_scenarios::scenario::Behaviour;

/// Obstacles whose centre is farther than this from the ego are not looked at, m: the safe distance of two that come
/// towards each other at 50 km/h.
const RANGE: f64 = 160.0;

/// One body along and across the line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Body {
    /// Rear and front.
    pub(super) s: (f64, f64),
    /// Right and left.
    pub(super) l: (f64, f64),
    /// Speed along the line.
    pub(super) v_s: f64,
    /// Speed to the left.
    pub(super) v_l: f64,
}

impl Body {
    fn of(line: &ReferenceLine, outline: &ConvexPolygon, velocity: Vec2, hint: Option<f64>) -> Self {
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut s, mut l, mut near) = (none, none, hint);
        for vertex in outline.vertices() {
            let at = near.map_or_else(
                || line.to_frenet(*vertex),
                |near| line.to_frenet_near(*vertex, near),
            );
            near = Some(at.s);
            s = (s.0.min(at.s), s.1.max(at.s));
            l = (l.0.min(at.l), l.1.max(at.l));
        }
        let (sin, cos) = angle::sin_cos(line.point(f64::midpoint(s.0, s.1)).theta);
        Self {
            s,
            l,
            v_s: velocity.x * cos + velocity.y * sin,
            v_l: velocity.y * cos - velocity.x * sin,
        }
    }

    /// Distance along the line between two bodies; negative by how much they overlap.
    pub(super) fn gap_s(&self, other: &Self) -> f64 {
        (other.s.0 - self.s.1).max(self.s.0 - other.s.1)
    }

    /// The same across the line.
    pub(super) fn gap_l(&self, other: &Self) -> f64 {
        (other.l.0 - self.l.1).max(self.l.0 - other.l.1)
    }

    /// Whether the other one's middle is ahead of this one's.
    pub(super) fn is_behind(&self, other: &Self) -> bool {
        self.s.0 + self.s.1 < other.s.0 + other.s.1
    }

    /// Whether the other one's middle is to the left of this one's.
    pub(super) fn is_right_of(&self, other: &Self) -> bool {
        self.l.0 + self.l.1 < other.l.0 + other.l.1
    }
}

/// An obstacle around the ego.
#[derive(Clone, Copy, Debug)]
pub(super) struct Neighbour {
    pub(super) id: ObstacleId,
    pub(super) body: Body,
    /// Whether it stands for the whole run.
    pub(super) is_parked: bool,
}

/// What is ahead in the strip that the ego's front covers: what its front is past sideways, it does not run into.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ahead {
    pub(super) id: ObstacleId,
    pub(super) gap: f64,
    /// Speed at which the gap closes.
    pub(super) closing: f64,
}

/// Everything around the ego at one moment.
#[derive(Clone, Debug, Default)]
pub(super) struct Surroundings {
    ego: Option<Body>,
    /// Right and left end of its front edge.
    front: (f64, f64),
    neighbours: Vec<Neighbour>,
    /// Where each obstacle was when it was last looked at: what has not moved is not projected again.
    known: Vec<Option<(Motion, Body)>>,
}

impl Surroundings {
    /// Looks around.
    pub(super) fn look(&mut self, sample: &Sample) {
        let (scenario, ego) = (sample.scenario, sample.ego());
        let line = &scenario.line;
        let velocity = ego.pose.forward() * ego.v;
        self.ego = Some(Body::of(line, sample.view.footprint, velocity, Some(sample.at.s)));
        self.front = front(sample);
        self.known.resize(scenario.obstacles.len(), None);
        self.neighbours.clear();
        for (obstacle, known) in scenario.obstacles.iter().zip(&mut self.known) {
            let motion = sample.view.traffic.motion(obstacle.id);
            if is_far(&motion.pose, &ego.pose) {
                continue;
            }
            let body = match *known {
                Some((before, body)) if before == motion => body,
                before => {
                    let hint = before.map(|(_, body)| body.s.0);
                    Body::of(line, &obstacle.shape.at(motion.pose), motion.velocity, hint)
                }
            };
            *known = Some((motion, body));
            self.neighbours.push(Neighbour {
                id: obstacle.id,
                body,
                is_parked: matches!(obstacle.behaviour, Behaviour::Parked(_)),
            });
        }
    }

    /// The ego and who is around it; nothing before the first look.
    pub(super) fn pairs(&self) -> impl Iterator<Item = (&Body, &Neighbour)> {
        let ego = self.ego.iter();
        ego.flat_map(|ego| self.neighbours.iter().map(move |other| (ego, other)))
    }

    /// What is ahead in the strip that the ego's front covers.
    pub(super) fn ahead(&self) -> impl Iterator<Item = Ahead> {
        let in_strip = |(ego, other): &(&Body, &Neighbour)| {
            let is_beside = other.body.l.0 >= self.front.1 || other.body.l.1 <= self.front.0;
            !is_beside && ego.is_behind(&other.body) && ego.gap_s(&other.body) > 0.0
        };
        self.pairs().filter(in_strip).map(|(ego, other)| Ahead {
            id: other.id,
            gap: ego.gap_s(&other.body),
            closing: ego.v_s - other.body.v_s,
        })
    }
}

/// Offsets of the right and left end of the ego's front edge.
fn front(sample: &Sample) -> (f64, f64) {
    let (vehicle, pose) = (&sample.scenario.vehicle, sample.ego().pose);
    let end = |side: f64| {
        let corner = Vec2::new(vehicle.front_edge_to_center, side * vehicle.half_width());
        let corner = pose.to_world(corner);
        sample.scenario.line.to_frenet_near(corner, sample.at.s).l
    };
    let (right, left) = (end(-1.0), end(1.0));
    (right.min(left), right.max(left))
}

fn is_far(a: &Pose, b: &Pose) -> bool {
    let (x, y) = (a.x - b.x, a.y - b.y);
    x * x + y * y > RANGE * RANGE
}
