//! What a boundary says about one time or one point.

use super::{BoundaryType, S_HORIZON, StBoundary, StPoint, cross};

/// Step of the difference quotients of the edges, s.
const SLOPE_STEP: f64 = 0.05;

/// An interval of the path, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SRange {
    /// Its beginning.
    pub lower: f64,
    /// Its end.
    pub upper: f64,
}

impl StBoundary {
    /// Whether it lasts at `t`, its first and last moment included.
    pub fn covers_time(&self, t: f64) -> bool {
        t >= self.min_t() && t <= self.max_t()
    }

    /// Places of the pairs around `t`, which the boundary covers: the last earlier one and the first not earlier one.
    /// At the first moment both are the first.
    fn around(&self, t: f64) -> (usize, usize) {
        let right = self.pairs().partition_point(|pair| pair.t < t);
        let right = right.min(self.pairs().len() - 1);
        (right.saturating_sub(1), right)
    }

    /// Its edges at `t`, linear between its pairs; `None` before and after it.
    pub fn edges_at(&self, t: f64) -> Option<SRange> {
        if !self.covers_time(t) {
            return None;
        }
        let (left, right) = self.around(t);
        let (a, b) = (self.pairs()[left], self.pairs()[right]);
        let share = if left == right {
            0.0
        } else {
            (t - a.t) / (b.t - a.t)
        };
        Some(SRange {
            lower: a.lower + share * (b.lower - a.lower),
            upper: a.upper + share * (b.upper - a.upper),
        })
    }

    /// What it leaves free of the path at `t`: all before it or all behind it, as its type says. `None` while it lasts
    /// for a type that does not say.
    pub fn unblocked_range(&self, t: f64) -> Option<SRange> {
        let free = SRange {
            lower: 0.0,
            upper: S_HORIZON,
        };
        let Some(edges) = self.edges_at(t) else {
            return Some(free);
        };
        match self.kind {
            BoundaryType::Stop | BoundaryType::Yield | BoundaryType::Follow => Some(SRange {
                upper: edges.lower,
                ..free
            }),
            BoundaryType::Overtake => Some(SRange {
                lower: edges.upper.max(0.0),
                ..free
            }),
            BoundaryType::KeepClear | BoundaryType::Unknown => None,
        }
    }

    /// Its edges at `t` within the path and the horizon; `None` before and after it.
    pub fn range(&self, t: f64) -> Option<SRange> {
        self.edges_at(t).map(|edges| SRange {
            lower: edges.lower.max(0.0),
            upper: edges.upper.min(S_HORIZON),
        })
    }

    /// How fast its edges (as [`Self::range`] has them) move at `t`, m/s; `None` before and after it, or if it is
    /// so short that there is no telling.
    pub fn slopes(&self, t: f64) -> Option<SRange> {
        let now = self.range(t)?;
        let rate = |from: SRange, to: SRange| SRange {
            lower: (to.lower - from.lower) / SLOPE_STEP,
            upper: (to.upper - from.upper) / SLOPE_STEP,
        };
        let before = self.range(t - SLOPE_STEP).map(|before| rate(before, now));
        let after = self.range(t + SLOPE_STEP).map(|after| rate(now, after));
        match (before, after) {
            (Some(a), Some(b)) => Some(SRange {
                lower: f64::midpoint(a.lower, b.lower),
                upper: f64::midpoint(a.upper, b.upper),
            }),
            (one, other) => one.or(other),
        }
    }

    /// Whether a point lies strictly inside.
    pub fn contains(&self, point: StPoint) -> bool {
        if point.t <= self.min_t() || point.t >= self.max_t() {
            return false;
        }
        let (left, right) = self.around(point.t);
        let (a, b) = (self.pairs()[left], self.pairs()[right]);
        let to_upper = cross(point, a.upper_point(), b.upper_point());
        let to_lower = cross(point, a.lower_point(), b.lower_point());
        to_upper * to_lower < 0.0
    }
}
