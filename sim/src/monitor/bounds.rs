//! `bound_containment`, `bound_excess`, `min_bound_width`, `bound_jitter`: the corridor as promised and as kept.
//!
//! All in the Frenet frame of the line planned along, metres, for the rear axle. Points that lead through a blocker
//! (padding) promise nothing and are left out.

use super::measure::{Extreme, Measure};
use super::plan::Plan;
use super::view::Sample;
use crate::sweep::statistics::percentile;
use corridor_decider::frame::{Frame, ObstacleId};
use corridor_decider::tasks::path_bounds::{BoundPoint, EdgeCause, PathBound};
use std::sync::Arc;

/// Smallest good share of samples inside the corridor.
pub(super) const CONTAINMENT_LIMIT: f64 = 0.99;

/// Largest good distance outside it, m: the tracking tolerance.
pub(super) const EXCESS_LIMIT: f64 = 0.1;

/// Largest good 95th percentile of the jitter, m.
pub(super) const JITTER_LIMIT: f64 = 0.25;

/// Watches the bounds that are driven.
#[derive(Clone, Debug, Default)]
pub(super) struct BoundWatch {
    counted: u32,
    contained: u32,
    excess: Extreme,
    width: Extreme,
    jitters: Vec<f64>,
    worst_jitter: Extreme,
}

impl BoundWatch {
    /// Holds the ego against the bound it was given last. At its own tick a bound holds the ego by construction.
    pub(super) fn sample(&mut self, sample: &Sample) {
        let Some(plan) = sample.plan else { return };
        let (Some(bound), Some(_)) = (&plan.bound, &plan.line) else {
            return;
        };
        let at = sample.planned;
        if let Some((l_min, l_max)) = limits_at(promised(bound), at.s) {
            let excess = (l_min - at.l).max(at.l - l_max).max(0.0);
            self.counted += 1;
            self.contained += u32::from(excess <= 0.0);
            self.excess.raise(excess, sample.time(), None);
        }
    }

    pub(super) fn tick(&mut self, frame: &Frame, last: Option<&Plan>, plan: &Plan) {
        let Some(bound) = &plan.bound else { return };
        for point in promised(bound) {
            let obstacle = cause_of(point).or(bound.blocked_by);
            self.width.lower(point.l_max - point.l_min, frame.time, obstacle);
        }
        let is_still = frame.obstacles.iter().all(|o| o.is_static);
        let Some(last) = last.filter(|last| is_still && is_same_question(last, plan)) else {
            return;
        };
        if let Some(before) = &last.bound {
            let jitter = jitter(promised(before), promised(bound));
            self.jitters.push(jitter);
            self.worst_jitter.raise(jitter, frame.time, None);
        }
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        let share = (self.counted > 0).then(|| f64::from(self.contained) / f64::from(self.counted));
        let p95 = percentile(&self.jitters, 95.0);
        vec![
            Measure::new("bound_containment", share).at(self.excess.time),
            self.excess.measure("bound_excess"),
            self.width.measure("min_bound_width"),
            self.worst_jitter.measure("bound_jitter").value(p95),
        ]
    }
}

/// The points that promise something: all but the padding.
fn promised(bound: &PathBound) -> &[BoundPoint] {
    let count = bound.points.len().saturating_sub(bound.padding);
    &bound.points[..count]
}

fn cause_of(point: &BoundPoint) -> Option<ObstacleId> {
    [point.right, point.left]
        .into_iter()
        .find_map(|cause| match cause {
            EdgeCause::Obstacle(id) => Some(id),
            _ => None,
        })
}

/// The limits at `s`: the wider ones of the stations around it, since a limit may jump between two stations.
fn limits_at(points: &[BoundPoint], s: f64) -> Option<(f64, f64)> {
    let above = points.partition_point(|p| p.s <= s);
    let a = points.get(above.checked_sub(1)?)?;
    let b = points.get(above)?;
    Some((a.l_min.min(b.l_min), a.l_max.max(b.l_max)))
}

/// Whether two plans answer the same question, so that their bounds can be compared.
fn is_same_question(last: &Plan, plan: &Plan) -> bool {
    let same_line = match (&last.line, &plan.line) {
        (Some(a), Some(b)) => Arc::ptr_eq(a, b) || a == b,
        _ => false,
    };
    same_line && last.label() == plan.label() && last.command == plan.command
}

/// The largest change of a limit over the stations of both bounds.
///
/// Stations move on with the ego, and with them the station at which a limit jumps. So each limit is held against
/// the range that the earlier bound spans one station around it.
fn jitter(before: &[BoundPoint], now: &[BoundPoint]) -> f64 {
    let mut largest = 0.0_f64;
    let mut from = 0;
    for pair in now.windows(2) {
        let (point, reach) = (&pair[0], pair[1].s - pair[0].s);
        while from < before.len() && before[from].s < point.s - reach {
            from += 1;
        }
        let around = before[from..].iter().take_while(|p| p.s <= point.s + reach);
        let range = around.fold(None, |range: Option<[f64; 4]>, p| {
            let [r0, r1, l0, l1] = range.unwrap_or([p.l_min, p.l_min, p.l_max, p.l_max]);
            Some([r0.min(p.l_min), r1.max(p.l_min), l0.min(p.l_max), l1.max(p.l_max)])
        });
        let inside = before.last().is_some_and(|last| point.s <= last.s);
        if let Some([r0, r1, l0, l1]) = range.filter(|_| inside) {
            let beyond = |x: f64, low: f64, high: f64| (low - x).max(x - high);
            largest = largest
                .max(beyond(point.l_min, r0, r1))
                .max(beyond(point.l_max, l0, l1));
        }
    }
    largest
}
