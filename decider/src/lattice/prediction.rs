//! Where obstacles will be, and how fast they will move along the line.

use crate::frame::{Obstacle, PredictedPose};
use crate::geometry::{Pose, angle};

/// A predicted motion at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PredictedMotion {
    /// Seconds from the frame's time.
    pub t: f64,
    /// Speed, m/s.
    pub v: f64,
    /// Direction.
    pub theta: f64,
}

/// Speed along a line of direction `heading` at a time: that of the first prediction that is not before it. Before and
/// beyond all of them, and with fewer than two, it is 0. May be negative.
pub fn projected_speed(motions: &[PredictedMotion], heading: f64, t: f64) -> f64 {
    let (Some(first), Some(last)) = (motions.first(), motions.last()) else {
        return 0.0;
    };
    if motions.len() < 2 || t < first.t || t > last.t {
        return 0.0;
    }
    let place = motions.partition_point(|motion| motion.t < t);
    let motion = motions[place.min(motions.len() - 1)];
    let (_, cos) = angle::sin_cos(motion.theta - heading);
    motion.v * cos
}

/// The motions of an obstacle's predicted poses.
pub fn motions_of(obstacle: &Obstacle) -> Vec<PredictedMotion> {
    let poses = &obstacle.prediction;
    let motion = |k: usize| {
        let (a, b) = (&poses[k.saturating_sub(1)], &poses[(k + 1).min(poses.len() - 1)]);
        let moved = b.pose.position() - a.pose.position();
        let length = moved.norm();
        let dt = b.t - a.t;
        PredictedMotion {
            t: poses[k].t,
            v: if dt > 0.0 { length / dt } else { 0.0 },
            theta: if length > 0.0 {
                libm::atan2(moved.y, moved.x)
            } else {
                poses[k].pose.theta
            },
        }
    };
    (0..poses.len()).map(motion).collect()
}

/// Where an obstacle is at a time: between two predictions straight on, before the first and beyond the last as these.
/// `hint` is the place from which to look on, for times that increase.
pub fn pose_at(predictions: &[PredictedPose], t: f64, hint: &mut usize) -> Option<Pose> {
    while *hint < predictions.len() && predictions[*hint].t < t {
        *hint += 1;
    }
    let last = predictions.last()?;
    if *hint == 0 {
        return Some(predictions[0].pose);
    }
    let Some(b) = predictions.get(*hint) else {
        return Some(last.pose);
    };
    let a = &predictions[*hint - 1];
    let share = (t - a.t) / (b.t - a.t);
    let mix = |x: f64, y: f64| x + (y - x) * share;
    let turn = angle::difference(b.pose.theta, a.pose.theta);
    Some(Pose::new(
        mix(a.pose.x, b.pose.x),
        mix(a.pose.y, b.pose.y),
        angle::wrap(a.pose.theta + turn * share),
    ))
}
