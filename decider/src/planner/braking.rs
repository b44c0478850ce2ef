//! The last resort: full braking on what is left of the last trajectory, or on the arc that the wheels hold.

use crate::context::LastTrajectory;
use crate::decision::TrajectoryPoint;
use crate::geometry::Pose;
use crate::tasks::start_point::StartPoint;

/// Full braking along the last trajectory, or straight on with the wheel held where there is none.
pub(super) fn braking_trajectory(
    start: &StartPoint,
    last: Option<(&LastTrajectory, f64)>,
    deceleration: f64,
) -> Vec<TrajectoryPoint> {
    (0..=80_u32)
        .map(|k| {
            let t = f64::from(k) * 0.1;
            let stop_time = start.v / deceleration;
            let moving = t.min(stop_time);
            let distance = start.v * moving - deceleration * moving * moving / 2.0;
            let (pose, kappa) = last
                .and_then(|(last, now)| along(last, now + distance))
                .unwrap_or_else(|| (on_arc(start, distance), start.kappa));
            let (v, a) = if t < stop_time {
                (start.v - deceleration * t, -deceleration)
            } else {
                (0.0, 0.0)
            };
            TrajectoryPoint {
                t,
                distance,
                pose,
                kappa,
                v,
                a,
            }
        })
        .collect()
}

/// The last trajectory's pose at a distance, if it leads that far.
fn along(last: &LastTrajectory, distance: f64) -> Option<(Pose, f64)> {
    let above = last.points.partition_point(|p| p.distance <= distance);
    let (a, b) = (last.points.get(above.checked_sub(1)?)?, last.points.get(above)?);
    let share = (distance - a.distance) / (b.distance - a.distance);
    let turn = crate::geometry::angle::difference(b.pose.theta, a.pose.theta);
    let at = a.pose.position() + (b.pose.position() - a.pose.position()) * share;
    Some((
        Pose::new(
            at.x,
            at.y,
            crate::geometry::angle::wrap(a.pose.theta + turn * share),
        ),
        a.kappa,
    ))
}

/// The pose after an arc of the start point's curvature.
fn on_arc(start: &StartPoint, distance: f64) -> Pose {
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
        theta: crate::geometry::angle::wrap(start.pose.theta + 2.0 * half_turn),
        ..middle
    }
}
