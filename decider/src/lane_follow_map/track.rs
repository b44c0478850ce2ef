//! The car on its route: where it is now, and the lanes that it can use.
//!
//! World frame, metres, radians. Source: the original's `PncMap::UpdateVehicleState` and `PncMap::GetRouteSegments`.

use super::extend::Extension;
use super::segments::RouteProjection;
use super::{LaneFollowConfig, PassageId, Route, RouteError, RouteSegments};
use crate::geometry::{Vec2, angle};
use crate::hd_map::{HdMap, LaneWaypoint};
use crate::road::LaneId;
use crate::routing::{ChangeLaneType, RoutingResponse};
use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;
use std::ops::Range;
use std::sync::Arc;

/// How far beyond an end of a lane a car still is beside it, m.
const END_TOLERANCE: f64 = 0.5;

/// Why there are no lanes to follow.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FollowError {
    /// No routing answer was taken.
    #[error("there is no route to follow")]
    NoRoute,
    /// A state with a number that is none, or infinite.
    #[error("the state of the car holds a number that is not finite")]
    NotFinite,
    /// No lane of the route around the last known place runs beside the car.
    #[error("the car at ({x:.1}, {y:.1}) is beside no lane of the route")]
    OffRoute {
        /// World position, m.
        x: f64,
        /// World position, m.
        y: f64,
    },
    /// The car is on a lane of the route, but not on the part that the route drives.
    #[error("the route does not use lane `{lane}` at {s:.1} m, where the car is")]
    OffSegment {
        /// Name of the lane.
        lane: String,
        /// Station on it, m.
        s: f64,
    },
    /// Nowhere to go.
    #[error("no waypoint of the request lies on the route")]
    NoWaypoint,
    /// A window without length.
    #[error("from {back} m behind the car to {ahead} m ahead there is no stretch to drive")]
    NoStretch {
        /// How far behind the car, m.
        back: f64,
        /// How far ahead of the car, m.
        ahead: f64,
    },
    /// No passage of the route runs beside the car.
    #[error("no passage of the route can be used from where the car is")]
    NoPassage,
}

/// What following a route takes from the state of the car.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VehicleState {
    /// World position of the rear axle's centre, m.
    pub position: Vec2,
    /// Heading, rad.
    pub heading: f64,
    /// Speed along the heading, m/s.
    pub speed: f64,
}

/// A route on a map, and the car on it.
#[derive(Clone, Debug)]
pub struct LaneFollowMap {
    map: Arc<HdMap>,
    config: LaneFollowConfig,
    route: Option<Route>,
    ego: EgoOnRoute,
}

/// What is known about the car.
#[derive(Clone, Debug, Default)]
struct EgoOnRoute {
    /// Where it was last, m.
    position: Option<Vec2>,
    /// The same on the route.
    waypoint: Option<LaneWaypoint>,
    /// The entry of the route that this lies on.
    entry: Option<usize>,
    /// The next waypoint to pass, as a place in [`Route::waypoints`].
    next_waypoint: usize,
    stop_for_destination: bool,
    /// Entries around the car, and their lanes: where it is looked for next.
    range: Range<usize>,
    range_lanes: BTreeSet<LaneId>,
}

impl LaneFollowMap {
    /// Follows no route yet.
    pub fn new(map: Arc<HdMap>, config: LaneFollowConfig) -> Self {
        Self {
            map,
            config,
            route: None,
            ego: EgoOnRoute::default(),
        }
    }

    /// The same map and route, followed with other knobs from the start.
    ///
    /// # Errors
    /// [`RouteError`] when the route cannot be followed with them.
    pub fn with_config(self, config: LaneFollowConfig) -> Result<Self, RouteError> {
        let mut changed = Self::new(self.map, config);
        if let Some(route) = self.route {
            changed.update_route(route.response().clone())?;
        }
        Ok(changed)
    }

    /// The route, if there is one.
    pub fn route(&self) -> Option<&Route> {
        self.route.as_ref()
    }

    /// Where the car is on the route.
    pub fn ego_waypoint(&self) -> Option<LaneWaypoint> {
        self.ego.waypoint
    }

    /// The entry of the route that the car is on.
    pub fn ego_entry(&self) -> Option<usize> {
        self.ego.entry
    }

    /// The next waypoint to pass, as a place in [`Route::waypoints`].
    pub fn next_waypoint(&self) -> usize {
        self.ego.next_waypoint
    }

    /// Whether the next waypoint to pass is the destination.
    pub fn stop_for_destination(&self) -> bool {
        self.ego.stop_for_destination
    }

    /// The entries of the route around the car.
    pub fn range(&self) -> Range<usize> {
        self.ego.range.clone()
    }

    /// Whether `response` differs from the one that is followed.
    pub fn is_new(&self, response: &RoutingResponse) -> bool {
        self.route
            .as_ref()
            .is_none_or(|route| route.response() != response)
    }

    /// Takes a routing answer. A wrong one leaves no route, so that nobody drives on along one that was given up.
    ///
    /// # Errors
    /// [`RouteError`] says what is wrong with it.
    pub fn update_route(&mut self, response: RoutingResponse) -> Result<(), RouteError> {
        self.route = None;
        self.ego = EgoOnRoute::default();
        self.route = Some(Route::new(&self.map, response, self.config.quirks)?);
        self.update_range(0);
        Ok(())
    }

    /// Finds the car on the route, and which waypoint it has to pass next.
    ///
    /// # Errors
    /// [`FollowError`] when there is no route, or the car is not on it.
    pub fn update_vehicle(&mut self, state: &VehicleState) -> Result<(), FollowError> {
        let Some(route) = &self.route else {
            return Err(FollowError::NoRoute);
        };
        if ![state.position.x, state.position.y, state.heading, state.speed]
            .iter()
            .all(|v| v.is_finite())
        {
            return Err(FollowError::NotFinite);
        }
        let before = self.ego.position.replace(state.position);
        let jumped = before.is_none_or(|at| (at - state.position).norm() > self.config.jump_distance);
        if jumped {
            self.ego.next_waypoint = 0;
            self.ego.entry = None;
            self.ego.stop_for_destination = false;
        }
        self.ego.waypoint = self.nearest_waypoint(state);
        let waypoint = self.ego.waypoint.ok_or(FollowError::OffRoute {
            x: state.position.x,
            y: state.position.y,
        })?;
        let entry = route.entry_of(self.ego.entry, &waypoint);
        let entry = entry.ok_or_else(|| FollowError::OffSegment {
            lane: self.map.lane(waypoint.lane).name().to_owned(),
            s: waypoint.s,
        })?;
        self.ego.next_waypoint = route.next_waypoint(self.ego.next_waypoint, entry, waypoint.s);
        self.ego.entry = Some(entry);
        let waypoints = route.waypoints().len();
        self.update_range(entry);
        if waypoints == 0 {
            return Err(FollowError::NoWaypoint);
        }
        let stays = self.config.quirks.destination_stays_next && self.ego.stop_for_destination;
        self.ego.stop_for_destination = stays || self.ego.next_waypoint + 1 == waypoints;
        Ok(())
    }

    /// Sets the range around an entry: from the one before it to the end, or to where a lane comes again.
    pub fn update_range(&mut self, entry: usize) {
        let start = entry.saturating_sub(1);
        let entries = self.route.as_ref().map_or(&[][..], Route::entries);
        self.ego.range_lanes.clear();
        let new = entries
            .iter()
            .skip(start)
            .take_while(|at| self.ego.range_lanes.insert(at.segment.lane));
        let count = new.count();
        self.ego.range = start..start + count;
    }

    /// The place on the lanes of the range that is nearest to the car, on one that runs the car's way if there is any.
    pub fn nearest_waypoint(&self, state: &VehicleState) -> Option<LaneWaypoint> {
        let beside = self.ego.range_lanes.iter().filter_map(|id| {
            let lane = self.map.lane(*id);
            let at = lane.project(state.position);
            let beyond = (at.s - lane.length()).max(-at.s).max(0.0);
            let turn = angle::difference(lane.heading_at(at.s), state.heading).abs();
            let waypoint = LaneWaypoint {
                lane: *id,
                s: at.s,
                l: at.l,
            };
            (beyond <= END_TOLERANCE).then_some((turn >= FRAC_PI_2, at.l.abs() + beyond, waypoint))
        });
        let nearest = beside.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        nearest.map(|(.., waypoint)| waypoint)
    }

    /// How many waypoints of the request are still to pass; `None` where the car is not known to be on the route.
    pub fn future_waypoints(&self) -> Option<usize> {
        self.ego.entry?;
        let route = self.route.as_ref()?;
        let next = route.waypoints().get(self.ego.next_waypoint)?;
        Some(route.response().waypoints.len() - next.request)
    }

    /// Passages that the car can use from passage `from`: that one, and those it can change to when it has to.
    pub fn neighbour_passages(&self, from: PassageId) -> Vec<PassageId> {
        let usable = |route: &Route| route.neighbour_passages(&self.map, from, self.ego.next_waypoint);
        self.route.as_ref().map(usable).unwrap_or_default()
    }

    /// The part of the way along `segments` from `start_s` to `end_s`, lengthened along the route where that is
    /// needed; a negative station lies before them. `None` for no segments, no stretch and no route.
    pub fn extend(&self, segments: &RouteSegments, start_s: f64, end_s: f64) -> Option<RouteSegments> {
        let extension = Extension {
            map: &self.map,
            route: self.route.as_ref()?,
            range: &self.ego.range_lanes,
            quirks: self.config.quirks,
        };
        extension.extend(segments, start_s, end_s)
    }

    /// The lanes to drive along, as far as a car at this speed looks; its own first, then those to change to.
    ///
    /// # Errors
    /// [`FollowError`] when there is no route, or the car is not on it.
    pub fn route_segments(&mut self, state: &VehicleState) -> Result<Vec<RouteSegments>, FollowError> {
        let ahead = self.config.look_ahead(state.speed);
        self.route_segments_within(state, self.config.look_back, ahead)
    }

    /// The lanes to drive along from `back` metres behind the car to `ahead` metres ahead of it.
    ///
    /// # Errors
    /// [`FollowError`] when there is no route, the car is not on it, or the window has no length.
    pub fn route_segments_within(
        &mut self,
        state: &VehicleState,
        back: f64,
        ahead: f64,
    ) -> Result<Vec<RouteSegments>, FollowError> {
        self.update_vehicle(state)?;
        let (Some(route), Some(entry)) = (&self.route, self.ego.entry) else {
            return Err(FollowError::NoRoute);
        };
        let own = route.entries()[entry].passage;
        let mut found = Vec::new();
        for passage in self.neighbour_passages(own) {
            if let Some((segments, at)) = self.beside_car(route, passage, own, state.position) {
                let extended = self.extend(&segments, at.s - back, at.s + ahead);
                let extended = extended.ok_or(FollowError::NoStretch { back, ahead })?;
                found.push(self.with_properties(route, extended, &segments, (passage, own), at));
            }
        }
        if found.is_empty() {
            return Err(FollowError::NoPassage);
        }
        Ok(found)
    }

    /// A passage, and where on it the car is; `None` for one that the car cannot get on.
    fn beside_car(
        &self,
        route: &Route,
        passage: PassageId,
        own: PassageId,
        position: Vec2,
    ) -> Option<(RouteSegments, RouteProjection)> {
        let segments = route.passage_segments(&self.map, passage)?;
        let ego = self.ego.waypoint?;
        let point = if passage == own {
            self.map.lane(ego.lane).point_at(ego.s)
        } else {
            position
        };
        let at = segments.project(&self.map, point)?;
        let usable = passage == own || segments.can_drive_from(&self.map, &ego);
        usable.then_some((segments, at))
    }

    /// What the route says about a passage, written on its lengthened segments.
    fn with_properties(
        &self,
        route: &Route,
        extended: RouteSegments,
        segments: &RouteSegments,
        (id, own): (PassageId, PassageId),
        at: RouteProjection,
    ) -> RouteSegments {
        let passage = route.passage(id);
        let end = segments.last_waypoint().filter(|end| extended.contains(end));
        RouteSegments {
            passage: id,
            can_exit: passage.is_some_and(|passage| passage.can_exit),
            is_on_segment: id == own,
            next_action: passage.map_or(ChangeLaneType::Forward, |passage| passage.change_lane_type),
            previous_action: match id == own {
                true => ChangeLaneType::Forward,
                false if at.l > 0.0 => ChangeLaneType::Right,
                false => ChangeLaneType::Left,
            },
            stop_for_destination: self.ego.stop_for_destination,
            route_end_waypoint: end,
            car: Some(at.waypoint),
            ..extended
        }
    }
}
