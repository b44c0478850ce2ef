//! Cases of HD maps, of routes on them and of lines along them: the original's answers on three of its own maps.
//!
//! Every case is answered in the shape of what it expects, all defects of the original that Corridor can show switched
//! on, and the two are compared number by number. Where the original has no answer, or none that can be relied on,
//! Corridor's own is checked instead. That is so for
//!
//! - a route with a lane that the map does not hold, which aborts the original: an error;
//! - a route without roads, or with fewer than two placed waypoints, which the original takes and then cannot follow:
//!   an error, and no route to follow;
//! - the heading up to a millimetre beyond the end of a lane, undefined there: the last one;
//! - the part of a line whose points share no lanes, which crashes the original: a line that follows no lane;
//! - the nearest lane on the route when a nearer one runs the other way, which depends there on the order of a hash
//!   set: any of the possible ones;
//! - the nearest of lanes or pieces equally near, and which way a lane runs at a corner: any of them;
//! - the next of no waypoints, and the curvature of a lane whose heading passes π, where the original overflows and
//!   forgets to wrap: none, and the wrapped one;
//! - the nearest point between two points of a line, which the original searches coarsely: the exact one;
//! - the speed limit of a lane that names none, 0 in the original: none.

mod compare;
mod json;
mod lane;
mod line;
mod path;
mod query;
mod route;
mod segments;
mod store;

pub(crate) use store::MapStore;

use corridor_decider::hd_map::HdMap;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::sync::Arc;

/// One case.
#[derive(Deserialize)]
pub(crate) struct MapCase {
    pub(crate) name: String,
    map: String,
    function: Function,
    input: Value,
    expected: Value,
}

/// What is asked; names of the original.
#[derive(Clone, Copy, Deserialize)]
enum Function {
    LaneInfo,
    #[serde(rename = "LaneInfo.at_s")]
    LaneAtStations,
    #[serde(rename = "LaneInfo.at_xy")]
    LaneAtPoints,
    #[serde(rename = "HDMap.query")]
    Query,
    #[serde(rename = "PncMap.drive")]
    Drive,
    #[serde(rename = "PncMap.reroute")]
    Reroute,
    #[serde(rename = "PncMap.index_search")]
    IndexSearch,
    #[serde(rename = "PncMap.UpdateNextRoutingWaypointIndex")]
    NextWaypoint,
    #[serde(rename = "PncMap.GetNeighborPassages")]
    NeighbourPassages,
    #[serde(rename = "PncMap.ExtendSegments")]
    Extend,
    #[serde(rename = "PncMap.LookForwardDistance")]
    LookAhead,
    RouteSegments,
    Path,
    ReferenceLine,
}

/// Answers a case and compares.
pub(crate) fn check(case: &MapCase, store: &mut MapStore) -> Result<(), String> {
    let map = store.get(&case.map).map_err(|error| error.to_string())?;
    match case.function {
        Function::LaneInfo => lane::properties(case, &map),
        Function::LaneAtStations => lane::at_stations(case, &map),
        Function::LaneAtPoints => lane::at_points(case, &map),
        Function::Query => query::query(case, &map),
        Function::Drive => route::drive(case, &map),
        Function::Reroute => route::reroute(case, &map),
        Function::IndexSearch => route::index_search(case, &map),
        Function::NextWaypoint => route::next_waypoint(case, &map),
        Function::NeighbourPassages => route::neighbour_passages(case, &map),
        Function::Extend => route::extend(case, &map),
        Function::LookAhead => route::look_ahead(case),
        Function::RouteSegments => segments::queries(case, &map),
        Function::Path => path::queries(case, &map),
        Function::ReferenceLine => line::queries(case, &map),
    }
}

impl MapCase {
    fn input<T: DeserializeOwned>(&self) -> Result<T, String> {
        T::deserialize(&self.input).map_err(|error| format!("input: {error}"))
    }

    fn expect(&self, answer: &Value) -> Result<(), String> {
        compare::compare(&self.expected, answer)
    }
}

/// One expectation for each of `count` questions.
fn list(expected: &Value, count: usize) -> Result<&[Value], String> {
    match expected.as_array() {
        Some(list) if list.len() == count => Ok(list),
        _ => Err(format!("expected: a list of {count} answers is wanted")),
    }
}

/// A lane by name.
fn lane_id(map: &HdMap, name: &str) -> Result<corridor_decider::road::LaneId, String> {
    map.find(name)
        .ok_or_else(|| format!("the map has no lane `{name}`"))
}

type SharedMap = Arc<HdMap>;
