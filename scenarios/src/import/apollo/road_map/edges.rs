//! Where the line across a lane meets a polyline beside it.

use corridor_decider::geometry::{Vec2, cross};

/// The offset, left positive, at which the line across the unit vector `heading` at `origin` meets the piece from `a`
/// to `b`.
pub(super) fn crossing(origin: Vec2, heading: Vec2, a: Vec2, b: Vec2) -> Option<f64> {
    let (a, b) = (a - origin, b - origin);
    let (ahead_a, ahead_b) = (heading.dot(&a), heading.dot(&b));
    // Half open, so that a corner on the line counts once.
    if (ahead_a < 0.0) == (ahead_b < 0.0) {
        return None;
    }
    let share = ahead_a / (ahead_a - ahead_b);
    Some(cross(heading, a + (b - a) * share))
}
