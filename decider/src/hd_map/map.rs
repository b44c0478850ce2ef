//! An HD map: its lanes by handle and by name, linked with each other and with what lies on them.
//!
//! Metres, radians, world frame. Immutable once built. Source: the original's
//! `modules/map/hdmap/hdmap_impl.cc`, class `HDMapImpl`.

use super::ObjectKind;
use super::aabb_tree::{Aabb, AabbTree};
use super::data::{LaneData, MapData, Overlap, RoadData};
use super::lane::{HdLane, Links};
use super::shape::Layer;
use crate::geometry::Vec2;
use crate::road::LaneId;
use std::collections::{BTreeMap, BTreeSet};

/// Why map data make no map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HdMapError {
    /// Nothing to drive on.
    #[error("the map holds no lane")]
    NoLane,
    /// Two lanes of the same name.
    #[error("lane `{0}` is there twice")]
    DuplicateLane(String),
    /// A lane without length.
    #[error("lane `{0}` needs two points apart from each other")]
    TooShort(String),
    /// A number that is none, or infinite.
    #[error("{what} of `{object}` hold a number that is not finite")]
    NotFinite {
        /// The object.
        object: String,
        /// Which of its numbers.
        what: &'static str,
    },
    /// A table whose stations do not increase.
    #[error("{what} of lane `{lane}` are not sorted by station")]
    Unsorted {
        /// The lane.
        lane: String,
        /// Which of its tables.
        what: &'static str,
    },
    /// A road with a lane that is not there.
    #[error("section `{section}` of road `{road}` names lane `{lane}`, which the map does not hold")]
    UnknownLane {
        /// The road.
        road: String,
        /// Its section.
        section: String,
        /// The lane it names.
        lane: String,
    },
}

/// A map as the original's planning sees it.
#[derive(Clone, Debug)]
pub struct HdMap {
    lanes: Vec<HdLane>,
    by_name: BTreeMap<String, LaneId>,
    overlaps: Vec<Overlap>,
    roads: Vec<RoadData>,
    pub(super) layers: [Layer; ObjectKind::COUNT],
    /// Every piece of every centre line, and the lane it belongs to.
    pub(super) pieces: Vec<(LaneId, usize)>,
    pub(super) pieces_tree: AabbTree,
}

impl HdMap {
    /// Checks and links `data`. Links to lanes and overlaps that the data do not hold are left out: a map may be cut
    /// from a larger one.
    ///
    /// # Errors
    /// [`HdMapError`] names the object that is wrong and how.
    pub fn new(data: MapData) -> Result<Self, HdMapError> {
        if data.lanes.is_empty() {
            return Err(HdMapError::NoLane);
        }
        check_objects(&data)?;
        let mut by_name = BTreeMap::new();
        for (number, lane) in (0..).zip(&data.lanes) {
            check_lane(lane)?;
            if by_name.insert(lane.id.clone(), LaneId(number)).is_some() {
                return Err(HdMapError::DuplicateLane(lane.id.clone()));
            }
        }
        let linker = Linker::new(&data, &by_name)?;
        let mut lanes = Vec::with_capacity(data.lanes.len());
        for lane in &data.lanes {
            let short = || HdMapError::TooShort(lane.id.clone());
            let mut made = HdLane::new(lane.clone()).ok_or_else(short)?;
            if !made.length().is_finite() {
                return Err(not_finite(&lane.id, "points"));
            }
            made.links = linker.links(lane);
            lanes.push(made);
        }
        let (pieces, pieces_tree) = index_pieces(&lanes);
        Ok(Self {
            lanes,
            by_name,
            layers: layers(&data),
            overlaps: data.overlaps,
            roads: data.roads,
            pieces,
            pieces_tree,
        })
    }

    /// All lanes; a lane's handle is its place here.
    pub fn lanes(&self) -> &[HdLane] {
        &self.lanes
    }

    /// The lane of a handle of this map.
    ///
    /// # Panics
    /// With a handle of another map.
    pub fn lane(&self, id: LaneId) -> &HdLane {
        &self.lanes[id.0 as usize]
    }

    /// The handle of a lane by name.
    pub fn find(&self, name: &str) -> Option<LaneId> {
        self.by_name.get(name).copied()
    }

    /// All roads, in file order.
    pub fn roads(&self) -> &[RoadData] {
        &self.roads
    }

    /// The overlaps of `lane` with objects of one kind, in the lane's order.
    pub fn overlaps(&self, lane: LaneId, kind: ObjectKind) -> impl Iterator<Item = &Overlap> {
        let places = &self.lane(lane).links.overlaps[kind.index()];
        places.iter().map(|place| &self.overlaps[*place])
    }
}

/// Names of everything a lane can be linked with.
struct Linker<'a> {
    lanes: &'a BTreeMap<String, LaneId>,
    overlaps: BTreeMap<&'a str, (usize, &'a Overlap)>,
    objects: BTreeSet<(ObjectKind, &'a str)>,
    roads: BTreeMap<&'a str, (&'a str, &'a str)>,
}

impl<'a> Linker<'a> {
    fn new(data: &'a MapData, lanes: &'a BTreeMap<String, LaneId>) -> Result<Self, HdMapError> {
        let mut roads = BTreeMap::new();
        for road in &data.roads {
            for section in &road.sections {
                for lane in &section.lanes {
                    if !lanes.contains_key(lane) {
                        return Err(HdMapError::UnknownLane {
                            road: road.id.clone(),
                            section: section.id.clone(),
                            lane: lane.clone(),
                        });
                    }
                    roads.insert(lane.as_str(), (road.id.as_str(), section.id.as_str()));
                }
            }
        }
        let numbered = data.overlaps.iter().enumerate();
        Ok(Self {
            lanes,
            overlaps: numbered
                .map(|(k, overlap)| (overlap.id.as_str(), (k, overlap)))
                .collect(),
            objects: objects(data).collect(),
            roads,
        })
    }

    fn links(&self, lane: &LaneData) -> Links {
        let resolve = |names: &[String]| -> Vec<LaneId> {
            names
                .iter()
                .filter_map(|name| self.lanes.get(name).copied())
                .collect()
        };
        Links {
            predecessors: resolve(&lane.predecessors),
            successors: resolve(&lane.successors),
            neighbours: lane.neighbours.each_ref().map(|names| resolve(names)),
            overlaps: self.overlaps(lane),
            road: self
                .roads
                .get(lane.id.as_str())
                .map(|(road, section)| ((*road).to_owned(), (*section).to_owned())),
        }
    }

    /// Overlaps by what the other object is: the map knows it by name, whatever the overlap itself says.
    fn overlaps(&self, lane: &LaneData) -> [Vec<usize>; ObjectKind::COUNT] {
        let mut by_kind: [Vec<usize>; ObjectKind::COUNT] = Default::default();
        for name in &lane.overlaps {
            let Some((place, overlap)) = self.overlaps.get(name.as_str()) else {
                continue;
            };
            for object in overlap.objects.iter().filter(|object| object.id != lane.id) {
                for kind in ObjectKind::ALL {
                    if self.objects.contains(&(kind, object.id.as_str())) {
                        by_kind[kind.index()].push(*place);
                    }
                }
            }
        }
        by_kind
    }
}

/// Kind and name of every object of the map.
fn objects(data: &MapData) -> impl Iterator<Item = (ObjectKind, &str)> {
    let areas = [
        (ObjectKind::Junction, &data.junctions),
        (ObjectKind::PncJunction, &data.pnc_junctions),
        (ObjectKind::Crosswalk, &data.crosswalks),
        (ObjectKind::ClearArea, &data.clear_areas),
        (ObjectKind::ParkingSpace, &data.parking_spaces),
    ];
    let lines = [
        (ObjectKind::Signal, &data.signals),
        (ObjectKind::StopSign, &data.stop_signs),
        (ObjectKind::YieldSign, &data.yield_signs),
        (ObjectKind::SpeedBump, &data.speed_bumps),
    ];
    let lanes = data.lanes.iter().map(|lane| (ObjectKind::Lane, lane.id.as_str()));
    let areas = areas
        .into_iter()
        .flat_map(|(kind, list)| list.iter().map(move |area| (kind, area.id.as_str())));
    let lines = lines
        .into_iter()
        .flat_map(|(kind, list)| list.iter().map(move |sign| (kind, sign.id.as_str())));
    lanes.chain(areas).chain(lines)
}

fn layers(data: &MapData) -> [Layer; ObjectKind::COUNT] {
    ObjectKind::ALL.map(|kind| match kind {
        // Lanes are found by the pieces of their centre lines.
        ObjectKind::Lane => Layer::default(),
        ObjectKind::Junction => Layer::of_areas(&data.junctions),
        ObjectKind::PncJunction => Layer::of_areas(&data.pnc_junctions),
        ObjectKind::Crosswalk => Layer::of_areas(&data.crosswalks),
        ObjectKind::ClearArea => Layer::of_areas(&data.clear_areas),
        ObjectKind::ParkingSpace => Layer::of_areas(&data.parking_spaces),
        ObjectKind::Signal => Layer::of_lines(&data.signals),
        ObjectKind::StopSign => Layer::of_lines(&data.stop_signs),
        ObjectKind::YieldSign => Layer::of_lines(&data.yield_signs),
        ObjectKind::SpeedBump => Layer::of_lines(&data.speed_bumps),
    })
}

fn index_pieces(lanes: &[HdLane]) -> (Vec<(LaneId, usize)>, AabbTree) {
    let mut pieces = Vec::new();
    let mut boxes = Vec::new();
    for (number, lane) in (0..).zip(lanes) {
        for (k, pair) in lane.points().windows(2).enumerate() {
            pieces.push((LaneId(number), k));
            boxes.extend(Aabb::around([pair[0], pair[1]]));
        }
    }
    let tree = AabbTree::new(&boxes);
    (pieces, tree)
}

fn finite(points: &[Vec2]) -> bool {
    points.iter().all(|p| p.x.is_finite() && p.y.is_finite())
}

fn not_finite(object: &str, what: &'static str) -> HdMapError {
    HdMapError::NotFinite {
        object: object.to_owned(),
        what,
    }
}

fn check_lane(lane: &LaneData) -> Result<(), HdMapError> {
    if !finite(&lane.points) {
        return Err(not_finite(&lane.id, "points"));
    }
    let tables = [
        ("left widths", &lane.left_samples),
        ("right widths", &lane.right_samples),
        ("left road widths", &lane.left_road_samples),
        ("right road widths", &lane.right_road_samples),
    ];
    for (what, table) in tables {
        if !table.iter().all(|(s, width)| s.is_finite() && width.is_finite()) {
            return Err(not_finite(&lane.id, what));
        }
        if !table.is_sorted_by(|a, b| a.0 <= b.0) {
            let lane = lane.id.clone();
            return Err(HdMapError::Unsorted { lane, what });
        }
    }
    Ok(())
}

fn check_objects(data: &MapData) -> Result<(), HdMapError> {
    let areas = [
        &data.junctions,
        &data.pnc_junctions,
        &data.crosswalks,
        &data.clear_areas,
        &data.parking_spaces,
    ];
    let lines = [
        &data.signals,
        &data.stop_signs,
        &data.yield_signs,
        &data.speed_bumps,
    ];
    let areas = areas
        .into_iter()
        .flatten()
        .map(|area| (&area.id, finite(&area.polygon)));
    let lines = lines
        .into_iter()
        .flatten()
        .map(|sign| (&sign.id, sign.lines.iter().all(|line| finite(line))));
    match areas.chain(lines).find(|(_, finite)| !finite) {
        Some((object, _)) => Err(not_finite(object, "points")),
        None => Ok(()),
    }
}
