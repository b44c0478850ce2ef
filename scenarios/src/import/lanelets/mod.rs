//! Lanes between two bounds, as CommonRoad and Lanelet2 draw them, turned into a road map.

use corridor_decider::geometry::Vec2;
use corridor_decider::road::{BoundaryType, LaneKind};

/// A lane between two polylines. References to others are places in the same list.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lanelet {
    /// Its name, unique in the file.
    pub name: String,
    /// What it is for.
    pub kind: LaneKind,
    /// Left bound in driving direction, at least two points.
    pub left: Vec<Vec2>,
    /// Right bound in driving direction; the number of points may differ.
    pub right: Vec<Vec2>,
    /// Line on the left bound.
    pub left_mark: BoundaryType,
    /// Line on the right bound.
    pub right_mark: BoundaryType,
    /// Adjacent lanelets, indexed by [`corridor_decider::road::Neighbour::index`].
    pub neighbours: [Option<usize>; 4],
    /// Lanelets that lead here.
    pub predecessors: Vec<usize>,
    /// Lanelets to go on to.
    pub successors: Vec<usize>,
    /// Speed limit, m/s.
    pub speed_limit: Option<f64>,
    /// The junction it leads through: a place in the list of their names.
    pub junction: Option<usize>,
}
