//! What a route is asked for, and why there may be none.

use crate::geometry::Vec2;
use crate::road::{LaneId, RoadMap};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// How far off every lane a place may lie, m, as in the original.
const SEARCH_RADIUS: f64 = 6.0;

/// A place on a lane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Position {
    /// Which lane.
    pub lane: LaneId,
    /// Station on it, m.
    pub s: f64,
}

/// A place that a route has to pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WayPoint {
    /// On a given lane.
    OnLane(Position),
    /// On whatever lane is there; several where lanes cross.
    At(Vec2),
}

/// What is not to be driven.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlackList {
    /// Stretches of lanes: lane, first and last station, m.
    pub lanes: Vec<(LaneId, f64, f64)>,
    /// Names of whole roads.
    pub roads: Vec<String>,
}

impl BlackList {
    /// The closed stretches of one lane.
    pub(super) fn closed(&self, lane: LaneId) -> impl Iterator<Item = (f64, f64)> + '_ {
        let of = self.lanes.iter().filter(move |(id, ..)| *id == lane);
        of.map(|(_, from, to)| (*from, *to))
    }
}

/// Why there is no route.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RoutingError {
    /// A start without a destination.
    #[error("a route needs a start and a destination; {0} way-points were given")]
    TooFewWayPoints(usize),
    /// A place away from all roads, or no number.
    #[error("way-point {0} is not within {SEARCH_RADIUS} m of a lane that cars drive on")]
    OffTheRoad(usize),
    /// A lane that does not exist or that cars do not drive on, or a station that is not on it.
    #[error("way-point {index}: {problem}")]
    NotOnLane {
        /// Which way-point, from 0.
        index: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// Roads that do not connect.
    #[error("no route from way-point {from} to way-point {to}: {why}")]
    NoRoute {
        /// Way-point that the leg starts at, from 0.
        from: usize,
        /// Way-point that it should end at.
        to: usize,
        /// How far the search came.
        why: String,
    },
}

/// The places on lanes that a way-point may mean, at least one.
pub(super) fn candidates(map: &RoadMap, index: usize, at: WayPoint) -> Result<Vec<Position>, RoutingError> {
    match at {
        WayPoint::OnLane(position) => on_lane(map, index, position).map(|position| vec![position]),
        WayPoint::At(point) => {
            let mut found: Vec<Position> = map
                .lanes_at(point)
                .into_iter()
                .map(|(lane, _)| Position {
                    lane,
                    s: map.lane(lane).station_of(point),
                })
                .collect();
            if found.is_empty() {
                let nearest = map.nearest_lane(point, SEARCH_RADIUS, 0.0, PI);
                found.extend(nearest.map(|(lane, s, _)| Position { lane, s }));
            }
            if found.is_empty() {
                return Err(RoutingError::OffTheRoad(index));
            }
            Ok(found)
        }
    }
}

fn on_lane(map: &RoadMap, index: usize, at: Position) -> Result<Position, RoutingError> {
    let wrong = |problem: String| Err(RoutingError::NotOnLane { index, problem });
    let Some(lane) = map.lanes().get(at.lane.0 as usize) else {
        return wrong(format!("the map has no lane {}", at.lane.0));
    };
    if !lane.kind.is_drivable() {
        return wrong(format!("cars do not drive on lane `{}`", lane.name));
    }
    if !(0.0..=lane.length()).contains(&at.s) {
        let (name, length) = (&lane.name, lane.length());
        return wrong(format!("{} m is not on lane `{name}` of {length:.2} m", at.s));
    }
    Ok(at)
}
