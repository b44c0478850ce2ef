//! A place and a direction in the plane.

use super::{Vec2, angle};
use serde::{Deserialize, Serialize};

/// Position and heading of a rigid body: metres and radians.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Metres east of the map's origin.
    pub x: f64,
    /// Metres north of the map's origin.
    pub y: f64,
    /// Heading, counter-clockwise from `+x`.
    pub theta: f64,
}

impl Pose {
    /// A pose from its three numbers.
    pub const fn new(x: f64, y: f64, theta: f64) -> Self {
        Self { x, y, theta }
    }

    /// The position alone.
    pub fn position(&self) -> Vec2 {
        Vec2::new(self.x, self.y)
    }

    /// Unit vector along the heading.
    pub fn forward(&self) -> Vec2 {
        let (sin, cos) = angle::sin_cos(self.theta);
        Vec2::new(cos, sin)
    }

    /// A point given in this body's frame (`x` forward, `y` left), in world coordinates.
    pub fn to_world(&self, local: Vec2) -> Vec2 {
        let forward = self.forward();
        Vec2::new(
            self.x + forward.x * local.x - forward.y * local.y,
            self.y + forward.y * local.x + forward.x * local.y,
        )
    }

    /// A world point in this body's frame (`x` forward, `y` left).
    pub fn to_local(&self, world: Vec2) -> Vec2 {
        let forward = self.forward();
        let d = world - self.position();
        Vec2::new(
            forward.x * d.x + forward.y * d.y,
            forward.x * d.y - forward.y * d.x,
        )
    }

    /// The pose `distance` metres ahead along the heading.
    #[must_use]
    pub fn advanced(&self, distance: f64) -> Self {
        let ahead = self.position() + self.forward() * distance;
        Self {
            x: ahead.x,
            y: ahead.y,
            theta: self.theta,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn local_and_world_are_inverse() {
        let pose = Pose::new(3.0, -2.0, 2.2);
        let local = Vec2::new(1.5, -0.7);
        assert!((pose.to_local(pose.to_world(local)) - local).norm() < 1e-14);
        let ahead = pose.advanced(2.0);
        assert!((pose.to_local(ahead.position()) - Vec2::new(2.0, 0.0)).norm() < 1e-14);
    }
}
