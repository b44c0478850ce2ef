//! An HD map as the original sees it: polylines with tables of widths beside them.
//!
//! [`MapData`] is what a file says, [`HdMap`] what has been checked and linked, and a [`Path`] a line along its lanes.

mod aabb_tree;
mod boxes;
mod data;
mod lane;
mod line;
mod map;
mod object;
mod of_roads;
mod overlaps;
mod path;
mod polyline;
mod query;
mod segment;
mod shape;
#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod wild;

pub use boxes::SlBox;
pub use data::{
    Area, BoundaryData, Direction, EdgeData, EdgeKind, HdLaneKind, LaneData, MapData, Overlap, OverlapKind,
    OverlapObject, RoadData, RoadKind, SectionData, StopLines, Turn,
};
pub use lane::{HalfWidths, HdLane};
pub use line::{CartesianState, FrenetState};
pub use map::{HdMap, HdMapError};
pub use object::ObjectKind;
pub use overlaps::PathOverlap;
pub use path::{Path, PathError, PathPoint, PathQuirks};
pub use polyline::{Foot, Projection};
pub use query::NearLane;
pub use segment::{LaneSegment, LaneWaypoint, SEGMENT_TOLERANCE};
