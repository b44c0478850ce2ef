//! The field's order of preference among bounds: pull-over, change of lane, the own lane, a borrowed one, and last the
//! fallback.

use super::passing;
use crate::context::Context;
use crate::tasks::path_bounds::{Borrow, Label, PathBound};
use crate::tasks::scene::Scene;

/// Overhang from which a car counts as out of its lane, m.
const OUT_OF_LANE: f64 = 0.2;

/// Places of the bounds by preference. A car that is out of its lane comes back inside the borrowed bound, which holds
/// both lanes.
pub fn in_order(scene: &Scene, bounds: &[PathBound], context: &Context) -> Vec<usize> {
    let is_out = passing::overhang(scene) > OUT_OF_LANE && !context.borrow.sides.is_empty();
    let rank = |label: Label| match label {
        Label::PullOver => 0,
        Label::LaneChange => 1,
        label if is_own_lane(label) => {
            if is_out {
                4
            } else {
                2
            }
        }
        Label::Regular { .. } => 3,
        Label::Fallback => 5,
    };
    let mut places: Vec<usize> = (0..bounds.len()).collect();
    places.sort_by_key(|place| rank(bounds[*place].label));
    places
}

/// Whether a neighbouring lane is used.
pub fn is_borrowed(label: Label) -> bool {
    matches!(
        label,
        Label::Regular {
            borrow: Borrow::Left | Borrow::Right,
            ..
        }
    )
}

/// Whether only the own lane is used.
pub fn is_own_lane(label: Label) -> bool {
    matches!(
        label,
        Label::Regular {
            borrow: Borrow::None,
            ..
        }
    )
}
