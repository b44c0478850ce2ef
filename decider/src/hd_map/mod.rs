//! An HD map as the original sees it: polylines with tables of widths beside them.

mod data;

pub use data::{
    Area, BoundaryData, Direction, EdgeData, EdgeKind, HdLaneKind, LaneData, MapData, Overlap, OverlapKind,
    OverlapObject, RoadData, RoadKind, SectionData, StopLines, Turn,
};
