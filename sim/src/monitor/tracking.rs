//! `tracking_error`, `tracking_error_max`: how far the ego is beside the trajectory it was last given, m.

use super::measure::{Extreme, Measure};
use super::view::Sample;
use crate::sweep::statistics::percentile;
use corridor_decider::decision::TrajectoryPoint;
use corridor_decider::geometry::{Vec2, angle, cross};

/// Largest good 95th percentile, m.
pub(super) const P95_LIMIT: f64 = 0.1;

/// Largest good error, m.
pub(super) const MAX_LIMIT: f64 = 0.3;

/// Watches the tracker.
#[derive(Clone, Debug, Default)]
pub(super) struct TrackingWatch {
    errors: Vec<f64>,
    largest: Extreme,
}

impl TrackingWatch {
    pub(super) fn sample(&mut self, sample: &Sample) {
        let Some(plan) = sample.plan else { return };
        let now = sample.time() - plan.time;
        if let Some(error) = lateral_error(&plan.trajectory, now, sample.ego().pose.position()) {
            self.errors.push(error);
            self.largest.raise(error, sample.time(), None);
        }
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        vec![
            Measure::new("tracking_error", percentile(&self.errors, 95.0)).at(self.largest.time),
            self.largest.measure("tracking_error_max"),
        ]
    }
}

/// Distance of `at` from the line through the trajectory's point at time `t`, along its heading there. The error
/// along the path is left out: it belongs to the speed. `None` for a trajectory that is not under way at `t`.
fn lateral_error(trajectory: &[TrajectoryPoint], t: f64, at: Vec2) -> Option<f64> {
    let above = trajectory.partition_point(|p| p.t <= t);
    let a = trajectory.get(above.checked_sub(1)?)?;
    let b = trajectory.get(above).unwrap_or(a);
    let share = if b.t > a.t { (t - a.t) / (b.t - a.t) } else { 0.0 };
    let place = a.pose.position() + (b.pose.position() - a.pose.position()) * share;
    let heading = a.pose.theta + angle::difference(b.pose.theta, a.pose.theta) * share;
    let (sin, cos) = angle::sin_cos(heading);
    Some(cross(Vec2::new(cos, sin), at - place).abs())
}
