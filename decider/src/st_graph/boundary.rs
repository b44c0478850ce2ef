//! A boundary in the ST graph: what an obstacle occupies of the path, as a strip over time.
//!
//! After the original's `STBoundary`. The strip is a polygon between a lower and an upper polyline over the same
//! times. It is checked when it is made, and can then only be asked or turned into another one.

use super::StPoint;
use serde::{Deserialize, Serialize};

/// Times of neighbouring pairs differ by more than this, s.
const TIME_STEP: f64 = 1e-6;

/// A strip of less area than this is a line, m s.
const LEAST_AREA: f64 = 1e-10;

/// Both ends of a pair that is dropped lie nearer than this to the edges without it, in the `(t, s)` plane.
const REDUNDANT: f64 = 0.1;

/// The least height, m, that extending a strip in time leaves at its ends.
const LEAST_HEIGHT: f64 = 1e-3;

/// The extent of a boundary at one time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StPair {
    /// Time, s.
    pub t: f64,
    /// Where it begins, m.
    pub lower: f64,
    /// Where it ends, m.
    pub upper: f64,
}

impl StPair {
    /// A pair from its three numbers.
    pub const fn new(t: f64, lower: f64, upper: f64) -> Self {
        Self { t, lower, upper }
    }

    pub(super) const fn lower_point(&self) -> StPoint {
        StPoint::new(self.t, self.lower)
    }

    pub(super) const fn upper_point(&self) -> StPoint {
        StPoint::new(self.t, self.upper)
    }
}

/// What has been decided about the obstacle that a boundary belongs to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "SCREAMING_SNAKE_CASE")]
pub enum BoundaryType {
    /// Nothing yet.
    #[default]
    Unknown,
    /// Stop before it.
    Stop,
    /// Stay behind it.
    Follow,
    /// Let it pass.
    Yield,
    /// Pass before it.
    Overtake,
    /// A zone in which one must not stand.
    KeepClear,
}

/// Why pairs make no boundary.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StBoundaryError {
    /// Fewer than two.
    #[error("{0} pairs; a boundary has two or more")]
    TooFew(usize),
    /// A number is not finite.
    #[error("the pair at place {0} is not finite")]
    NotFinite(usize),
    /// The upper end lies below the lower one.
    #[error("the pair at place {0} ends before it begins")]
    UpsideDown(usize),
    /// Not later than the one before it.
    #[error("the pair at place {0} is not later than the one before it")]
    NotLater(usize),
    /// The polygon is a line.
    #[error("the pairs enclose no area")]
    NoArea,
}

/// A strip of the ST graph that is occupied. At least two pairs, by ascending time, enclosing an area.
#[derive(Clone, Debug, PartialEq)]
pub struct StBoundary {
    pairs: Vec<StPair>,
    min_s: f64,
    max_s: f64,
    /// What has been decided about it.
    pub kind: BoundaryType,
    /// The distance that belongs to the decision, m: kept to a leader, left before a fence.
    pub characteristic_length: f64,
}

impl StBoundary {
    /// A boundary of exactly these pairs.
    ///
    /// # Errors
    ///
    /// When there are fewer than two, or they are out of order, upside down, not finite or enclose nothing.
    pub fn new(pairs: Vec<StPair>) -> Result<Self, StBoundaryError> {
        check(&pairs)?;
        let boundary = Self {
            min_s: pairs.iter().map(|pair| pair.lower).fold(f64::MAX, f64::min),
            max_s: pairs.iter().map(|pair| pair.upper).fold(-f64::MAX, f64::max),
            pairs,
            kind: BoundaryType::Unknown,
            characteristic_length: 1.0,
        };
        if boundary.area() > LEAST_AREA {
            Ok(boundary)
        } else {
            Err(StBoundaryError::NoArea)
        }
    }

    /// A boundary of these pairs without those that hardly change its shape.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn reduced(mut pairs: Vec<StPair>) -> Result<Self, StBoundaryError> {
        check(&pairs)?;
        drop_redundant(&mut pairs);
        Self::new(pairs)
    }

    /// The same strip with a decision.
    #[must_use]
    pub fn with_kind(self, kind: BoundaryType) -> Self {
        Self { kind, ..self }
    }

    /// The same strip with the distance that belongs to its decision, m.
    #[must_use]
    pub fn with_characteristic_length(self, characteristic_length: f64) -> Self {
        Self {
            characteristic_length,
            ..self
        }
    }

    /// Its pairs, by ascending time.
    pub fn pairs(&self) -> &[StPair] {
        &self.pairs
    }

    /// Its first pair.
    pub fn first(&self) -> StPair {
        self.pairs[0]
    }

    /// Its last pair.
    pub fn last(&self) -> StPair {
        self.pairs[self.pairs.len() - 1]
    }

    /// Where it begins at the nearest, m.
    pub fn min_s(&self) -> f64 {
        self.min_s
    }

    /// Where it ends at the farthest, m.
    pub fn max_s(&self) -> f64 {
        self.max_s
    }

    /// When it begins, s.
    pub fn min_t(&self) -> f64 {
        self.pairs[0].t
    }

    /// When it ends, s.
    pub fn max_t(&self) -> f64 {
        self.last().t
    }

    /// Enclosed area, m s.
    pub fn area(&self) -> f64 {
        let trapezium = |pair: &[StPair]| {
            (pair[1].t - pair[0].t) * (pair[0].upper - pair[0].lower + pair[1].upper - pair[1].lower) * 0.5
        };
        self.pairs.windows(2).map(trapezium).sum()
    }

    /// Longer by `by` metres at both ends at all times (shorter for a negative one), without decision.
    ///
    /// # Errors
    ///
    /// When it is made shorter by more than there is.
    pub fn expanded_by_s(&self, by: f64) -> Result<Self, StBoundaryError> {
        let moved = |pair: &StPair| StPair::new(pair.t, pair.lower - by, pair.upper + by);
        Self::reduced(self.pairs.iter().map(moved).collect())
    }

    /// Longer by `by` seconds at both ends, along the first and the last edge, without decision.
    ///
    /// # Errors
    ///
    /// When `by` is negative or too short to be told from 0, and when lengths overflow.
    pub fn expanded_by_t(&self, by: f64) -> Result<Self, StBoundaryError> {
        let mut before = extended(self.pairs[0], self.pairs[1], -by);
        before.lower = before.lower.min(before.upper - LEAST_HEIGHT);
        let n = self.pairs.len();
        let mut after = extended(self.pairs[n - 1], self.pairs[n - 2], by);
        after.upper = after.upper.max(after.lower + LEAST_HEIGHT);
        let mut pairs = Vec::with_capacity(n + 2);
        pairs.push(before);
        pairs.extend_from_slice(&self.pairs);
        pairs.push(after);
        Self::reduced(pairs)
    }

    /// What is left of it from `t` on, without decision; `None` where no two pairs are.
    ///
    /// # Errors
    ///
    /// When what is left encloses nothing.
    pub fn cut_off_before(&self, t: f64) -> Result<Option<Self>, StBoundaryError> {
        let left: Vec<StPair> = self.pairs.iter().copied().filter(|pair| pair.t >= t).collect();
        if left.len() < 2 {
            return Ok(None);
        }
        Self::reduced(left).map(Some)
    }
}

/// `end` moved on by `by` seconds along the edge between it and its neighbour.
fn extended(end: StPair, neighbour: StPair, by: f64) -> StPair {
    let dt = neighbour.t - end.t;
    let at = |value: f64, beside: f64| value + by * (beside - value) / dt;
    StPair::new(
        end.t + by,
        at(end.lower, neighbour.lower),
        at(end.upper, neighbour.upper),
    )
}

fn check(pairs: &[StPair]) -> Result<(), StBoundaryError> {
    if pairs.len() < 2 {
        return Err(StBoundaryError::TooFew(pairs.len()));
    }
    for (k, pair) in pairs.iter().enumerate() {
        if !(pair.t.is_finite() && pair.lower.is_finite() && pair.upper.is_finite()) {
            return Err(StBoundaryError::NotFinite(k));
        }
        if pair.upper < pair.lower {
            return Err(StBoundaryError::UpsideDown(k));
        }
        if k > 0 && pair.t <= pairs[k - 1].t + TIME_STEP {
            return Err(StBoundaryError::NotLater(k));
        }
    }
    Ok(())
}

/// Drops pairs between the last one kept and the next one that lie near the straight edges between these. The first
/// and the last pair stay.
fn drop_redundant(pairs: &mut Vec<StPair>) {
    if pairs.len() <= 2 {
        return;
    }
    let mut anchor = 0;
    for k in 1..pairs.len() - 1 {
        let (from, at, to) = (pairs[anchor], pairs[k], pairs[k + 1]);
        let is_redundant = is_near(at.lower_point(), from.lower_point(), to.lower_point())
            && is_near(at.upper_point(), from.upper_point(), to.upper_point());
        if !is_redundant {
            anchor += 1;
            pairs[anchor] = at;
        }
    }
    pairs[anchor + 1] = pairs[pairs.len() - 1];
    pairs.truncate(anchor + 2);
}

fn is_near(point: StPoint, from: StPoint, to: StPoint) -> bool {
    let (dt, ds) = (to.t - from.t, to.s - from.s);
    let share = ((point.t - from.t) * dt + (point.s - from.s) * ds) / (dt * dt + ds * ds);
    let share = share.clamp(0.0, 1.0);
    let (et, es) = (point.t - from.t - share * dt, point.s - from.s - share * ds);
    et * et + es * es < REDUNDANT * REDUNDANT
}
