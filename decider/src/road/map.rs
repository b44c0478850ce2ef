//! All lanes of a map, checked once and then only read.

use super::index::LaneIndex;
use super::lane::{Lane, LaneId, LanePoint, Neighbour};
use crate::geometry::{Vec2, angle};
use serde::{Deserialize, Serialize};

/// Largest coordinate of a map, m: beyond every projection's, and small enough to count the index's cells.
const FARTHEST: f64 = 1e8;

/// Largest distance between cross-sections and largest width, m. Real ones are half a metre and a few; a wrong number
/// in a file must not fill the index with millions of cells.
const LARGEST_STEP: f64 = 1000.0;

/// Handle of a junction inside its map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct JunctionId(pub u32);

/// A place where roads cross, merge or fork.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Junction {
    /// The name in its file.
    pub name: String,
}

/// What makes a set of lanes unusable as a map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// No lane at all, or none that a car may drive on.
    #[error("the map has no drivable lane")]
    NoDrivableLane,
    /// A lane without length, out of order or not finite.
    #[error("lane `{lane}`: {problem}")]
    Lane {
        /// Name of the lane.
        lane: String,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// Two lanes of one name.
    #[error("two lanes are called `{0}`")]
    DuplicateName(String),
}

/// Lanes, junctions and a spatial index over them. Immutable.
#[derive(Clone, Debug)]
pub struct RoadMap {
    lanes: Vec<Lane>,
    junctions: Vec<Junction>,
    index: LaneIndex,
}

impl RoadMap {
    /// Checks the lanes and builds the index. A [`LaneId`] is the lane's place in `lanes`.
    ///
    /// # Errors
    /// [`MapError`] when a lane is broken, a link leads nowhere or nothing is drivable.
    pub fn new(lanes: Vec<Lane>, junctions: Vec<Junction>) -> Result<Self, MapError> {
        if !lanes.iter().any(|lane| lane.kind.is_drivable()) {
            return Err(MapError::NoDrivableLane);
        }
        for lane in &lanes {
            check(lane, lanes.len(), junctions.len()).map_err(|problem| MapError::Lane {
                lane: lane.name.clone(),
                problem,
            })?;
        }
        let mut names: Vec<&str> = lanes.iter().map(|lane| lane.name.as_str()).collect();
        names.sort_unstable();
        if let Some(pair) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(MapError::DuplicateName(pair[0].to_owned()));
        }
        let index = LaneIndex::new(&lanes);
        Ok(Self {
            lanes,
            junctions,
            index,
        })
    }

    /// All lanes; the place of a lane is its [`LaneId`].
    pub fn lanes(&self) -> &[Lane] {
        &self.lanes
    }

    /// All junctions.
    pub fn junctions(&self) -> &[Junction] {
        &self.junctions
    }

    /// A lane by handle.
    pub fn lane(&self, id: LaneId) -> &Lane {
        &self.lanes[id.0 as usize]
    }

    /// A lane by its name in the file.
    pub fn find(&self, name: &str) -> Option<LaneId> {
        let place = self.lanes.iter().position(|lane| lane.name == name)?;
        u32::try_from(place).ok().map(LaneId)
    }

    /// The adjacent lane of one kind.
    pub fn neighbour(&self, lane: LaneId, kind: Neighbour) -> Option<LaneId> {
        self.lane(lane).neighbour(kind)
    }

    /// How far `point` is from the road surface, m; 0 on it.
    ///
    /// The surface is the union of all lanes that carry wheels (driving and stopping ones). Exact up to
    /// 32 m, which is what anything farther off counts as.
    pub fn distance_off_road(&self, point: Vec2) -> f64 {
        self.index.distance_off_road(point)
    }

    /// The drivable lanes whose surface holds `point`, by handle, each with its driving direction there.
    /// Several in a junction, none beside the lanes.
    pub fn lanes_at(&self, point: Vec2) -> Vec<(LaneId, f64)> {
        self.index.lanes_at(&self.lanes, point)
    }

    /// The nearest drivable lane within `radius` whose heading differs from `theta` by at most
    /// `tolerance`: its handle, station and lateral offset (left positive).
    pub fn nearest_lane(
        &self,
        point: Vec2,
        radius: f64,
        theta: f64,
        tolerance: f64,
    ) -> Option<(LaneId, f64, f64)> {
        let agrees = |at: &LanePoint| angle::difference(at.theta, theta).abs() <= tolerance;
        self.index.nearest_lane(&self.lanes, point, radius, agrees)
    }
}

/// Everything about one lane that must hold before anyone reads it.
fn check(lane: &Lane, lane_count: usize, junction_count: usize) -> Result<(), &'static str> {
    if lane.points.len() < 2 {
        return Err("needs at least two cross-sections");
    }
    let finite = |p: &LanePoint| {
        [
            p.s,
            p.x,
            p.y,
            p.theta,
            p.kappa,
            p.left,
            p.right,
            p.road_left,
            p.road_right,
        ]
        .iter()
        .all(|v| v.is_finite())
    };
    if !lane.points.iter().all(finite) {
        return Err("has a number that is not finite");
    }
    if lane
        .points
        .iter()
        .any(|p| p.left < 0.0 || p.right < 0.0 || p.speed_limit.is_nan())
    {
        return Err("has a negative width or a speed limit that is not a number");
    }
    if lane.points.windows(2).any(|pair| pair[1].s <= pair[0].s) {
        return Err("stations must increase");
    }
    if lane.points.iter().any(|p| p.x.abs().max(p.y.abs()) > FARTHEST) {
        return Err("lies more than 1e8 m from the origin");
    }
    let apart = |pair: &[LanePoint]| Vec2::new(pair[1].x - pair[0].x, pair[1].y - pair[0].y).norm();
    let is_wide = |p: &LanePoint| p.left.max(p.right) > LARGEST_STEP;
    if lane.points.windows(2).any(|pair| apart(pair) > LARGEST_STEP) || lane.points.iter().any(is_wide) {
        return Err("has cross-sections more than a kilometre apart or wide");
    }
    let links = lane
        .predecessors
        .iter()
        .chain(&lane.successors)
        .chain(lane.neighbours.iter().flatten());
    if links.into_iter().any(|id| id.0 as usize >= lane_count) {
        return Err("is linked to a lane that does not exist");
    }
    if lane.junction.is_some_and(|id| id.0 as usize >= junction_count) {
        return Err("belongs to a junction that does not exist");
    }
    Ok(())
}
