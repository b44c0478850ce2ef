//! Someone on foot: waits, crosses along a straight line once triggered, and stands at its end.

use super::Moment;
use corridor_decider::geometry::{Pose, Vec2};
use corridor_scenarios::scenario::Trigger;

/// A pedestrian on its way.
#[derive(Clone, Debug)]
pub(super) struct Walker {
    from: Vec2,
    direction: Vec2,
    theta: f64,
    /// Length of the way, m, and how much of it is done.
    length: f64,
    done: f64,
    speed: f64,
    trigger: Trigger,
    walks: bool,
}

impl Walker {
    pub(super) fn new(from: Vec2, to: Vec2, speed: f64, trigger: Trigger) -> Self {
        let way = to - from;
        let length = way.norm();
        Self {
            from,
            direction: if length > 0.0 { way / length } else { Vec2::x() },
            theta: libm::atan2(way.y, way.x),
            length,
            done: 0.0,
            speed,
            trigger,
            walks: false,
        }
    }

    pub(super) fn advance(&mut self, moment: &Moment, dt: f64) {
        self.walks = self.walks || moment.sets_off(self.trigger, self.from);
        if self.walks {
            self.done = (self.done + self.speed * dt).min(self.length);
        }
    }

    pub(super) fn motion(&self) -> (Pose, Vec2) {
        let at = self.from + self.direction * self.done;
        let walking = self.walks && self.done < self.length;
        let velocity = if walking {
            self.direction * self.speed
        } else {
            Vec2::zeros()
        };
        (Pose::new(at.x, at.y, self.theta), velocity)
    }
}
