//! What an HD map file says, checked by nobody yet: plain data in the shape of the original's messages.
//!
//! Metres, radians, metres per second. Points run in driving direction. `left` and `right` are seen in driving
//! direction, widths are positive. Fields that a file may leave out are `Option`s or empty lists. Source: the
//! original's `modules/common_msgs/map_msgs`.

use crate::geometry::Vec2;
use crate::road::BoundaryType;

/// A whole map.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MapData {
    /// The projection of its coordinates, as the file writes it.
    pub projection: Option<String>,
    /// Lanes in file order.
    pub lanes: Vec<LaneData>,
    /// Roads in file order.
    pub roads: Vec<RoadData>,
    /// Areas in which roads cross, merge or fork.
    pub junctions: Vec<Area>,
    /// The same as planning sees them.
    pub pnc_junctions: Vec<Area>,
    /// Crosswalks.
    pub crosswalks: Vec<Area>,
    /// Areas to keep free.
    pub clear_areas: Vec<Area>,
    /// Parking spaces.
    pub parking_spaces: Vec<Area>,
    /// Traffic lights with their stop lines.
    pub signals: Vec<StopLines>,
    /// Stop signs with their stop lines.
    pub stop_signs: Vec<StopLines>,
    /// Yield signs with their stop lines.
    pub yield_signs: Vec<StopLines>,
    /// Speed bumps with the lines across them.
    pub speed_bumps: Vec<StopLines>,
    /// What lies on what.
    pub overlaps: Vec<Overlap>,
}

/// A lane as its file has it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LaneData {
    /// Its name.
    pub id: String,
    /// Points of the centre line.
    pub points: Vec<Vec2>,
    /// The length that the file names, m; not that of the points.
    pub length: f64,
    /// Speed limit, m/s.
    pub speed_limit: Option<f64>,
    /// What it is for.
    pub kind: HdLaneKind,
    /// How it turns.
    pub turn: Turn,
    /// In which direction it is driven.
    pub direction: Direction,
    /// Its left edge.
    pub left_boundary: BoundaryData,
    /// Its right edge.
    pub right_boundary: BoundaryData,
    /// Names of the overlaps it takes part in.
    pub overlaps: Vec<String>,
    /// Names of lanes that lead here.
    pub predecessors: Vec<String>,
    /// Names of lanes to go on to.
    pub successors: Vec<String>,
    /// Names of adjacent lanes, indexed by [`crate::road::Neighbour::index`].
    pub neighbours: [Vec<String>; 4],
    /// The junction that the file names for it.
    pub junction: Option<String>,
    /// Half widths `(s, width)` to the left edge of the lane.
    pub left_samples: Vec<(f64, f64)>,
    /// Half widths to the right edge of the lane.
    pub right_samples: Vec<(f64, f64)>,
    /// Half widths to the left edge of the road.
    pub left_road_samples: Vec<(f64, f64)>,
    /// Half widths to the right edge of the road.
    pub right_road_samples: Vec<(f64, f64)>,
}

/// What a lane is for, in the original's classes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HdLaneKind {
    /// Nothing known.
    #[default]
    None,
    /// For cars.
    CityDriving,
    /// For bicycles.
    Biking,
    /// For pedestrians.
    Sidewalk,
    /// To park in.
    Parking,
    /// To stop on.
    Shoulder,
    /// For cars and bicycles.
    Shared,
}

/// How a lane turns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Turn {
    /// It follows its road.
    #[default]
    NoTurn,
    /// To the left.
    LeftTurn,
    /// To the right.
    RightTurn,
    /// Back.
    UTurn,
}

/// In which direction of its points a lane is driven.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// In theirs.
    #[default]
    Forward,
    /// Against theirs.
    Backward,
    /// In both.
    Bidirection,
}

/// One edge of a lane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoundaryData {
    /// Its points; may be empty.
    pub points: Vec<Vec2>,
    /// Whether nothing is painted.
    pub is_virtual: bool,
    /// Types by ascending station; each entry holds from its station on.
    pub types: Vec<(f64, Vec<BoundaryType>)>,
}

/// A road: sections of lanes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RoadData {
    /// Its name; may be empty.
    pub id: String,
    /// The junction it lies in; may be empty.
    pub junction: String,
    /// Its class.
    pub kind: RoadKind,
    /// Its sections.
    pub sections: Vec<SectionData>,
}

/// The class of a road.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RoadKind {
    /// Nothing known.
    #[default]
    Unknown,
    /// A motorway.
    Highway,
    /// A street.
    CityRoad,
    /// A road through a car park.
    Park,
}

/// Lanes side by side.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SectionData {
    /// Its name.
    pub id: String,
    /// Names of its lanes, in no order that can be relied on.
    pub lanes: Vec<String>,
    /// Edges of its surface.
    pub edges: Vec<EdgeData>,
}

/// One edge of a section's surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EdgeData {
    /// Its points.
    pub points: Vec<Vec2>,
    /// Which edge it is.
    pub kind: EdgeKind,
}

/// Which edge of the road's surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EdgeKind {
    /// Nothing known.
    #[default]
    Unknown,
    /// Neither side in particular.
    Normal,
    /// The left one.
    Left,
    /// The right one.
    Right,
}

/// A polygon with a name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Area {
    /// Its name.
    pub id: String,
    /// Its corners.
    pub polygon: Vec<Vec2>,
    /// Names of the overlaps it takes part in.
    pub overlaps: Vec<String>,
}

/// A sign or a light with the lines at which it stops traffic.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StopLines {
    /// Its name.
    pub id: String,
    /// The lines.
    pub lines: Vec<Vec<Vec2>>,
    /// The outline of the thing itself; may be empty.
    pub boundary: Vec<Vec2>,
    /// Names of the overlaps it takes part in.
    pub overlaps: Vec<String>,
}

/// Things that lie on each other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlap {
    /// Its name.
    pub id: String,
    /// Which things.
    pub objects: Vec<OverlapObject>,
}

/// One of the things of an overlap.
#[derive(Clone, Debug, PartialEq)]
pub struct OverlapObject {
    /// Its name.
    pub id: String,
    /// What it is, as far as the file tells.
    pub kind: Option<OverlapKind>,
}

/// What kind of thing overlaps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OverlapKind {
    /// A lane, over a stretch of it.
    Lane {
        /// First station on the lane, m.
        start_s: f64,
        /// Last station on the lane, m.
        end_s: f64,
        /// Whether it merges with the other lane.
        is_merge: bool,
    },
    /// A traffic light.
    Signal,
    /// A stop sign.
    StopSign,
    /// A crosswalk.
    Crosswalk,
    /// A junction.
    Junction,
    /// A yield sign.
    YieldSign,
    /// An area to keep free.
    ClearArea,
    /// A speed bump.
    SpeedBump,
    /// A parking space.
    ParkingSpace,
    /// A junction as planning sees it.
    PncJunction,
    /// Something that no task asks for.
    Other,
}
