//! Whether a straight piece of a speed profile meets a boundary.

use super::{StBoundary, StPair, StPoint};

/// Edges nearer than this to a segment touch it, m: what rounding makes of a touch.
const TOUCH: f64 = 1e-11;

/// Where a segment is, seen from a boundary, at one time.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Below,
    Above,
}

impl StBoundary {
    /// Whether the segment between two points meets the boundary; touching counts. Either point may lie before
    /// or after it.
    pub fn meets_segment(&self, from: StPoint, to: StPoint) -> bool {
        let (from, to) = if from.t <= to.t { (from, to) } else { (to, from) };
        let beyond = to.t < self.min_t()
            || from.t > self.max_t()
            || from.s.max(to.s) < self.min_s()
            || from.s.min(to.s) > self.max_s();
        !beyond && self.meets_between(from, to)
    }

    /// The same for a segment within reach, forward in time.
    fn meets_between(&self, from: StPoint, to: StPoint) -> bool {
        let (start, end) = (from.t.max(self.min_t()), to.t.min(self.max_t()));
        if to.t - from.t <= 0.0 {
            let at = self.edges_at(from.t);
            return at.is_some_and(|edges| {
                from.s.max(to.s) >= edges.lower - TOUCH && from.s.min(to.s) <= edges.upper + TOUCH
            });
        }
        let slope = (to.s - from.s) / (to.t - from.t);
        let side = |pair: StPair| {
            let s = from.s + slope * (pair.t - from.t);
            if s < pair.lower - TOUCH {
                Some(Side::Below)
            } else if s > pair.upper + TOUCH {
                Some(Side::Above)
            } else {
                None
            }
        };
        let at = |t: f64| {
            self.edges_at(t)
                .and_then(|edges| side(StPair::new(t, edges.lower, edges.upper)))
        };
        // Both edges are straight between pairs, so a segment that is on one side at two of them and inside at neither
        // stays there; one that changes sides has passed through.
        let Some(first) = at(start) else { return true };
        let inner = self.pairs().partition_point(|pair| pair.t <= start);
        let mut between = self.pairs()[inner..].iter().take_while(|pair| pair.t < end);
        between.any(|pair| side(*pair) != Some(first)) || at(end) != Some(first)
    }
}
