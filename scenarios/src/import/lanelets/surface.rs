//! The road surface beside a lanelet: which bounds lie one behind the other on each side.

use super::Lanelet;
use corridor_decider::road::{Neighbour, Side};

/// Most lanes on one side that are walked over.
const MOST_LANES: usize = 32;

/// A bound beyond the own one, seen from a lanelet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FarBound {
    /// The lanelet whose bound it is.
    pub(super) lanelet: usize,
    /// Which of its bounds, in its own driving direction.
    pub(super) side: Side,
    /// Whether that direction is against ours.
    pub(super) reverse: bool,
}

/// The outer bounds of the lanes on `side` of a lanelet that are one surface with it, from the nearest on.
pub(super) fn far_bounds(
    lanelets: &[Lanelet],
    neighbours: &[[Option<usize>; 4]],
    lanelet: usize,
    side: Side,
) -> Vec<FarBound> {
    let mut bounds: Vec<FarBound> = Vec::new();
    let (mut at, mut reverse) = (lanelet, false);
    if !lanelets[lanelet].kind.is_road_surface() {
        return bounds;
    }
    while bounds.len() < MOST_LANES {
        let seen = if reverse { side.opposite() } else { side };
        let beside = |oncoming: bool| {
            let kind = Neighbour {
                side: seen,
                reverse: oncoming,
            };
            Some((neighbours[at][kind.index()]?, reverse != oncoming))
        };
        let Some((next, next_reverse)) = beside(false).or_else(|| beside(true)) else {
            break;
        };
        let again = next == lanelet || bounds.iter().any(|bound| bound.lanelet == next);
        if again || !lanelets[next].kind.is_road_surface() {
            break;
        }
        (at, reverse) = (next, next_reverse);
        let side = if reverse { side.opposite() } else { side };
        bounds.push(FarBound {
            lanelet: at,
            side,
            reverse,
        });
    }
    bounds
}
