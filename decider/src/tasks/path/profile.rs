//! Lateral offset as a function of station, and the corridor it has to stay in.

use super::Goal;
use super::table::{LineTable, STEP};
use crate::tasks::path_bounds::PathBound;
use crate::tasks::scene::Scene;

/// How far behind the ego's place the corridor may exclude it, and over which length that may last, m: a
/// car that has strayed over its bound must be allowed back.
const RETURN_LENGTH: f64 = 12.0;

/// How far before its stop a car has to be in place, m: it stops straight.
const STRAIGHTEN: f64 = 2.0;

/// How far from its place across the line it may stop, m.
const ARRIVAL_TOLERANCE: f64 = 0.1;

/// A bound at the stations of the path, with what pulls the path where.
#[derive(Clone, Debug)]
pub(super) struct Corridor {
    /// Limits per station: right, left.
    pub limits: Vec<(f64, f64)>,
    /// Offset that the path is drawn to.
    pub target_l: f64,
    /// `l`, `l'`, `l''` at the first station.
    pub start: [f64; 3],
    /// Length over which deviations are smoothed, m.
    pub smoothing_length: f64,
    /// Allowed overshoot per station, m.
    pub tolerance: Vec<f64>,
}

impl Corridor {
    /// The bound at every metre, each the narrowest of the stations around it. `None` if it is too short.
    pub(super) fn new(scene: &Scene, table: &LineTable, bound: &PathBound, goal: Goal) -> Option<Self> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small whole number"
        )]
        let stride = (STEP / bound.delta_s).round() as usize;
        let count = (bound.points.len().saturating_sub(1) / stride + 1).min(table.rows.len());
        if count < 4 {
            return None;
        }
        let mut limits: Vec<(f64, f64)> = (0..count)
            .map(|k| {
                let (first, last) = ((k * stride).saturating_sub(stride - 1), k * stride + stride - 1);
                let near = &bound.points[first..=last.min(bound.points.len() - 1)];
                let (lo, hi) = near.iter().fold((-f64::MAX, f64::MAX), |(lo, hi), p| {
                    (lo.max(p.l_min), hi.min(p.l_max))
                });
                let here = &bound.points[k * stride];
                // Where the corridor jumps aside between two stations they need not have anything in common.
                if lo <= hi {
                    (lo, hi)
                } else {
                    (here.l_min, here.l_max)
                }
            })
            .collect();
        if let Some(stop_s) = goal.stop_s {
            let arrival = table.rows.partition_point(|row| row.s < stop_s - STRAIGHTEN);
            limits
                .iter_mut()
                .skip(arrival)
                .for_each(|limit| *limit = arrive(*limit, goal.l));
        }
        let config = &scene.config.path;
        let start = scene.lateral.l;
        let outside = (limits[0].0 - start[0]).max(start[0] - limits[0].1).max(0.0);
        let tolerance = (0..count)
            .map(|k| {
                let fade = (1.0 - k as f64 * STEP / RETURN_LENGTH).max(0.0);
                config.bound_tolerance + outside * fade
            })
            .collect();
        let smoothing_length = (scene.start.v * config.smoothing_time).max(config.least_smoothing_length);
        Some(Self {
            limits,
            target_l: goal.l,
            start,
            smoothing_length,
            tolerance,
        })
    }

    /// Number of stations.
    pub(super) fn len(&self) -> usize {
        self.limits.len()
    }
}

/// A limit narrowed to the place where the car stops, as far as it reaches there.
fn arrive((lo, hi): (f64, f64), l: f64) -> (f64, f64) {
    let l = l.clamp(lo, hi);
    (lo.max(l - ARRIVAL_TOLERANCE), hi.min(l + ARRIVAL_TOLERANCE))
}

/// Offset and its first three derivatives by station, at every station of the corridor.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Profile {
    pub l: Vec<[f64; 4]>,
}

impl Profile {
    /// Derivatives by central differences; the first station keeps the start state.
    pub(super) fn from_offsets(offsets: &[f64], start: [f64; 3]) -> Self {
        let n = offsets.len();
        let at = |k: usize| offsets[k.min(n - 1)];
        let mut l: Vec<[f64; 4]> = (0..n)
            .map(|k| {
                if k == 0 {
                    return [start[0], start[1], start[2], 0.0];
                }
                let (before, here, after) = (at(k - 1), at(k), at(k + 1));
                let (slope, bend) = if k + 1 < n {
                    (
                        (after - before) / (2.0 * STEP),
                        (after - 2.0 * here + before) / (STEP * STEP),
                    )
                } else {
                    ((here - before) / STEP, 0.0)
                };
                [here, slope, bend, 0.0]
            })
            .collect();
        for k in 1..n {
            l[k][3] = (l[k][2] - l[k - 1][2]) / STEP;
        }
        Self { l }
    }

    /// The smoother's objective, so that sampled and smoothed paths compare.
    pub(super) fn cost(&self, corridor: &Corridor) -> f64 {
        let square = corridor.smoothing_length * corridor.smoothing_length;
        self.l
            .iter()
            .map(|[l, dl, ddl, dddl]| {
                let off = l - corridor.target_l;
                off * off + square * (dl * dl + square * (ddl * ddl + square * dddl * dddl))
            })
            .sum()
    }
}
