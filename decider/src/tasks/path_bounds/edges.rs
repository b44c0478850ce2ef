//! The elementary updates of a bound.

use super::bound::{BoundPoint, EdgeCause};
use super::stations::Station;

/// A limit on one side, with its cause.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limit {
    pub l: f64,
    pub cause: EdgeCause,
}

/// The point that two limits leave at a station; `None` where that is nothing. A limit that is no number is none.
pub(super) fn between(s: f64, right: Limit, left: Limit) -> Option<BoundPoint> {
    let (l_min, l_max) = (right.l.max(-f64::MAX), left.l.min(f64::MAX));
    (l_min <= l_max).then_some(BoundPoint {
        s,
        l_min,
        l_max,
        right: right.cause,
        left: left.cause,
    })
}

/// A bound without limits at every station.
pub(super) fn unbounded(stations: &[Station]) -> Vec<BoundPoint> {
    let open = |station: &Station| BoundPoint {
        s: station.s,
        l_min: -f64::MAX,
        l_max: f64::MAX,
        right: EdgeCause::Unbounded,
        left: EdgeCause::Unbounded,
    };
    stations.iter().map(open).collect()
}

/// Narrows a point to what both it and the limits allow. When that is nothing the point stays as it was and
/// the answer is `false`; a corridor of no width is still one.
pub(super) fn tighten(point: &mut BoundPoint, right: Limit, left: Limit) -> bool {
    let mut narrowed = *point;
    narrow(&mut narrowed, right, left);
    let open = narrowed.l_min <= narrowed.l_max;
    if open {
        *point = narrowed;
    }
    open
}

/// Narrows a point, even beyond nothing.
pub(super) fn narrow(point: &mut BoundPoint, right: Limit, left: Limit) {
    if right.l > point.l_min {
        (point.l_min, point.right) = (right.l, right.cause);
    }
    if left.l < point.l_max {
        (point.l_max, point.left) = (left.l, left.cause);
    }
}
