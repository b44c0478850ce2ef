//! Whether something takes so much of the view that the lane to change to cannot be seen (the original's
//! `IsPerceptionBlocked`).

use crate::geometry::{ConvexPolygon, Pose, Vec2, angle};
use std::f64::consts::TAU;

/// Beams are at least so far apart, rad: more of them would only take time.
const LEAST_STEP: f64 = 1e-3;

/// A fan of beams cast from the ego.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fan {
    /// Length of a beam, m.
    pub length: f64,
    /// Angle between two beams, rad.
    pub step: f64,
    /// Angle of the whole fan, the heading in its middle, rad.
    pub range: f64,
    /// An obstacle that takes a wider angle than this blocks the view, rad.
    pub threshold: f64,
}

impl Default for Fan {
    /// The values with which the original's lane-follow pipeline asks.
    #[expect(clippy::approx_constant, reason = "the original's value, not half a turn")]
    fn default() -> Self {
        Self {
            length: 20.0,
            step: 0.08,
            range: 3.14,
            threshold: 0.5,
        }
    }
}

/// Whether one of these bodies blocks the view from `eye`.
pub fn is_blocked<'a>(eye: Pose, fan: &Fan, bodies: impl IntoIterator<Item = &'a ConvexPolygon>) -> bool {
    bodies
        .into_iter()
        .any(|body| hidden_angle(eye, fan, body).is_some_and(|hidden| hidden > fan.threshold))
}

/// The angle between the right-most beam that hits a body and the next one that does not, rad.
fn hidden_angle(eye: Pose, fan: &Fan, body: &ConvexPolygon) -> Option<f64> {
    let right_most = eye.theta - 0.5 * fan.range;
    let mut first_hit = None;
    let (step, range) = (fan.step.max(LEAST_STEP), fan.range.min(TAU));
    let mut beam = 0.0;
    while fan.step > 0.0 && beam < range {
        let heading = right_most + beam;
        let (sin, cos) = angle::sin_cos(heading);
        let end = eye.position() + Vec2::new(cos, sin) * fan.length;
        let is_hit = body.meets_segment(eye.position(), end);
        match first_hit {
            None if is_hit => first_hit = Some(heading),
            Some(first) if !is_hit => return Some(angle::difference(heading, first).abs()),
            _ => {}
        }
        beam += step;
    }
    first_hit.map(|first| angle::difference(right_most + fan.range, first).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall(distance: f64, half_width: f64) -> ConvexPolygon {
        ConvexPolygon::rectangle(Pose::new(distance, 0.0, 0.0), 1.0, 0.0, half_width)
    }

    #[test]
    fn what_is_near_or_wide_hides_more() {
        let eye = Pose::new(0.0, 0.0, 0.0);
        let fan = Fan::default();
        assert!(is_blocked(eye, &fan, [&wall(3.0, 1.0)]));
        assert!(!is_blocked(eye, &fan, [&wall(15.0, 1.0)]));
        assert!(is_blocked(eye, &fan, [&wall(15.0, 5.0)]));
        assert!(!is_blocked(eye, &fan, [&wall(21.0, 9.0)]), "beyond the beams");
        let behind = Pose::new(0.0, 0.0, std::f64::consts::PI);
        assert!(!is_blocked(behind, &fan, [&wall(3.0, 1.0)]));
    }

    #[test]
    fn a_fan_without_beams_sees_nothing() {
        let fan = Fan {
            step: 0.0,
            ..Fan::default()
        };
        assert!(!is_blocked(Pose::new(0.0, 0.0, 0.0), &fan, [&wall(3.0, 1.0)]));
    }
}
