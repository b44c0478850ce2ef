//! The road of a family: the lanes that the file names, those straight on, or those that the router finds.

use crate::error::{Place, ScenarioError};
use crate::route::{self, Road};
use crate::schema::ScenarioFile;
use crate::schema::task::{RoutePlace, Task};
use corridor_decider::road::{LaneId, RoadMap};
use corridor_decider::routing::{BlackList, LaneGraph, Position, RoutingConfig, WayPoint};
use std::sync::Arc;
use toml::Spanned;

/// Length of route beyond the ego's first lane, m, where a run is too short to ask for more.
const LEAST_ROUTE: f64 = 400.0;

/// Longest route, m: what an ego can drive in a minute at 180 km/h. Longer runs end with the route.
const LONGEST_ROUTE: f64 = 3000.0;

/// Length of route beyond what cruising reaches, m: what one plans ahead.
const PLANNED_AHEAD: f64 = 150.0;

/// Length of the route that a file asks for, m.
pub(super) fn length(file: &ScenarioFile) -> f64 {
    if let Some(length) = file.route_length {
        return length.min(LONGEST_ROUTE);
    }
    let longest_run = file.cruise_speed.upper_end() * file.timeout.upper_end() + PLANNED_AHEAD;
    longest_run.clamp(LEAST_ROUTE, LONGEST_ROUTE)
}

/// Finds the route and the lines along and beside it.
pub(super) fn road(
    file: &ScenarioFile,
    map: &Arc<RoadMap>,
    place: &dyn Fn(&Spanned<String>) -> Place,
) -> Result<Road, ScenarioError> {
    let length = length(file);
    if let Some(destination) = &file.destination {
        return routed(file, destination, map, place, length);
    }
    let route = if file.route.is_empty() {
        let start = match &file.ego.lane {
            Some(name) => find(map, name, place)?,
            None => route::first_lane(map).ok_or_else(|| ScenarioError::Route {
                place: Box::new(place(&file.map)),
                problem: "the map has no drivable lane outside junctions: name one as `lane` in `[ego]`"
                    .to_owned(),
            })?,
        };
        route::straight_on(map, start, length)
    } else {
        named_route(file, map, place)?
    };
    let side = match file.command.task {
        Task::ChangeLane(side) => Some(side),
        _ => None,
    };
    Road::new(Arc::clone(map), route, side, length).map_err(|error| ScenarioError::Route {
        place: Box::new(place(
            file.route.first().or(file.ego.lane.as_ref()).unwrap_or(&file.map),
        )),
        problem: error.to_string(),
    })
}

/// The road that the router finds from the ego's lane to the destination.
fn routed(
    file: &ScenarioFile,
    destination: &RoutePlace,
    map: &Arc<RoadMap>,
    place: &dyn Fn(&Spanned<String>) -> Place,
    reach: f64,
) -> Result<Road, ScenarioError> {
    let error = |at: &Spanned<String>, problem: String| ScenarioError::Route {
        place: Box::new(place(at)),
        problem,
    };
    let Some(start) = &file.ego.lane else {
        let problem = "a route needs to know where it begins: name the `lane` in `[ego]`";
        return Err(error(&destination.lane, problem.to_owned()));
    };
    let mut way_points = vec![WayPoint::OnLane(Position {
        lane: find(map, start, place)?,
        s: 0.0,
    })];
    for at in file.via.iter().chain([destination]) {
        let lane = find(map, &at.lane, place)?;
        let s = at.s.unwrap_or(map.lane(lane).length());
        way_points.push(WayPoint::OnLane(Position { lane, s }));
    }
    let graph = LaneGraph::new(map, RoutingConfig::default());
    let response = graph
        .route(map, &way_points, &BlackList::default())
        .map_err(|problem| error(&destination.lane, problem.to_string()))?;
    Road::routed(Arc::clone(map), response, reach).map_err(|problem| error(&destination.lane, problem))
}

/// The lanes that the file names, checked to follow each other.
fn named_route(
    file: &ScenarioFile,
    map: &RoadMap,
    place: &dyn Fn(&Spanned<String>) -> Place,
) -> Result<Vec<LaneId>, ScenarioError> {
    let mut route: Vec<LaneId> = Vec::new();
    for name in &file.route {
        let lane = find(map, name, place)?;
        if let Some(last) = route
            .last()
            .map(|id| map.lane(*id))
            .filter(|last| !last.successors.contains(&lane))
        {
            let next: Vec<&str> = last
                .successors
                .iter()
                .map(|id| map.lane(*id).name.as_str())
                .collect();
            return Err(ScenarioError::Route {
                place: Box::new(place(name)),
                problem: format!(
                    "lane `{}` does not follow `{}`: expected {}",
                    name.get_ref(),
                    last.name,
                    list(&next)
                ),
            });
        }
        route.push(lane);
    }
    match &file.ego.lane {
        Some(lane) if file.route.first().map(Spanned::get_ref) != Some(lane.get_ref()) => {
            Err(ScenarioError::Route {
                place: Box::new(place(lane)),
                problem: format!("the route does not start in the ego's lane `{}`", lane.get_ref()),
            })
        }
        _ => Ok(route),
    }
}

fn find(
    map: &RoadMap,
    name: &Spanned<String>,
    place: &dyn Fn(&Spanned<String>) -> Place,
) -> Result<LaneId, ScenarioError> {
    let error = |problem| ScenarioError::Route {
        place: Box::new(place(name)),
        problem,
    };
    let found = map.find(name.get_ref()).ok_or_else(|| {
        let lanes = map.lanes().iter().filter(|lane| lane.kind.is_drivable());
        let names: Vec<&str> = lanes.map(|lane| lane.name.as_str()).collect();
        error(format!(
            "the map has no lane `{}`: expected {}",
            name.get_ref(),
            list(&names)
        ))
    })?;
    if !map.lane(found).kind.is_drivable() {
        return Err(error(format!("lane `{}` is not for driving", name.get_ref())));
    }
    Ok(found)
}

/// Names for a message: the first dozen.
fn list(names: &[&str]) -> String {
    const SHOWN: usize = 12;
    if names.is_empty() {
        return "nothing, the map ends there".to_owned();
    }
    let shown: Vec<String> = names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect();
    let more = names.len().saturating_sub(SHOWN);
    let tail = if more > 0 {
        format!(" and {more} more")
    } else {
        String::new()
    };
    format!("{}{tail}", shown.join(", "))
}
