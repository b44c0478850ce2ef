//! The two bounds of a lanelet, brought into driving direction with left on the left.

use super::records::File;
use corridor_decider::geometry::{Vec2, cross};
use std::collections::BTreeMap;

/// A way as the bound of a lane.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bound {
    pub(super) way: i64,
    /// Whether the lane is driven against the order of the way's nodes.
    pub(super) inverted: bool,
    /// First and last node in driving direction.
    pub(super) ends: [i64; 2],
    /// In driving direction.
    pub(super) points: Vec<Vec2>,
}

impl Bound {
    /// The way as it is drawn; `None` when it has no two points.
    pub(super) fn of(file: &File<'_>, positions: &BTreeMap<i64, Vec2>, way: i64) -> Option<Self> {
        let record = file.ways.get(&way)?;
        let known: Vec<(i64, Vec2)> = record
            .nodes
            .iter()
            .filter_map(|node| Some((*node, *positions.get(node)?)))
            .collect();
        let ([first, ..], [.., last]) = (known.as_slice(), known.as_slice()) else {
            return None;
        };
        (known.len() > 1).then(|| Self {
            way,
            inverted: false,
            ends: [first.0, last.0],
            points: known.iter().map(|(_, point)| *point).collect(),
        })
    }

    /// The same way, driven along in the other direction.
    pub(super) fn turned_round(mut self) -> Self {
        self.points.reverse();
        self.ends.reverse();
        self.inverted = !self.inverted;
        self
    }

    fn first(&self) -> Vec2 {
        self.points[0]
    }

    fn last(&self) -> Vec2 {
        self.points[self.points.len() - 1]
    }
}

/// Both bounds side by side in the direction in which `left` is on the left.
pub(super) fn aligned(left: Bound, right: Bound) -> (Bound, Bound) {
    let parallel = (left.first() - right.first()).norm() + (left.last() - right.last()).norm();
    let crossed = (left.first() - right.last()).norm() + (left.last() - right.first()).norm();
    let right = if crossed < parallel {
        right.turned_round()
    } else {
        right
    };
    // Forth on the left and back on the right is clockwise.
    if doubled_area(&left, &right) > 0.0 {
        (left.turned_round(), right.turned_round())
    } else {
        (left, right)
    }
}

/// Twice the area inside, positive when it is walked around counter-clockwise.
fn doubled_area(left: &Bound, right: &Bound) -> f64 {
    let origin = left.first();
    let outline: Vec<Vec2> = left
        .points
        .iter()
        .chain(right.points.iter().rev())
        .map(|p| p - origin)
        .collect();
    let next = outline.iter().cycle().skip(1);
    outline.iter().zip(next).map(|(a, b)| cross(*a, *b)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bound(way: i64, points: &[(f64, f64)]) -> Bound {
        Bound {
            way,
            inverted: false,
            ends: [10 * way, 10 * way + 1],
            points: points.iter().map(|(x, y)| Vec2::new(*x, *y)).collect(),
        }
    }

    #[test]
    fn the_direction_is_the_one_that_has_left_on_the_left() {
        let upper = || bound(1, &[(0.0, 3.0), (30.0, 3.0)]);
        let lower = || bound(2, &[(0.0, 0.0), (12.0, 0.0), (30.0, 0.0)]);
        let against = |bound: Bound| Bound {
            inverted: false,
            ..bound.turned_round()
        };
        for (left, right) in [
            (upper(), lower()),
            (upper(), against(lower())),
            (against(upper()), lower()),
            (against(upper()), against(lower())),
        ] {
            let (left, right) = aligned(left, right);
            assert_eq!(left.points, upper().points);
            assert_eq!(right.points, lower().points);
            // The same ways as right and left are the way back.
            let (left, right) = aligned(right, left);
            assert_eq!((left.first().x, right.last().x), (30.0, 0.0));
        }
    }

    #[test]
    fn a_wedge_runs_from_its_tip_when_that_is_left_of_it() {
        let left = bound(1, &[(0.0, 0.0), (30.0, 3.0)]);
        let right = bound(2, &[(30.0, 0.0), (0.0, 0.0)]);
        let (left, right) = aligned(left, right);
        assert!(!left.inverted && right.inverted);
        assert_eq!(right.ends, [21, 20]);
    }
}
