//! What an OpenDRIVE file says, as plain structs: numbers checked, names resolved to enums, nothing computed.
//!
//! Stations are the road's, from its start, in metres. Lane lists run from left to right (descending id)
//! and do not contain lane 0.

use super::geometry::Piece;
use super::profile::Profile;
use crate::import::xml::Place;
use corridor_decider::road::{BoundaryType, LaneKind};

/// One end of a road, of a section or of a lane, along the road's station.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum End {
    /// Where the station is least.
    Start,
    /// Where it is greatest.
    Finish,
}

impl End {
    pub(super) fn other(self) -> Self {
        match self {
            Self::Start => Self::Finish,
            Self::Finish => Self::Start,
        }
    }
}

/// What a road's end touches.
#[derive(Clone, Debug)]
pub(super) enum RoadLink {
    /// The end of another road; `None`: the file does not say which.
    Road { id: String, contact: Option<End> },
    /// A road at a station in its middle, as in virtual junctions.
    Middle { id: String, s: f64 },
    /// A junction.
    Junction(String),
}

/// A road.
#[derive(Debug)]
pub(super) struct Road {
    pub(super) id: String,
    pub(super) place: Place,
    /// Usable length of the reference line, m.
    pub(super) length: f64,
    /// Whether traffic keeps left.
    pub(super) left_hand: bool,
    /// Id of the junction that this road leads through.
    pub(super) junction: Option<String>,
    /// What the start and the end touch.
    pub(super) links: [Option<RoadLink>; 2],
    pub(super) speeds: Vec<SpeedRecord>,
    pub(super) signs: Vec<SpeedSign>,
    pub(super) pieces: Vec<Piece>,
    pub(super) offset: Profile,
    pub(super) sections: Vec<Section>,
}

impl Road {
    pub(super) fn link(&self, end: End) -> Option<&RoadLink> {
        match end {
            End::Start => self.links[0].as_ref(),
            End::Finish => self.links[1].as_ref(),
        }
    }

    /// First and last station of a section, within the road.
    pub(super) fn extent(&self, section: usize) -> (f64, f64) {
        let end = self
            .sections
            .get(section + 1)
            .map_or(self.length, |next| next.s.min(self.length));
        (self.sections[section].s.max(0.0), end)
    }
}

/// A stretch of road with a constant list of lanes.
#[derive(Clone, Debug)]
pub(super) struct Section {
    /// First station.
    pub(super) s: f64,
    pub(super) place: Place,
    /// From left to right.
    pub(super) lanes: Vec<LaneRecord>,
    /// The line on lane 0.
    pub(super) centre_marks: Vec<MarkRecord>,
}

impl Section {
    /// Place of a lane id in the list.
    pub(super) fn find(&self, id: i32) -> Option<usize> {
        self.lanes.binary_search_by(|lane| id.cmp(&lane.id)).ok()
    }

    /// How many lanes lie left of lane 0.
    pub(super) fn left_count(&self) -> usize {
        self.lanes.partition_point(|lane| lane.id > 0)
    }
}

/// How the file gives a lane's lateral extent.
#[derive(Clone, Debug)]
pub(super) enum Extent {
    /// Width.
    Width(Profile),
    /// Lateral position of the outer edge, from lane 0.
    Border(Profile),
}

impl Extent {
    pub(super) fn profile(&self) -> &Profile {
        match self {
            Self::Width(profile) | Self::Border(profile) => profile,
        }
    }
}

/// How a lane is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    /// As its side of the road is.
    Standard,
    /// Against that.
    Reversed,
    /// In both directions.
    Both,
}

/// A lane of a section.
#[derive(Clone, Debug)]
pub(super) struct LaneRecord {
    /// Positive left of lane 0, counted outward.
    pub(super) id: i32,
    pub(super) place: Place,
    pub(super) kind: LaneKind,
    pub(super) direction: Direction,
    /// By road station.
    pub(super) extent: Extent,
    /// The line on the outer edge.
    pub(super) marks: Vec<MarkRecord>,
    pub(super) speeds: Vec<SpeedRecord>,
    /// Lane ids beyond the start and beyond the end of the section.
    pub(super) links: [Vec<i32>; 2],
}

/// A line from a road station on, as seen from its left (towards positive `t`) and from its right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MarkRecord {
    pub(super) s: f64,
    pub(super) from_left: BoundaryType,
    pub(super) from_right: BoundaryType,
    /// Whether the file's `laneChange` lets cross it from the left and from the right.
    pub(super) change: [bool; 2],
}

/// A speed limit from a road station on, m/s; infinite: none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SpeedRecord {
    pub(super) s: f64,
    pub(super) limit: f64,
}

/// A sign that sets a speed limit, m/s, or ends one; infinite: none.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SpeedSign {
    pub(super) s: f64,
    pub(super) limit: f64,
    /// Whether it is for traffic along the road's station; `None`: for all.
    pub(super) forward: Option<bool>,
    /// First and last lane ids that it is for; none: all.
    pub(super) lanes: Vec<(i32, i32)>,
}

/// A junction.
#[derive(Debug)]
pub(super) struct JunctionRecord {
    pub(super) id: String,
    pub(super) connections: Vec<Connection>,
}

/// A way through a junction.
#[derive(Debug)]
pub(super) struct Connection {
    pub(super) place: Place,
    /// The road that comes in.
    pub(super) incoming: String,
    /// The road that leads through or, without one, the road that goes on.
    pub(super) connecting: String,
    /// The end of `connecting` that touches `incoming`.
    pub(super) contact: Option<End>,
    /// Pairs of lane ids: of `incoming` and of `connecting`.
    pub(super) lanes: Vec<(i32, i32)>,
}
