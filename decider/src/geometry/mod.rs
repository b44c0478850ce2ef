//! Plane geometry: vectors, angles, poses, convex polygons, polynomials.
//!
//! World coordinates are metres in a right-handed plane, angles are radians counter-clockwise from `+x`
//! in `(-π, π]`. Everything here is a pure function of its arguments and gives the same bits on every
//! platform: transcendental functions come from `libm`.

pub mod angle;
pub mod frenet;
mod polygon;
mod polynomial;
mod pose;
mod quintic;

pub use polygon::ConvexPolygon;
pub use polynomial::Polynomial;
pub use pose::Pose;
pub use quintic::Quintic;

/// A point or a displacement in the plane, metres.
pub type Vec2 = nalgebra::Vector2<f64>;

/// `z` of the cross product `a × b`: positive when `b` points to the left of `a`.
pub fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}
