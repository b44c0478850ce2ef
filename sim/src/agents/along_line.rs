//! Driving along a reference line at a lateral offset, the station kept by integration.

use corridor_decider::geometry::{Pose, Vec2, angle};
use corridor_decider::reference_line::{LinePoint, LineQuery, ReferenceLine};
use corridor_scenarios::scenario::AlongLine;
use std::sync::Arc;

/// Inside a bend an offset curve is shorter by `1 − κl`; closer to the bend's centre than this part of its
/// radius the factor is kept here, so that nobody spins on the spot.
const SHORTEST: f64 = 0.1;

/// A vehicle on its line.
#[derive(Clone, Debug)]
pub(super) struct LineFollower {
    pub(super) line: Arc<ReferenceLine>,
    /// Station of its centre, m. Beyond the line's ends the end tangents go on.
    pub(super) s: f64,
    /// Offset of its centre, m, left positive.
    pub(super) l: f64,
    /// Speed along the line at its offset, m/s.
    pub(super) speed: f64,
    /// Speed across the line, m/s, left positive.
    pub(super) drift: f64,
    /// The line at `s`, looked up once per step.
    at: LinePoint,
}

impl LineFollower {
    pub(super) fn new(start: &AlongLine) -> Self {
        Self {
            at: point_beyond(&start.line, start.s),
            line: Arc::clone(&start.line),
            s: start.s,
            l: start.l,
            speed: start.speed,
            drift: 0.0,
        }
    }

    /// On along the line for `dt` seconds at the speed of now.
    pub(super) fn advance(&mut self, dt: f64) {
        self.advance_by(self.speed * dt, dt);
    }

    /// On along the line by `distance` metres at its offset, and across it by its drift for `dt` seconds.
    pub(super) fn advance_by(&mut self, distance: f64, dt: f64) {
        self.s += distance / (1.0 - self.at.kappa * self.l).max(SHORTEST);
        self.l += self.drift * dt;
        self.at = point_beyond(&self.line, self.s);
    }

    /// Its centre and heading, and its velocity in world axes. It points where it drives.
    pub(super) fn motion(&self) -> (Pose, Vec2) {
        let (sin, cos) = angle::sin_cos(self.at.theta);
        let yaw = if self.drift == 0.0 {
            0.0
        } else {
            libm::atan2(self.drift, self.speed)
        };
        let pose = Pose::new(
            self.at.x - self.l * sin,
            self.at.y + self.l * cos,
            angle::wrap(self.at.theta + yaw),
        );
        let velocity = Vec2::new(
            cos * self.speed - sin * self.drift,
            sin * self.speed + cos * self.drift,
        );
        (pose, velocity)
    }

    /// Itself as an observer expects it to go on: a lateral move is not seen coming.
    pub(super) fn as_expected(&self) -> Self {
        Self {
            drift: 0.0,
            ..self.clone()
        }
    }
}

/// The line at `s`, going on straight beyond its ends.
fn point_beyond(line: &ReferenceLine, s: f64) -> LinePoint {
    let mut point = line.point(s);
    let beyond = s - s.clamp(0.0, line.length());
    if beyond != 0.0 {
        let (sin, cos) = angle::sin_cos(point.theta);
        point.x += beyond * cos;
        point.y += beyond * sin;
        point.kappa = 0.0;
    }
    point
}
