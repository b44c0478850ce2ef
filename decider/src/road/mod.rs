//! The road map: what a planner reads of the world that does not move.
//!
//! A [`RoadMap`] holds lanes in driving direction with their edges, marks, neighbours and successors.
//! It knows no file format; importers fill it through [`RoadMap::new`], which checks it.

mod index;
mod lane;
mod map;
#[cfg(test)]
mod tests;

pub use lane::{BoundaryType, Lane, LaneId, LaneKind, LanePoint, Mark, Neighbour, Side};
pub use map::{Junction, JunctionId, MapError, RoadMap};
