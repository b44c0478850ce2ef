//! Lateral offset as a function of station.

use super::corridor::{Corridor, Pull};
use super::table::STEP;

/// Offset and its first three derivatives by station, at every station of the corridor.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Profile {
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

    /// The way of the tick before, going on at its last offset as far as the corridor lets it.
    pub(super) fn kept(corridor: &Corridor) -> Option<Self> {
        let last = corridor.last.as_ref()?;
        let end = *last.last()?;
        let mut offsets = last.clone();
        offsets.extend(
            corridor.limits[last.len()..]
                .iter()
                .map(|(lo, hi)| end.max(*lo).min(*hi)),
        );
        Some(Self::from_offsets(&offsets, corridor.start))
    }

    /// The smoother's objective, so that sampled and smoothed paths compare.
    pub(super) fn cost(&self, corridor: &Corridor) -> f64 {
        let square = corridor.smoothing_length * corridor.smoothing_length;
        let bends = &corridor.bends;
        let cost = |(k, ([l, dl, ddl, dddl], pull)): (usize, (&[f64; 4], &Pull))| {
            let (off, bend) = (l - pull.l, ddl + bends[k]);
            let twist = dddl + (bends[k] - bends[k.saturating_sub(1)]) / STEP;
            pull.weight * off * off + square * (dl * dl + square * (bend * bend + square * twist * twist))
        };
        self.l.iter().zip(&corridor.pulls).enumerate().map(cost).sum()
    }
}
