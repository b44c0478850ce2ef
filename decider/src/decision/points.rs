//! Points of paths and trajectories, at the centre of the rear axle.

use crate::columns::Row;
use crate::geometry::Pose;

/// A point of a path, at the rear axle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// Arc length along the path from its first point, m.
    pub distance: f64,
    /// Station on the reference line.
    pub s: f64,
    /// Lateral offset from the reference line.
    pub l: f64,
    /// World pose.
    pub pose: Pose,
    /// Curvature of the path, 1/m.
    pub kappa: f64,
}

impl Row for PathPoint {
    const NAMES: &'static [&'static str] = &["distance", "s", "l", "x", "y", "theta", "kappa"];

    fn number(&self, column: usize) -> f64 {
        let p = self.pose;
        [self.distance, self.s, self.l, p.x, p.y, p.theta, self.kappa][column]
    }

    fn from_numbers(number: impl Fn(usize) -> f64) -> Self {
        Self {
            distance: number(0),
            s: number(1),
            l: number(2),
            pose: Pose::new(number(3), number(4), number(5)),
            kappa: number(6),
        }
    }
}

/// A point of the trajectory, at the rear axle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrajectoryPoint {
    /// Seconds from the frame's time.
    pub t: f64,
    /// Arc length along the path, m.
    pub distance: f64,
    /// World pose.
    pub pose: Pose,
    /// Curvature, 1/m.
    pub kappa: f64,
    /// Speed, m/s.
    pub v: f64,
    /// Acceleration, m/s².
    pub a: f64,
}

impl Row for TrajectoryPoint {
    const NAMES: &'static [&'static str] = &["t", "distance", "x", "y", "theta", "kappa", "v", "a"];

    fn number(&self, column: usize) -> f64 {
        let p = self.pose;
        [
            self.t,
            self.distance,
            p.x,
            p.y,
            p.theta,
            self.kappa,
            self.v,
            self.a,
        ][column]
    }

    fn from_numbers(number: impl Fn(usize) -> f64) -> Self {
        Self {
            t: number(0),
            distance: number(1),
            pose: Pose::new(number(2), number(3), number(4)),
            kappa: number(5),
            v: number(6),
            a: number(7),
        }
    }
}
