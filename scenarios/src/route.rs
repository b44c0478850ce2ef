//! The lanes to follow, and the lines along them and beside them.

use crate::import::opendrive::{MapObject, ObjectKind};
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::hd_map::HdMap;
use corridor_decider::reference_line::{LineError, LineProvider, LineQuery, ReferenceLine};
use corridor_decider::road::{LaneId, Neighbour, RoadMap, Side};
use corridor_decider::routing::RoutingResponse;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Largest gap between a lane and its successor that a line bridges, m; that of the reference line.
const JOIN_TOLERANCE: f64 = 0.5;

/// How far beyond its destination a route is known, m: what is planned ahead.
const BEYOND_DESTINATION: f64 = 150.0;

/// How far beside the line the map's objects are looked for, m: the far side of a motorway.
const OBJECTS_BESIDE: f64 = 30.0;

/// The road of a family: what all its seeds share.
#[derive(Debug)]
pub(crate) struct Road {
    pub(crate) map: Arc<RoadMap>,
    pub(crate) route: Vec<LaneId>,
    pub(crate) line: Arc<ReferenceLine>,
    pub(crate) target_line: Option<Arc<ReferenceLine>>,
    pub(crate) provider: Option<LineProvider>,
    /// Station of the destination on the line, m.
    pub(crate) goal_s: Option<f64>,
    /// What the map puts on its lanes.
    pub(crate) objects: Vec<MapObject>,
    /// Length that other lines should have, m.
    reach: f64,
    /// Lines of oncoming traffic, by their first lane; made when first asked for.
    others: Mutex<BTreeMap<LaneId, Arc<ReferenceLine>>>,
}

impl Road {
    /// The road along `route`, with the line to change to on `side`.
    ///
    /// # Errors
    /// [`LineError`] when two lanes of the route do not meet.
    pub(crate) fn new(
        map: Arc<RoadMap>,
        route: Vec<LaneId>,
        side: Option<Side>,
        reach: f64,
    ) -> Result<Self, LineError> {
        let line = Arc::new(ReferenceLine::along(&map, &route)?);
        let target_line = match side.and_then(|side| beside(&map, &route, side)) {
            Some(lanes) => Some(Arc::new(ReferenceLine::along(&map, &lanes)?)),
            None => None,
        };
        Ok(Self {
            map,
            route,
            line,
            target_line,
            provider: None,
            goal_s: None,
            objects: Vec::new(),
            reach,
            others: Mutex::new(BTreeMap::new()),
        })
    }

    /// The road along a router's answer.
    ///
    /// # Errors
    /// What is wrong with the answer or the map.
    pub(crate) fn routed(map: Arc<RoadMap>, response: RoutingResponse, reach: f64) -> Result<Self, String> {
        let (line, goal_s) =
            ReferenceLine::through(&map, &response, BEYOND_DESTINATION).map_err(|error| error.to_string())?;
        let hd_map = HdMap::of_roads(&map).map_err(|error| error.to_string())?;
        let lanes = response.roads.iter().filter_map(|road| road.passages.last());
        let route = lanes.flat_map(|passage| &passage.segments);
        let route = route.filter_map(|segment| map.find(&segment.lane)).collect();
        let provider = LineProvider::new(Arc::clone(&map), Arc::new(hd_map), response)
            .map_err(|error| error.to_string())?;
        Ok(Self {
            route,
            map,
            line: Arc::new(line),
            target_line: None,
            provider: Some(provider),
            goal_s: Some(goal_s),
            objects: Vec::new(),
            reach,
            others: Mutex::new(BTreeMap::new()),
        })
    }

    /// The road with those of the map's objects that stand on it, if they are `wanted`.
    pub(crate) fn with_objects(self, wanted: bool, all: &[MapObject]) -> Self {
        if !wanted {
            return self;
        }
        let objects = all.iter().filter(|object| self.is_obstructed_by(object));
        let objects = objects.cloned().collect();
        Self { objects, ..self }
    }

    /// Whether an object stands on a lane for cars, beside the line.
    fn is_obstructed_by(&self, object: &MapObject) -> bool {
        let corners = object.outline.vertices();
        let middle = corners.iter().sum::<Vec2>() / (corners.len() as f64);
        let edges = object.outline.edges().map(|(a, b)| (a + b) / 2.0);
        let mut points = corners.iter().copied().chain(edges).chain([middle]);
        let at = self.line.to_frenet(middle);
        let is_beside =
            at.s >= self.line.start() && at.s <= self.line.length() && at.l.abs() < OBJECTS_BESIDE;
        let is_solid = !object.kind.is_flat() && object.kind != ObjectKind::Gantry;
        is_solid && is_beside && points.any(|point| !self.map.lanes_at(point).is_empty())
    }

    /// The line straight on from `lane`.
    pub(crate) fn line_from(&self, lane: LaneId) -> Option<Arc<ReferenceLine>> {
        let mut others = self.others.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(line) = others.get(&lane) {
            return Some(Arc::clone(line));
        }
        let lanes = straight_on(&self.map, lane, self.reach);
        let line = Arc::new(ReferenceLine::along(&self.map, &lanes).ok()?);
        others.insert(lane, Arc::clone(&line));
        Some(line)
    }
}

/// The lane an ego starts in when the file names none: the first drivable one outside junctions.
pub(crate) fn first_lane(map: &RoadMap) -> Option<LaneId> {
    (0u32..)
        .zip(map.lanes())
        .find(|(_, lane)| lane.kind.is_drivable() && lane.junction.is_none())
        .map(|(k, _)| LaneId(k))
}

/// Lanes from `start` on until they reach `length` metres beyond it or the map ends: in a fork the one that
/// turns least. No lane comes twice.
pub(crate) fn straight_on(map: &RoadMap, start: LaneId, length: f64) -> Vec<LaneId> {
    let mut lanes = vec![start];
    let (mut last, mut reached) = (start, 0.0);
    while reached < length {
        let next = map
            .lane(last)
            .successors
            .iter()
            .copied()
            .filter(|next| {
                !lanes.contains(next) && map.lane(*next).kind.is_drivable() && joins(map, last, *next)
            })
            .min_by(|a, b| turn(map, last, *a).total_cmp(&turn(map, last, *b)).then(a.cmp(b)));
        let Some(next) = next else { break };
        reached += map.lane(next).length();
        lanes.push(next);
        last = next;
    }
    lanes
}

/// How far `next` leads away from the direction in which `lane` ends, rad.
fn turn(map: &RoadMap, lane: LaneId, next: LaneId) -> f64 {
    match (map.lane(lane).points.last(), map.lane(next).points.last()) {
        (Some(end), Some(exit)) => angle::difference(exit.theta, end.theta).abs(),
        _ => f64::MAX,
    }
}

/// Whether `next` starts where `lane` ends.
pub(crate) fn joins(map: &RoadMap, lane: LaneId, next: LaneId) -> bool {
    match (map.lane(lane).points.last(), map.lane(next).points.first()) {
        (Some(end), Some(start)) => (start.offset(0.0) - end.offset(0.0)).norm() <= JOIN_TOLERANCE,
        _ => false,
    }
}

/// The lanes beside a route, on `side`, in its direction: from its first lane's neighbour on. Where the route's
/// next lane has a neighbour that goes on from here, that one; otherwise straight on. `None` without a neighbour.
fn beside(map: &RoadMap, route: &[LaneId], side: Side) -> Option<Vec<LaneId>> {
    let kind = Neighbour { side, reverse: false };
    let mut lanes = vec![map.neighbour(*route.first()?, kind)?];
    for along in &route[1..] {
        let last = *lanes.last()?;
        let linked = map
            .neighbour(*along, kind)
            .filter(|next| map.lane(last).successors.contains(next) && joins(map, last, *next));
        let Some(next) = linked.or_else(|| straight_on(map, last, f64::MIN_POSITIVE).get(1).copied()) else {
            break;
        };
        if lanes.contains(&next) {
            break;
        }
        lanes.push(next);
    }
    Some(lanes)
}
