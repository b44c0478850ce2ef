//! Bodies of the rapier world: how the ego and the obstacles are put into it.
//!
//! Obstacles that never move are fixed bodies, the others position-based kinematic ones. Obstacles do not collide
//! with each other: what they do is scripted, and nothing reads it.

use corridor_decider::frame::{ObstacleId, ObstacleKind};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle};
use corridor_decider::vehicle::VehicleParams;
use rapier2d::dynamics::{MassProperties, RigidBody, RigidBodyBuilder};
use rapier2d::geometry::{ActiveCollisionTypes, ColliderBuilder, Group, InteractionGroups, SharedShape};
use rapier2d::math::{Pose as RapierPose, Rot2, Vector};
use rapier2d::parry::shape::ConvexPolygon as RapierPolygon;
use rapier2d::prelude::InteractionTestMode;

use super::params::DynamicsParams;

/// Half the side of the smallest body there is, m.
const THINNEST: f64 = 0.01;

/// Where an obstacle is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyPose {
    /// Which obstacle.
    pub id: ObstacleId,
    /// Its centre and heading.
    pub pose: Pose,
    /// Velocity in world axes, m/s.
    pub velocity: Vec2,
}

/// An obstacle as the world has it.
#[derive(Clone, Debug)]
pub struct ObstacleBody {
    /// Identity: its place in the scenario.
    pub id: ObstacleId,
    /// Its class.
    pub kind: ObstacleKind,
    /// Its outline in its own frame.
    pub shape: ConvexPolygon,
    /// Its centre and heading.
    pub pose: Pose,
    /// Velocity in world axes, m/s.
    pub velocity: Vec2,
}

impl ObstacleBody {
    /// Its outline in world coordinates.
    pub fn footprint(&self) -> ConvexPolygon {
        self.shape.at(self.pose)
    }
}

pub(super) fn to_rapier(pose: Pose) -> RapierPose {
    let (sin, cos) = angle::sin_cos(pose.theta);
    RapierPose::from_parts(
        Vector::new(pose.x, pose.y),
        Rot2::from_cos_sin_unchecked(cos, sin),
    )
}

pub(super) fn from_rapier(pose: &RapierPose) -> Pose {
    let theta = libm::atan2(pose.rotation.im, pose.rotation.re);
    Pose::new(pose.translation.x, pose.translation.y, theta)
}

/// The polygon in the library's notation. One too thin for it becomes a square around its circle: too large
/// rather than absent.
pub(super) fn polygon_of(polygon: &ConvexPolygon) -> RapierPolygon {
    let points = |polygon: &ConvexPolygon| polygon.vertices().iter().map(|v| Vector::new(v.x, v.y)).collect();
    RapierPolygon::from_convex_polyline(points(polygon)).unwrap_or_else(|| {
        let (center, radius) = bounding_circle(polygon);
        let reach = radius.max(THINNEST);
        let square = ConvexPolygon::rectangle(Pose::new(center.x, center.y, 0.0), reach, reach, reach);
        RapierPolygon::from_convex_polyline(points(&square)).expect("a square has corners")
    })
}

/// A circle around a polygon: the middle of its bounding box and the farthest vertex from there, m.
pub(super) fn bounding_circle(polygon: &ConvexPolygon) -> (Vec2, f64) {
    let (mut low, mut high) = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
    for vertex in polygon.vertices() {
        low = low.inf(vertex);
        high = high.sup(vertex);
    }
    let center = (low + high) / 2.0;
    let reach = |v: &Vec2| (v - center).norm();
    let radius = polygon.vertices().iter().map(reach).fold(0.0, f64::max);
    (center, radius)
}

/// The ego's body; its origin is the rear axle.
pub(super) fn ego_body(start: Pose, params: &DynamicsParams) -> RigidBody {
    let center_of_mass = Vector::new(params.center_of_mass, 0.0);
    RigidBodyBuilder::dynamic()
        .pose(to_rapier(start))
        .additional_mass_properties(MassProperties::new(
            center_of_mass,
            params.mass,
            params.yaw_inertia,
        ))
        .can_sleep(false)
        .build()
}

pub(super) fn ego_collider(vehicle: &VehicleParams) -> ColliderBuilder {
    let outline = vehicle.footprint(Pose::new(0.0, 0.0, 0.0));
    collider(&outline, Group::GROUP_1, Group::GROUP_2)
}

/// An obstacle's body; it takes no part until it is enabled.
pub(super) fn obstacle_body(start: Pose, moves: bool) -> RigidBody {
    let builder = if moves {
        RigidBodyBuilder::kinematic_position_based()
    } else {
        RigidBodyBuilder::fixed()
    };
    builder.pose(to_rapier(start)).enabled(false).build()
}

pub(super) fn obstacle_collider(shape: &ConvexPolygon) -> ColliderBuilder {
    collider(shape, Group::GROUP_2, Group::GROUP_1)
}

fn collider(outline: &ConvexPolygon, member_of: Group, meets: Group) -> ColliderBuilder {
    ColliderBuilder::new(SharedShape::new(polygon_of(outline)))
        .density(0.0)
        .active_collision_types(ActiveCollisionTypes::all())
        .collision_groups(InteractionGroups::new(member_of, meets, InteractionTestMode::And))
}
