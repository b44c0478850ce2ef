//! A routing answer laid out on a map: one list of lane segments, and where on it the request wanted to pass.
//!
//! A place on the route is an index into the list. Source: the original's `PncMap::UpdateRoutingResponse` and the
//! searches beside it in `modules/map/pnc_map/pnc_map.cc`.

use super::{LaneFollowQuirks, PassageId, RouteSegments};
use crate::hd_map::{HdMap, LaneSegment, LaneWaypoint};
use crate::road::{LaneId, Neighbour, Side};
use crate::routing::{ChangeLaneType, Passage, RoutingResponse};
use std::collections::BTreeSet;

/// Why a routing answer cannot be followed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RouteError {
    /// Nothing to drive along.
    #[error("the routing response holds no road")]
    NoRoad,
    /// No start or no destination.
    #[error("the routing request needs a start and a destination, it has {0} waypoints")]
    TooFewWaypoints(usize),
    /// A waypoint that is nowhere.
    #[error("waypoint {0} of the routing request names no lane or no station")]
    UnplacedWaypoint(usize),
    /// A lane that the map does not hold.
    #[error("passage {passage} drives along lane `{lane}`, which the map does not hold")]
    UnknownLane {
        /// The passage.
        passage: PassageId,
        /// Name of the lane.
        lane: String,
    },
    /// A number that is none, or infinite.
    #[error("passage {passage} names a station on lane `{lane}` that is not finite")]
    NotFinite {
        /// The passage.
        passage: PassageId,
        /// Name of the lane.
        lane: String,
    },
}

/// One lane segment of the route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RouteEntry {
    /// The part of a lane.
    pub segment: LaneSegment,
    /// The passage it belongs to.
    pub passage: PassageId,
    /// Its place in the passage.
    pub lane: usize,
}

/// A waypoint of the request, found on the route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocatedWaypoint {
    /// Where it is.
    pub waypoint: LaneWaypoint,
    /// The entry of the route that it lies on.
    pub entry: usize,
    /// Its place in the request.
    pub request: usize,
}

/// A route that can be followed. Immutable.
#[derive(Clone, Debug)]
pub struct Route {
    response: RoutingResponse,
    entries: Vec<RouteEntry>,
    waypoints: Vec<LocatedWaypoint>,
}

impl Route {
    /// Lays `response` out on `map`.
    ///
    /// # Errors
    /// [`RouteError`] says what is wrong with the response.
    pub fn new(map: &HdMap, response: RoutingResponse, quirks: LaneFollowQuirks) -> Result<Self, RouteError> {
        if response.roads.is_empty() {
            return Err(RouteError::NoRoad);
        }
        let requested = requested(map, &response)?;
        let entries = flatten(map, &response)?;
        let waypoints = locate(&entries, &requested, quirks);
        Ok(Self {
            response,
            entries,
            waypoints,
        })
    }

    /// The routing answer it was made from.
    pub fn response(&self) -> &RoutingResponse {
        &self.response
    }

    /// All lane segments, passage by passage, road by road.
    pub fn entries(&self) -> &[RouteEntry] {
        &self.entries
    }

    /// Those waypoints of the request that lie on the route, in their order.
    pub fn waypoints(&self) -> &[LocatedWaypoint] {
        &self.waypoints
    }

    /// The first entry from `from` on that holds a place.
    pub fn find_forward(&self, from: usize, waypoint: &LaneWaypoint) -> Option<usize> {
        let entries = self.entries.get(from..)?;
        let found = entries
            .iter()
            .position(|entry| entry.segment.contains(waypoint))?;
        Some(from + found)
    }

    /// The last entry up to `from` that holds a place.
    pub fn find_backward(&self, from: usize, waypoint: &LaneWaypoint) -> Option<usize> {
        let entries = &self.entries[..(from + 1).min(self.entries.len())];
        entries.iter().rposition(|entry| entry.segment.contains(waypoint))
    }

    /// The entry that holds a place, for a car that was on entry `ego`: the same one, the next or the one before
    /// rather than one further ahead, and that rather than one further behind.
    pub fn entry_of(&self, ego: Option<usize>, waypoint: &LaneWaypoint) -> Option<usize> {
        let forward = self.find_forward(ego.unwrap_or(0), waypoint);
        let Some(ego) = ego else { return forward };
        let backward = self.find_backward(ego, waypoint);
        match (forward, backward) {
            (None, backward) => backward,
            (Some(forward), Some(backward)) if forward > ego + 1 && backward + 1 == ego => Some(backward),
            (forward, _) => forward,
        }
    }

    /// The entry to come; the last one stays.
    pub fn entry_after(&self, entry: Option<usize>) -> usize {
        let last = self.entries.len().saturating_sub(1);
        entry.map_or(0, |entry| (entry + 1).min(last))
    }

    /// The next waypoint to pass, as a place in [`Route::waypoints`], for a car `s` metres along the lane of entry
    /// `ego`, when it was `next` before. The last one stays.
    pub fn next_waypoint(&self, next: usize, ego: usize, s: f64) -> usize {
        let last = self.waypoints.len().saturating_sub(1);
        let is_passed = |at: &LocatedWaypoint| at.entry < ego || (at.entry == ego && s >= at.waypoint.s);
        let mut next = next.min(last);
        // A car that rolls back has to pass them again.
        while next > 0 && !is_passed(&self.waypoints[next]) {
            next -= 1;
        }
        while self.waypoints.get(next).is_some_and(is_passed) {
            next += 1;
        }
        next.min(last)
    }

    /// A passage of the route.
    pub fn passage(&self, id: PassageId) -> Option<&Passage> {
        self.response.roads.get(id.road)?.passages.get(id.passage)
    }

    /// The lanes of a passage, each cut to the length it has on the map; `None` for a passage without lanes.
    pub fn passage_segments(&self, map: &HdMap, id: PassageId) -> Option<RouteSegments> {
        let segments = self.passage(id)?.segments.iter().map(|segment| {
            let lane = map.find(&segment.lane)?;
            let end = segment.end_s.min(map.lane(lane).length());
            Some(LaneSegment::new(lane, segment.start_s.max(0.0), end))
        });
        let segments: Vec<LaneSegment> = segments.collect::<Option<_>>()?;
        (!segments.is_empty()).then(|| RouteSegments::from(segments))
    }

    /// Passages that a car on passage `from` can use: its own, and those it can change to when it has to. A waypoint
    /// of the request on its own passage, `next`, must be passed first.
    pub fn neighbour_passages(&self, map: &HdMap, from: PassageId, next: usize) -> Vec<PassageId> {
        let Some(passage) = self.passage(from) else {
            return Vec::new();
        };
        let mut usable = vec![from];
        let side = match passage.change_lane_type {
            ChangeLaneType::Forward => return usable,
            ChangeLaneType::Left => Side::Left,
            ChangeLaneType::Right => Side::Right,
        };
        let (false, Some(own)) = (passage.can_exit, self.passage_segments(map, from)) else {
            return usable;
        };
        if self
            .waypoints
            .get(next)
            .is_some_and(|next| own.contains(&next.waypoint))
        {
            return usable;
        }
        let kind = Neighbour { side, reverse: false };
        let lanes = own
            .segments
            .iter()
            .flat_map(|segment| map.lane(segment.lane).neighbours(kind));
        let beside: BTreeSet<LaneId> = lanes.copied().collect();
        for (passage, other) in self.response.roads[from.road].passages.iter().enumerate() {
            let mut lanes = other
                .segments
                .iter()
                .filter_map(|segment| map.find(&segment.lane));
            if passage != from.passage && lanes.any(|lane| beside.contains(&lane)) {
                usable.push(PassageId { passage, ..from });
            }
        }
        usable
    }
}

/// The waypoints of the request; `None` for one on a lane that the map does not hold.
fn requested(map: &HdMap, response: &RoutingResponse) -> Result<Vec<Option<LaneWaypoint>>, RouteError> {
    if response.waypoints.len() < 2 {
        return Err(RouteError::TooFewWaypoints(response.waypoints.len()));
    }
    let waypoints = response.waypoints.iter().enumerate();
    waypoints
        .map(|(k, waypoint)| match (&waypoint.lane, waypoint.s) {
            (Some(lane), Some(s)) if s.is_finite() => {
                Ok(map.find(lane).map(|lane| LaneWaypoint::on(lane, s)))
            }
            _ => Err(RouteError::UnplacedWaypoint(k)),
        })
        .collect()
}

fn flatten(map: &HdMap, response: &RoutingResponse) -> Result<Vec<RouteEntry>, RouteError> {
    let mut entries = Vec::new();
    for (road, parallel) in response.roads.iter().enumerate() {
        for (number, passage) in parallel.passages.iter().enumerate() {
            let id = PassageId {
                road,
                passage: number,
            };
            for (k, segment) in passage.segments.iter().enumerate() {
                let lane = segment.lane.clone();
                let Some(found) = map.find(&lane) else {
                    return Err(RouteError::UnknownLane { passage: id, lane });
                };
                if !(segment.start_s.is_finite() && segment.end_s.is_finite()) {
                    return Err(RouteError::NotFinite { passage: id, lane });
                }
                entries.push(RouteEntry {
                    segment: LaneSegment::new(found, segment.start_s, segment.end_s),
                    passage: id,
                    lane: k,
                });
            }
        }
    }
    Ok(entries)
}

/// Finds the waypoints along the route, each on or behind the entry of the one before. One that is nowhere is left
/// out; with the quirk, so is everything behind it.
fn locate(
    entries: &[RouteEntry],
    requested: &[Option<LaneWaypoint>],
    quirks: LaneFollowQuirks,
) -> Vec<LocatedWaypoint> {
    let mut located: Vec<LocatedWaypoint> = Vec::new();
    for (request, waypoint) in requested.iter().enumerate() {
        let from = located.last().map_or(0, |last| last.entry);
        let holds = |waypoint: &LaneWaypoint| {
            let entry = entries[from..]
                .iter()
                .position(|entry| entry.segment.contains(waypoint))?;
            Some((*waypoint, from + entry))
        };
        match waypoint.as_ref().and_then(holds) {
            Some((waypoint, entry)) => located.push(LocatedWaypoint {
                waypoint,
                entry,
                request,
            }),
            None if quirks.lost_waypoint_hides_later_ones => break,
            None => {}
        }
    }
    located
}
