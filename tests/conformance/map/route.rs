//! Routes: taken, searched, extended and followed.

use super::compare::{compare, compare_at};
use super::json::{point, segments, waypoint};
use super::{MapCase, SharedMap, lane_id, list};
use corridor_decider::hd_map::{HdMap, LaneWaypoint};
use corridor_decider::lane_follow_map::{
    FollowError, LaneFollowConfig, LaneFollowMap, LaneFollowQuirks, PassageId, Route, RouteSegments,
    VehicleState,
};
use corridor_decider::routing;
use serde::Deserialize;
use serde_json::{Value, json};
use std::sync::Arc;

/// A routing answer as the cases write it.
#[derive(Clone, Deserialize)]
struct Routing {
    roads: Vec<Road>,
    waypoints: Option<Vec<(Option<String>, Option<f64>)>>,
}

#[derive(Clone, Deserialize)]
struct Road {
    id: String,
    passages: Vec<Passage>,
}

#[derive(Clone, Deserialize)]
struct Passage {
    segments: Vec<(String, f64, f64)>,
    can_exit: bool,
    change_lane_type: routing::ChangeLaneType,
}

impl From<Routing> for routing::RoutingResponse {
    fn from(given: Routing) -> Self {
        let segment = |(lane, start_s, end_s)| routing::LaneSegment { lane, start_s, end_s };
        let passage = |given: Passage| routing::Passage {
            segments: given.segments.into_iter().map(segment).collect(),
            can_exit: given.can_exit,
            change_lane_type: given.change_lane_type,
        };
        let road = |given: Road| routing::RoadSegment {
            id: given.id,
            passages: given.passages.into_iter().map(passage).collect(),
        };
        let waypoint = |(lane, s)| routing::LaneWaypoint {
            lane,
            s,
            ..routing::LaneWaypoint::default()
        };
        Self {
            roads: given.roads.into_iter().map(road).collect(),
            waypoints: given.waypoints.into_iter().flatten().map(waypoint).collect(),
        }
    }
}

/// The car in one planning cycle.
#[derive(Deserialize)]
struct State {
    xy: [f64; 2],
    heading: f64,
    speed: f64,
}

fn config() -> LaneFollowConfig {
    LaneFollowConfig {
        quirks: LaneFollowQuirks::apollo(),
        ..LaneFollowConfig::default()
    }
}

fn follower(map: &SharedMap) -> LaneFollowMap {
    LaneFollowMap::new(Arc::clone(map), config())
}

/// Whether the original takes a routing answer and can follow it.
fn is_followed(expected: &Value) -> bool {
    expected["update"] == true && expected.get("validate").is_none_or(|valid| *valid == true)
}

#[derive(Deserialize)]
struct Drive {
    routing: Routing,
    #[serde(default)]
    states: Vec<State>,
    backward_length: Option<f64>,
    forward_length: Option<f64>,
}

pub(super) fn drive(case: &MapCase, map: &SharedMap) -> Result<(), String> {
    let given: Drive = case.input()?;
    let expected = &case.expected;
    let response = routing::RoutingResponse::from(given.routing);
    let mut follow = follower(map);
    let taken = follow.update_route(response.clone());
    if taken.is_ok() != is_followed(expected) {
        return Err(format!("update: expected {}, got {taken:?}", expected["update"]));
    }
    let steps = match expected.get("steps") {
        Some(steps) => list(steps, given.states.len())?,
        None => &[],
    };
    if let Some(route) = follow.route() {
        let got = json!({
            "update": true,
            "validate": true,
            "is_new_routing_same": follow.is_new(&response),
            "route_indices": route_indices(map, route),
            "waypoint_index": waypoint_index(map, route),
            "state": state(&follow, &expected["state"]),
            "steps": expected["steps"],
        });
        compare(expected, &got)?;
    }
    for (k, (expected, at)) in steps.iter().zip(&given.states).enumerate() {
        step(
            &mut follow,
            map,
            at,
            (given.backward_length, given.forward_length),
            expected,
        )
        .map_err(|mismatch| format!("step {k}{mismatch}"))?;
    }
    Ok(())
}

fn route_indices(map: &HdMap, route: &Route) -> Value {
    let entries = route.entries().iter().map(|entry| {
        let PassageId { road, passage } = entry.passage;
        json!([segments(map, &[entry.segment])[0], [road, passage, entry.lane]])
    });
    entries.collect()
}

fn waypoint_index(map: &HdMap, route: &Route) -> Value {
    let located = route.waypoints().iter().map(|at| {
        let LaneWaypoint { lane, s, .. } = at.waypoint;
        json!([map.lane(lane).name(), s, at.entry])
    });
    located.collect()
}

/// Where the car is on the route. Of no waypoints the original counts the next one wrongly; Corridor has none.
fn state(follow: &LaneFollowMap, expected: &Value) -> Value {
    let range = follow.range();
    let no_waypoint = follow.route().is_some_and(|route| route.waypoints().is_empty());
    json!({
        "adc_route_index": follow.ego_entry().map_or(json!(-1), |entry| json!(entry)),
        "range": [range.start, range.end],
        "next_waypoint": if no_waypoint { expected["next_waypoint"].clone() } else { json!(follow.next_waypoint()) },
        "stop_for_destination": follow.stop_for_destination(),
    })
}

/// One cycle on a route, or the refusal of one without.
fn step(
    follow: &mut LaneFollowMap,
    map: &HdMap,
    at: &State,
    (back, ahead): (Option<f64>, Option<f64>),
    expected: &Value,
) -> Result<(), String> {
    let car = VehicleState {
        position: point(at.xy),
        heading: at.heading,
        speed: at.speed,
    };
    let found = match (back, ahead) {
        (Some(back), Some(ahead)) => follow.route_segments_within(&car, back, ahead),
        _ => follow.route_segments(&car),
    };
    if matches!(found, Err(FollowError::NoRoute)) {
        return compare_at(".ok", &expected["ok"], &json!(false));
    }
    let mut got = json!({
        "ok": found.is_ok(),
        "adc_waypoint": follow.ego_waypoint().map(|at| waypoint(map, at)),
        "state": state(follow, &expected["state"]),
        "route_segments": written(map, &found.unwrap_or_default()),
    });
    if let (Some(entry), Some(route)) = (follow.ego_entry(), follow.route()) {
        let passages = follow
            .neighbour_passages(route.entries()[entry].passage)
            .into_iter();
        got["neighbor_passages"] = passages.map(|id| json!(id.passage)).collect();
        got["future_waypoints"] = follow.future_waypoints().map_or(json!(-1), |count| json!(count));
    }
    let mut expected = expected.clone();
    if let Some(lanes) = expected
        .as_object_mut()
        .and_then(|step| step.remove("order_dependent"))
    {
        let is_among = |lanes: &Vec<Value>| lanes.contains(&got["adc_waypoint"][0]);
        if lanes.as_array().is_some_and(is_among) && got["adc_waypoint"][0] != expected["adc_waypoint"][0] {
            return Ok(());
        }
    }
    compare(&expected, &got)
}

fn written(map: &HdMap, found: &[RouteSegments]) -> Value {
    let one = |found: &RouteSegments| {
        let end = found.route_end_waypoint;
        json!({
            "id": found.passage.to_string(),
            "segments": segments(map, &found.segments),
            "can_exit": found.can_exit,
            "is_on_segment": found.is_on_segment,
            // Of a neighbour only navigation mode speaks, which Corridor has not.
            "is_neighbor": false,
            "next_action": found.next_action,
            "previous_action": found.previous_action,
            "stop_for_destination": found.stop_for_destination,
            "route_end_waypoint": end.map(|end| json!([map.lane(end.lane).name(), end.s])),
        })
    };
    found.iter().map(one).collect()
}

/// A new route, or a cycle on the one there is.
#[derive(Deserialize)]
#[serde(untagged)]
enum Event {
    Update { update: Routing },
    Step(State),
}

pub(super) fn reroute(case: &MapCase, map: &SharedMap) -> Result<(), String> {
    #[derive(Deserialize)]
    struct Asked {
        events: Vec<Event>,
    }
    let mut follow = follower(map);
    // A refused answer is not kept here, so the next one is new; the original may compare with it.
    let mut is_comparable = true;
    let asked: Asked = case.input()?;
    for (k, event) in asked.events.into_iter().enumerate() {
        let expected = &case.expected[k];
        let outcome = match event {
            Event::Step(at) => step(&mut follow, map, &at, (None, None), expected),
            Event::Update { update } => {
                let outcome = take(&mut follow, update.into(), expected, is_comparable);
                is_comparable = follow.route().is_some();
                outcome
            }
        };
        outcome.map_err(|mismatch| format!("event {k}{mismatch}"))?;
    }
    Ok(())
}

/// Takes a routing answer, or refuses it: the steps behind tell whether the original could follow it.
fn take(
    follow: &mut LaneFollowMap,
    response: routing::RoutingResponse,
    expected: &Value,
    is_comparable: bool,
) -> Result<(), String> {
    let is_new = follow.is_new(&response);
    if is_comparable {
        compare_at(".is_new_routing", &expected["is_new_routing"], &json!(is_new))?;
    }
    if follow.update_route(response).is_err() {
        return Ok(());
    }
    let got = json!({
        "is_new_routing": expected["is_new_routing"],
        "update": true,
        "state": state(follow, &expected["state"]),
        "num_route_indices": follow.route().map_or(0, |route| route.entries().len()),
    });
    compare(expected, &got)
}

pub(super) fn index_search(case: &MapCase, map: &SharedMap) -> Result<(), String> {
    #[derive(Deserialize)]
    struct Query {
        lane: String,
        s: f64,
        start: i64,
    }
    let (route, queries): (Route, Vec<Query>) = on_route(case, map, "queries")?;
    let answer = |query: &Query| {
        let at = LaneWaypoint::on(lane_id(map, &query.lane)?, query.s);
        let start = usize::try_from(query.start).ok();
        // Where nothing is found the original answers the end of its list, or where it began beyond that.
        let end = route.entries().len().max(start.unwrap_or(0));
        let backward = start.and_then(|start| route.find_backward(start, &at));
        let written = |entry: Option<usize>| entry.map_or(json!(-1), |entry| json!(entry));
        Ok(json!({
            "forward": route.find_forward(start.unwrap_or(0), &at).unwrap_or(end),
            "backward": written(backward),
            "waypoint_index": written(route.entry_of(start, &at)),
            "next": route.entry_after(start),
        }))
    };
    let answers: Result<Value, String> = queries.iter().map(answer).collect();
    case.expect(&answers?)
}

pub(super) fn next_waypoint(case: &MapCase, map: &SharedMap) -> Result<(), String> {
    #[derive(Deserialize)]
    struct Query {
        cur_index: i64,
        next_before: usize,
        adc_s: f64,
    }
    let (route, queries): (Route, Vec<Query>) = on_route(case, map, "queries")?;
    let answer = |query: &Query| match usize::try_from(query.cur_index) {
        Ok(entry) => json!(route.next_waypoint(query.next_before, entry, query.adc_s)),
        // A car that is nowhere on the route has passed nothing; Corridor does not ask.
        Err(_) => json!(0),
    };
    case.expect(&queries.iter().map(answer).collect())
}

pub(super) fn neighbour_passages(case: &MapCase, map: &SharedMap) -> Result<(), String> {
    let (route, queries): (Route, Vec<(usize, usize, usize)>) =
        on_route(case, map, "next_waypoint_road_passage")?;
    let answer = |(next, road, passage): &(usize, usize, usize)| {
        let from = PassageId {
            road: *road,
            passage: *passage,
        };
        let usable = route.neighbour_passages(map, from, *next).into_iter();
        usable.map(|id| json!(id.passage)).collect::<Value>()
    };
    case.expect(&queries.iter().map(answer).collect())
}

pub(super) fn extend(case: &MapCase, map: &SharedMap) -> Result<(), String> {
    #[derive(Deserialize)]
    struct Query {
        road_passage: [usize; 2],
        range_from_index: i64,
        start_s: f64,
        end_s: f64,
    }
    let (route, queries): (Route, Vec<Query>) = on_route(case, map, "queries")?;
    let mut follow = follower(map);
    follow
        .update_route(route.response().clone())
        .map_err(|error| error.to_string())?;
    let mut answers = Vec::new();
    for query in queries {
        let [road, passage] = query.road_passage;
        follow.update_range(usize::try_from(query.range_from_index).unwrap_or(0));
        let given = route.passage_segments(map, PassageId { road, passage });
        let given = given.ok_or_else(|| format!("passage {road}_{passage} has no lanes"))?;
        let extended = follow.extend(&given, query.start_s, query.end_s);
        let lanes = extended.as_ref().map_or(&[][..], |extended| &extended.segments);
        answers.push(json!({ "ok": extended.is_some(), "segments": segments(map, lanes) }));
    }
    case.expect(&answers.into())
}

pub(super) fn look_ahead(case: &MapCase) -> Result<(), String> {
    #[derive(Deserialize)]
    struct Asked {
        speed: f64,
    }
    let Asked { speed } = case.input()?;
    case.expect(&json!(config().look_ahead(speed)))
}

/// The route of a case, and what is asked of it.
fn on_route<Q: serde::de::DeserializeOwned>(
    case: &MapCase,
    map: &HdMap,
    queries: &str,
) -> Result<(Route, Vec<Q>), String> {
    let of_input = |error: serde_json::Error| format!("input: {error}");
    let given = Routing::deserialize(&case.input["routing"]).map_err(of_input)?;
    let queries = Vec::<Q>::deserialize(&case.input[queries]).map_err(of_input)?;
    let route = Route::new(map, given.into(), LaneFollowQuirks::apollo());
    Ok((route.map_err(|error| error.to_string())?, queries))
}
