//! How near the ego is to each obstacle: exact distances and overlaps of the outlines.
//!
//! Distances are parry's (GJK). The contacts of the physics engine are speculative, up to centimetres early,
//! and judge nothing here.

use super::bodies::{bounding_circle, polygon_of, to_rapier};
use corridor_decider::frame::ObstacleId;
use corridor_decider::geometry::{ConvexPolygon, Pose};
use parry2d::math::{Pose as ParryPose, Vector};
use parry2d::query::details::distance_support_map_support_map;
use parry2d::shape::ConvexPolygon as ParryPolygon;

/// Distances beyond this are not worth computing, m: nobody drives differently for them.
pub const CLEARANCE_HORIZON: f64 = 10.0;

/// Where GJK's answer is not trusted any more, m: it calls a search that did not converge 0. Nearer than this
/// the separating-axis test decides.
const DOUBT: f64 = 1e-6;

/// An outline with the circle around it, at a place.
#[derive(Clone)]
pub(super) struct Outline {
    shape: ParryPolygon,
    polygon: ConvexPolygon,
    pose: Pose,
    placed: ParryPose,
    center: Vector,
    radius: f64,
    /// Middle of the circle in the world.
    middle: Vector,
}

impl Outline {
    pub(super) fn new(polygon: &ConvexPolygon, pose: Pose) -> Self {
        let (center, radius) = bounding_circle(polygon);
        let mut outline = Self {
            shape: polygon_of(polygon),
            polygon: polygon.clone(),
            pose,
            placed: ParryPose::IDENTITY,
            center: Vector::new(center.x, center.y),
            radius,
            middle: Vector::ZERO,
        };
        outline.move_to(pose, to_rapier(pose));
        outline
    }

    /// Puts it at `pose`, given in both notations so that nobody computes a sine twice.
    pub(super) fn move_to(&mut self, pose: Pose, placed: ParryPose) {
        self.pose = pose;
        self.placed = placed;
        self.middle = placed.transform_point(self.center);
    }

    /// Where it is, in the engine's notation.
    pub(super) fn placed(&self) -> ParryPose {
        self.placed
    }

    /// Whether the distance to `other` certainly exceeds `limit`.
    pub(super) fn is_beyond(&self, other: &Self, limit: f64) -> bool {
        let reach = limit + self.radius + other.radius;
        (self.middle - other.middle).length_squared() > reach * reach
    }

    /// Distance to `other`, m; 0 in contact.
    fn distance(&self, other: &Self) -> f64 {
        let relative = self.placed.inv_mul(&other.placed);
        let distance = distance_support_map_support_map(&relative, &self.shape, &other.shape);
        if distance > DOUBT {
            return distance;
        }
        self.footprint().distance(&other.footprint())
    }

    fn footprint(&self) -> ConvexPolygon {
        self.polygon.at(self.pose)
    }
}

/// What is near the ego at one moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Proximity {
    /// The nearest obstacle within the horizon, and its distance.
    pub(super) nearest: Option<(f64, ObstacleId)>,
    /// Obstacles whose interiors meet the ego's, in ascending order.
    pub(super) overlaps: Vec<ObstacleId>,
}

impl Proximity {
    /// Looks around anew. Equally near obstacles: the one with the smallest identity counts.
    pub(super) fn update(&mut self, ego: &Outline, obstacles: &[Outline]) {
        self.nearest = None;
        self.overlaps.clear();
        let mut horizon = CLEARANCE_HORIZON;
        for (id, obstacle) in (0_u32..).map(ObstacleId).zip(obstacles) {
            if ego.is_beyond(obstacle, horizon) {
                continue;
            }
            let distance = ego.distance(obstacle);
            if distance <= 0.0 && ego.footprint().overlaps(&obstacle.footprint()) {
                self.overlaps.push(id);
            }
            if distance <= CLEARANCE_HORIZON && self.nearest.is_none_or(|(best, _)| distance < best) {
                self.nearest = Some((distance, id));
                horizon = distance;
            }
        }
    }
}
