//! The way of a car whose wheels stay as they are.

use crate::geometry::{Pose, angle};
use crate::tasks::start_point::StartPoint;

/// The pose after an arc of the start point's curvature.
pub(super) fn pose(start: &StartPoint, distance: f64) -> Pose {
    let half_turn = start.kappa * distance / 2.0;
    let chord = if half_turn.abs() < 1e-9 {
        distance
    } else {
        libm::sin(half_turn) / half_turn * distance
    };
    let middle = Pose {
        theta: start.pose.theta + half_turn,
        ..start.pose
    }
    .advanced(chord);
    Pose {
        theta: angle::wrap(start.pose.theta + 2.0 * half_turn),
        ..middle
    }
}
