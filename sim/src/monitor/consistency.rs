//! `consistency` and its parts: whether the next plan is the rest of the last one.
//!
//! Autoware's and NAVSIM's extended comfort: over the time that two consecutive plans share, the root mean square of
//! what they differ by in acceleration, jerk, yaw rate and yaw acceleration, each against its bound. Both are read at
//! the same times, 0.1 s apart. SI units.

use super::SAMPLE_PERIOD;
use super::measure::{Extreme, Measure};
use super::plan::Plan;
use corridor_decider::decision::TrajectoryPoint;

/// Largest good differences: acceleration, m/s² (EPDMS; the next three too).
pub(super) const MAX_ACCELERATION: f64 = 0.7;
/// Jerk, m/s³.
pub(super) const MAX_JERK: f64 = 0.5;
/// Yaw rate, rad/s.
pub(super) const MAX_YAW_RATE: f64 = 0.1;
/// Yaw acceleration, rad/s².
pub(super) const MAX_YAW_ACCELERATION: f64 = 0.1;

/// Least good share of consecutive plans that agree: one change of mind in two seconds.
pub(super) const SHARE_LIMIT: f64 = 0.95;

/// Fewest common moments that make two plans comparable: a jerk takes two, its mean two of them.
const LEAST_MOMENTS: u32 = 3;

/// The four quantities with their bounds.
const PARTS: [(&str, f64); 4] = [
    ("consistency_acceleration", MAX_ACCELERATION),
    ("consistency_jerk", MAX_JERK),
    ("consistency_yaw_rate", MAX_YAW_RATE),
    ("consistency_yaw_acceleration", MAX_YAW_ACCELERATION),
];

/// Watches consecutive plans.
#[derive(Clone, Debug, Default)]
pub(super) struct ConsistencyWatch {
    pairs: u32,
    agreeing: u32,
    parts: [Extreme; PARTS.len()],
    /// The largest difference over its bound.
    worst: Extreme,
}

impl ConsistencyWatch {
    /// Holds a plan against the one before it.
    pub(super) fn tick(&mut self, last: Option<&Plan>, plan: &Plan) {
        let Some(last) = last else { return };
        let Some(differences) = differences(last, plan) else {
            return;
        };
        let mut largest = 0.0_f64;
        for ((difference, part), (_, bound)) in differences.iter().zip(&mut self.parts).zip(PARTS) {
            part.raise(*difference, plan.time, None);
            largest = largest.max(difference / bound);
        }
        self.pairs += 1;
        self.agreeing += u32::from(largest <= 1.0);
        self.worst.raise(largest, plan.time, None);
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        let share = (self.pairs > 0).then(|| f64::from(self.agreeing) / f64::from(self.pairs));
        let mut measures = vec![self.worst.measure("consistency").value(share)];
        measures.extend(
            self.parts
                .iter()
                .zip(PARTS)
                .map(|(part, (name, _))| part.measure(name)),
        );
        measures
    }
}

/// What is planned for one moment.
#[derive(Clone, Copy, Debug)]
struct Moment {
    a: f64,
    yaw_rate: f64,
}

/// Root mean squares of the differences of two plans in the order of [`PARTS`]; `None` where they share too little.
fn differences(last: &Plan, plan: &Plan) -> Option<[f64; PARTS.len()]> {
    let shift = plan.time - last.time;
    let end = |trajectory: &[TrajectoryPoint]| trajectory.last().map(|point| point.t);
    let end = end(&plan.trajectory)?.min(end(&last.trajectory)? - shift);
    let (mut old, mut new) = (Reader::new(&last.trajectory), Reader::new(&plan.trajectory));
    let (mut count, mut squares) = (0_u32, [0.0; PARTS.len()]);
    let (mut before, mut t) = (None, 0.0);
    while t <= end {
        let (then, now) = (old.at(t + shift), new.at(t));
        let (a, yaw_rate) = (now.a - then.a, now.yaw_rate - then.yaw_rate);
        squares[0] += a * a;
        squares[2] += yaw_rate * yaw_rate;
        if let Some((a_before, yaw_rate_before)) = before {
            let jerk: f64 = (a - a_before) / SAMPLE_PERIOD;
            let yaw_acceleration: f64 = (yaw_rate - yaw_rate_before) / SAMPLE_PERIOD;
            squares[1] += jerk * jerk;
            squares[3] += yaw_acceleration * yaw_acceleration;
        }
        before = Some((a, yaw_rate));
        count += 1;
        t = f64::from(count) * SAMPLE_PERIOD;
    }
    let moments = f64::from(count);
    let number = [moments, moments - 1.0, moments, moments - 1.0];
    let means = std::array::from_fn(|k| (squares[k] / number[k]).sqrt());
    (count >= LEAST_MOMENTS).then_some(means)
}

/// Reads a trajectory at ascending times.
struct Reader<'a> {
    points: &'a [TrajectoryPoint],
    next: usize,
}

impl<'a> Reader<'a> {
    fn new(points: &'a [TrajectoryPoint]) -> Self {
        Self { points, next: 0 }
    }

    /// Between two points by the line between them; beyond an end as at the end. There is a point.
    fn at(&mut self, t: f64) -> Moment {
        while self.next < self.points.len() && self.points[self.next].t <= t {
            self.next += 1;
        }
        let a = &self.points[self.next.saturating_sub(1)];
        let b = self.points.get(self.next).unwrap_or(a);
        let share = if b.t > a.t {
            ((t - a.t) / (b.t - a.t)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let mix = |a: f64, b: f64| a + (b - a) * share;
        Moment {
            a: mix(a.a, b.a),
            yaw_rate: mix(a.kappa * a.v, b.kappa * b.v),
        }
    }
}
