//! The road goes on where a file ends it.
//!
//! Scenes are cut out of longer roads. A car that starts or ends at the cut would have its wheels beside the road,
//! and brake for an end that is none; so the lanes on the ego's way are drawn on, straight and as wide as they are.

use crate::import::lanelets::Lanelet;
use corridor_decider::geometry::Vec2;
use corridor_decider::road::{LaneId, RoadMap};

/// Which end of a lanelet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// Where it is entered.
    Behind,
    /// Where it is left.
    Ahead,
}

/// Length of road before the file's, m: room for what of the car lies behind its middle, and to see where it is.
const BEHIND: f64 = 30.0;

/// Length of road after the file's, m: what one plans ahead, and then as far as a car gets while it brakes.
pub(super) const AHEAD: f64 = 300.0;

/// The lanelets with those that go on at the ends of some lanes of their map. Places of the others stay.
pub(super) fn lengthened(lanelets: &[Lanelet], map: &RoadMap, ends: &[(LaneId, End)]) -> Vec<Lanelet> {
    let mut all = lanelets.to_vec();
    for (lane, end) in ends {
        let name = &map.lane(*lane).name;
        let Some(number) = lanelets.iter().position(|lanelet| lanelet.name == *name) else {
            continue;
        };
        let Some(more) = continuation(&lanelets[number], number, *end) else {
            continue;
        };
        all.push(more);
    }
    all
}

/// What goes on at one end of a lanelet: as wide as that end, along its middle.
fn continuation(lanelet: &Lanelet, number: usize, end: End) -> Option<Lanelet> {
    let (left, right) = (&lanelet.left, &lanelet.right);
    let middle = |left: Vec2, right: Vec2| (left + right) / 2.0;
    let last_pair = |bound: &[Vec2]| match end {
        End::Ahead => Some((*bound.get(bound.len().checked_sub(2)?)?, *bound.last()?)),
        End::Behind => Some((*bound.first()?, *bound.get(1)?)),
    };
    let ((left_from, left_to), (right_from, right_to)) = (last_pair(left)?, last_pair(right)?);
    let along = (middle(left_to, right_to) - middle(left_from, right_from)).try_normalize(1e-6)?;
    let (left, right) = match end {
        End::Ahead => (
            vec![left_to, left_to + along * AHEAD],
            vec![right_to, right_to + along * AHEAD],
        ),
        End::Behind => (
            vec![left_from - along * BEHIND, left_from],
            vec![right_from - along * BEHIND, right_from],
        ),
    };
    let (suffix, predecessors, successors) = match end {
        End::Ahead => ("ahead", vec![number], Vec::new()),
        End::Behind => ("behind", Vec::new(), vec![number]),
    };
    Some(Lanelet {
        name: format!("{}.{suffix}", lanelet.name),
        left,
        right,
        neighbours: [None; 4],
        predecessors,
        successors,
        junction: None,
        ..lanelet.clone()
    })
}
