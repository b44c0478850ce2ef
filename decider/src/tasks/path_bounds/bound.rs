//! A path bound: stations with a right and a left limit, and where each limit comes from.

use super::columns::BoundColumns;
use crate::frame::ObstacleId;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A corridor for the rear axle along one reference line. Half the car's width is already taken off.
///
/// Written compactly: see `BoundColumns`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "BoundColumns")]
pub struct PathBound {
    /// The situation it is for.
    pub label: Label,
    /// Distance between stations, m.
    pub delta_s: f64,
    /// Its stations, ascending.
    pub points: Vec<BoundPoint>,
    /// The obstacle that closes it, if one does.
    pub blocked_by: Option<ObstacleId>,
    /// Number of points at the end that lead through the blocking obstacle. Always 0 unless the quirk
    /// `pad_through_blocker` is on.
    pub padding: usize,
}

impl PathBound {
    /// First station, m along the reference line. 0 for an empty bound.
    pub fn start_s(&self) -> f64 {
        self.points.first().map_or(0.0, |p| p.s)
    }

    /// Last station that does not lead through a blocker.
    pub fn end_s(&self) -> f64 {
        let count = self.points.len() - self.padding.min(self.points.len());
        self.points[..count].last().map_or(0.0, |p| p.s)
    }
}

/// One station of a bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundPoint {
    /// Station along the reference line, m.
    pub s: f64,
    /// Right limit, m.
    pub l_min: f64,
    /// Left limit, m.
    pub l_max: f64,
    /// Where the right limit comes from.
    pub right: EdgeCause,
    /// Where the left limit comes from.
    pub left: EdgeCause,
}

/// Where a limit comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EdgeCause {
    /// Nothing limits it.
    Unbounded,
    /// The line of the own lane.
    LaneLine,
    /// The far line of the borrowed lane.
    BorrowedLane,
    /// The edge of the road.
    RoadEdge,
    /// Widened so that it holds the ego.
    Ego,
    /// An obstacle.
    Obstacle(ObstacleId),
    /// Kept out of the target lane until the change may start.
    LaneChangeZone,
    /// Frozen beyond the place to pull over.
    PullOverTarget,
}

/// The situation a bound is for. Its text is the original's label.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Label {
    /// So permissive that some path always exists.
    Fallback,
    /// To the edge of the road.
    PullOver,
    /// Into the neighbouring lane, for good.
    LaneChange,
    /// Along the lane, with or without using the neighbouring one.
    Regular {
        /// Which lane is borrowed.
        borrow: Borrow,
        /// Whose lane that is.
        lane: LaneType,
    },
}

/// Which neighbouring lane may be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Borrow {
    /// None.
    None,
    /// The one to the left.
    Left,
    /// The one to the right.
    Right,
}

/// Direction of the traffic in a borrowed lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LaneType {
    /// No lane is borrowed.
    Own,
    /// It goes our way.
    Forward,
    /// It comes towards us.
    Reverse,
}

impl fmt::Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (borrow, lane) = match self {
            Self::Fallback => return f.write_str("fallback"),
            Self::PullOver => return f.write_str("regular/pullover"),
            Self::LaneChange => return f.write_str("regular/lanechange"),
            Self::Regular { borrow, lane } => (borrow, lane),
        };
        let borrow = match borrow {
            Borrow::None => "self",
            Borrow::Left => "left",
            Borrow::Right => "right",
        };
        let lane = match lane {
            LaneType::Own => "",
            LaneType::Forward => "forward",
            LaneType::Reverse => "reverse",
        };
        write!(f, "regular/{borrow}/{lane}")
    }
}
