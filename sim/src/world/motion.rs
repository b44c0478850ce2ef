//! The ego as a free rigid body: what the engine makes of one that touches nothing, to the bit.
//!
//! A step of the engine costs two microseconds even when there is nothing to collide with. So it is asked only while
//! an obstacle is near; the rest of the way this carries the body on by the same formula (semi-implicit
//! Euler about the centre of mass, the rotation linearised and normalised).

use super::axles::BodyVelocity;
use rapier2d::math::{Pose as RapierPose, Rot2, Vector};

/// Place and velocity of the ego's body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion {
    /// The rear axle.
    pub(super) pose: RapierPose,
    /// Velocity of the centre of mass in world axes, m/s.
    pub(super) velocity: Vector,
    /// Yaw rate, rad/s.
    pub(super) yaw: f64,
}

impl Motion {
    /// On for `dt` seconds without any force, about the centre of mass `local_center`.
    pub(super) fn coast(&mut self, local_center: Vector, dt: f64) {
        let mut moved = self.pose.prepend_translation(local_center);
        let (turn, rotation) = (self.yaw * dt, moved.rotation);
        let (cos, sin) = (rotation.re - turn * rotation.im, rotation.im + turn * rotation.re);
        moved.rotation = Rot2::from_cos_sin_unchecked(cos, sin).normalize();
        moved.translation += self.velocity * dt;
        self.pose = moved.prepend_translation(-local_center);
    }

    /// Replaces the velocity by what `tyres` make of it, given and taken in the body's axes halfway through
    /// a step of `dt` seconds.
    pub(super) fn push(&mut self, dt: f64, tyres: impl FnOnce(BodyVelocity) -> BodyVelocity) {
        let frame = halfway(self.pose.rotation, self.yaw * dt);
        let local = frame.inverse_transform_vector(self.velocity);
        let after = tyres(BodyVelocity {
            forward: local.x,
            left: local.y,
            yaw: self.yaw,
        });
        self.velocity = frame.transform_vector(Vector::new(after.forward, after.left));
        self.yaw = after.yaw;
    }

    /// Speed along the heading, m/s.
    pub(super) fn speed(&self) -> f64 {
        self.pose.rotation.inverse_transform_vector(self.velocity).x
    }
}

/// The body's axes halfway through a step in which it turns by `turn` rad. Tyres that act along these keep
/// the error of a turning step at second order. Without a sine: `tan(turn/4)` is `turn/4` here.
fn halfway(rotation: Rot2, turn: f64) -> Rot2 {
    let h = turn / 4.0;
    let scale = 1.0 / (1.0 + h * h);
    rotation * Rot2::from_cos_sin_unchecked((1.0 - h * h) * scale, 2.0 * h * scale)
}
