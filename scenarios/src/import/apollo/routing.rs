//! Routing requests and responses, in text or binary form.
//!
//! Source: Apollo's `routing.proto`. Lane names are not held against a map here: a routing may belong to another one.

use super::convert::{LANE_CHANGES, choice, number, optional_number, point};
use super::fault::{Fault, Inside};
use super::messages;
use super::read::text;
use super::record::{Mistake, Record};
use super::text::{Parser, Value};
use crate::import::ImportError;
use corridor_decider::routing::{LaneSegment, LaneWaypoint, Passage, RoadSegment, RoutingResponse};

/// Reads a `RoutingResponse`, as a router answers.
///
/// # Errors
/// [`ImportError`] with the field, in a text with line and column, when something is missing or out of range.
pub fn read_routing(bytes: &[u8]) -> Result<RoutingResponse, ImportError> {
    decode(bytes, "routing_response", response)
}

/// Reads a `RoutingRequest`: the places where a route shall pass.
///
/// # Errors
/// As [`read_routing`].
pub fn read_routing_request(bytes: &[u8]) -> Result<Vec<LaneWaypoint>, ImportError> {
    decode(bytes, "routing_request", |message: messages::RoutingRequest| {
        waypoints(message)
    })
}

/// A file that is one message.
fn decode<M: prost::Message + Default + Value, T>(
    bytes: &[u8],
    name: &'static str,
    convert: impl Fn(M) -> Result<T, Fault>,
) -> Result<T, ImportError> {
    let record = match text(bytes)? {
        Some(text) => {
            let field = Parser::new(text).and_then(|parser| parser.whole(name));
            let field = field.map_err(|error| error.into_error(text))?;
            Record::Text { text, field }
        }
        None => Record::Wire(bytes),
    };
    let result = record.decode().and_then(|message| Ok(convert(message)?));
    result.map_err(|mistake| match mistake {
        Mistake::Error(error) => error,
        Mistake::Fault(fault) => {
            let place = record.place(fault.path());
            let fault = Err::<(), _>(fault).inside(name);
            fault.expect_err("was one before").into_error().at(place)
        }
    })
}

fn response(message: messages::RoutingResponse) -> Result<RoutingResponse, Fault> {
    if message.road.is_empty() {
        return Err(Fault::new("is missing", "at least one road of the route")).inside("road");
    }
    let road = |(nth, message)| road(message).inside_nth("road", nth);
    let request = message.routing_request.unwrap_or_default();
    Ok(RoutingResponse {
        roads: message
            .road
            .into_iter()
            .enumerate()
            .map(road)
            .collect::<Result<_, _>>()?,
        waypoints: waypoints(request).inside("routing_request")?,
    })
}

fn road(message: messages::RoadSegment) -> Result<RoadSegment, Fault> {
    if message.passage.is_empty() {
        return Err(Fault::new("is missing", "at least one passage")).inside("passage");
    }
    let passage = |(nth, message)| passage(message).inside_nth("passage", nth);
    Ok(RoadSegment {
        id: message.id.unwrap_or_default(),
        passages: message
            .passage
            .into_iter()
            .enumerate()
            .map(passage)
            .collect::<Result<_, _>>()?,
    })
}

fn passage(message: messages::Passage) -> Result<Passage, Fault> {
    if message.segment.is_empty() {
        return Err(Fault::new("is missing", "at least one stretch of a lane")).inside("segment");
    }
    let segment = |(nth, message)| segment(message).inside_nth("segment", nth);
    Ok(Passage {
        segments: message
            .segment
            .into_iter()
            .enumerate()
            .map(segment)
            .collect::<Result<_, _>>()?,
        can_exit: message.can_exit.unwrap_or(false),
        change_lane_type: choice(message.change_lane_type, &LANE_CHANGES).inside("change_lane_type")?,
    })
}

fn segment(message: messages::LaneSegment) -> Result<LaneSegment, Fault> {
    let lane = message.id.filter(|name| !name.is_empty());
    let lane = lane.ok_or_else(|| Fault::new("is missing or empty", "the name of a lane"));
    let segment = LaneSegment {
        lane: lane.inside("id")?,
        start_s: optional_number(message.start_s, "start_s")?.unwrap_or(0.0),
        end_s: number(message.end_s, "end_s")?,
    };
    if segment.end_s < segment.start_s {
        let problem = format!(
            "is {}, before start_s, which is {}",
            segment.end_s, segment.start_s
        );
        return Err(Fault::new(problem, "a station behind start_s")).inside("end_s");
    }
    Ok(segment)
}

fn waypoints(message: messages::RoutingRequest) -> Result<Vec<LaneWaypoint>, Fault> {
    let each = |(nth, message)| waypoint(message).inside_nth("waypoint", nth);
    message.waypoint.into_iter().enumerate().map(each).collect()
}

fn waypoint(message: messages::LaneWaypoint) -> Result<LaneWaypoint, Fault> {
    let waypoint = LaneWaypoint {
        lane: message.id.filter(|name| !name.is_empty()),
        s: optional_number(message.s, "s")?,
        position: message.pose.as_ref().map(point).transpose().inside("pose")?,
        heading: optional_number(message.heading, "heading")?,
    };
    if waypoint.lane.is_none() && waypoint.position.is_none() {
        return Err(Fault::new("names no place", "an `id` of a lane or a `pose`"));
    }
    Ok(waypoint)
}
