//! Which lanes follow and which lie beside each other, by the ways and nodes that they share.

use super::bounds::Bound;
use corridor_decider::geometry::cross;
use corridor_decider::road::{Neighbour, Side};
use std::collections::BTreeMap;

/// Most lanes that one leads on to, and most on one bound. Real forks have five or so; a file of a thousand lanelets between
/// the same four nodes must not have a million links.
const MOST: usize = 16;

/// The bounds of a lane in driving direction.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bounds {
    pub(super) left: Bound,
    pub(super) right: Bound,
}

impl Bounds {
    /// Left and right node where the lane begins (0) or ends (1).
    fn cut(&self, end: usize) -> [i64; 2] {
        [self.left.ends[end], self.right.ends[end]]
    }

    /// By how much the lane turns from its first chord to its last one, rad, left positive.
    pub(super) fn turn(&self) -> f64 {
        let [first, second, ..] = self.left.points[..] else {
            return 0.0;
        };
        let last = &self.left.points[self.left.points.len() - 2..];
        let (before, after) = (second - first, last[1] - last[0]);
        libm::atan2(cross(before, after), before.dot(&after))
    }

    /// The bounds of the lane that leads back on the same ground.
    pub(super) fn turned_round(&self) -> Self {
        Self {
            left: self.right.clone().turned_round(),
            right: self.left.clone().turned_round(),
        }
    }
}

/// For each lane the lanes that begin with the two nodes with which it ends.
pub(super) fn successors(lanes: &[Bounds]) -> Vec<Vec<usize>> {
    let mut starting: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    for (number, lane) in lanes.iter().enumerate() {
        let there = starting.entry(lane.cut(0)).or_default();
        if there.len() < MOST {
            there.push(number);
        }
    }
    let next = |(number, lane): (usize, &Bounds)| {
        let cut = lane.cut(1);
        // A lane that has closed leads nowhere.
        let found = starting.get(&cut).filter(|_| cut[0] != cut[1]);
        found
            .into_iter()
            .flatten()
            .copied()
            .filter(|other| *other != number)
            .collect()
    };
    lanes.iter().enumerate().map(next).collect()
}

/// Lanes side by side.
#[derive(Debug, Default)]
pub(super) struct Sides {
    /// Indexed by [`Neighbour::index`].
    pub(super) neighbours: Vec<[Option<usize>; 4]>,
    /// Pairs of lanes that see the oncoming one on their (left, right).
    pub(super) oncoming: (usize, usize),
}

/// The neighbours of each lane: those that have the same way as a bound. Lanes with the same `ground` lie on each
/// other, not side by side. Only what `is_telling` tells the traffic side: one-way lanes.
pub(super) fn sides(lanes: &[Bounds], ground: &[usize], is_telling: &[bool]) -> Sides {
    let mut users: BTreeMap<(i64, bool, Side), Vec<usize>> = BTreeMap::new();
    for (number, lane) in lanes.iter().enumerate() {
        for (bound, side) in [(&lane.left, Side::Left), (&lane.right, Side::Right)] {
            let there = users.entry((bound.way, bound.inverted, side)).or_default();
            if there.len() < MOST {
                there.push(number);
            }
        }
    }
    let mut sides = Sides::default();
    for (number, lane) in lanes.iter().enumerate() {
        let beside = |kind: Neighbour| {
            let bound = match kind.side {
                Side::Left => &lane.left,
                Side::Right => &lane.right,
            };
            // The other lane has the way on its other side, or it runs along it the other way.
            let (inverted, side) = if kind.reverse {
                (!bound.inverted, kind.side)
            } else {
                (bound.inverted, kind.side.opposite())
            };
            let there = users.get(&(bound.way, inverted, side))?;
            there
                .iter()
                .copied()
                .find(|other| ground[*other] != ground[number])
        };
        let found = Neighbour::ALL.map(beside);
        let sees = |side| {
            let other = found[Neighbour { side, reverse: true }.index()];
            usize::from(is_telling[number] && other.is_some_and(|other| is_telling[other]))
        };
        sides.oncoming.0 += sees(Side::Left);
        sides.oncoming.1 += sees(Side::Right);
        sides.neighbours.push(found);
    }
    sides
}
