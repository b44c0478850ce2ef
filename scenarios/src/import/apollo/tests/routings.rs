//! Routing requests and responses.

use crate::import::apollo::{read_routing, read_routing_request};
use corridor_decider::geometry::Vec2;
use corridor_decider::routing::ChangeLaneType;

const RESPONSE: &str = r#"
header { module_name: "routing" }
road {
  passage {
    segment { id: "a" start_s: 1.5 end_s: 10 }
    segment { id: "b" end_s: 20 }
    change_lane_type: LEFT
  }
  passage { segment { id: "c" end_s: 30 } can_exit: true }
}
measurement { distance: 30 }
routing_request { waypoint { id: "a" s: 1.5 pose { x: 586392.8 y: 4140673.0 } } waypoint { pose { x: 1 y: 2 } } }
status { error_code: OK msg: "Success!" }
"#;

#[test]
fn a_response_is_roads_of_passages_of_segments() {
    let response = read_routing(RESPONSE.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    let [road] = &response.roads[..] else {
        panic!("{response:?}");
    };
    assert_eq!((road.id.as_str(), road.passages.len()), ("", 2));
    let first = &road.passages[0];
    assert_eq!(
        (first.can_exit, first.change_lane_type),
        (false, ChangeLaneType::Left)
    );
    assert_eq!(first.segments[0].lane, "a");
    assert_eq!((first.segments[0].start_s, first.segments[1].end_s), (1.5, 20.0));
    let second = &road.passages[1];
    assert_eq!(
        (second.can_exit, second.change_lane_type),
        (true, ChangeLaneType::Forward)
    );
    assert_eq!(
        response.waypoints[0].position,
        Some(Vec2::new(586_392.8, 4_140_673.0))
    );
    assert_eq!(
        (response.waypoints[1].lane.as_deref(), response.waypoints[1].s),
        (None, None)
    );
}

#[test]
fn a_request_alone_is_its_waypoints() {
    let waypoints =
        read_routing_request(b"waypoint { id: 'a' s: 3 heading: -1.5 } waypoint { pose { x: 1 y: 2 } }");
    let waypoints = waypoints.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(
        (waypoints[0].s, waypoints[0].heading, waypoints.len()),
        (Some(3.0), Some(-1.5), 2)
    );
}

/// Field 2 road { 2 passage { 1 segment { 1 "a", 2 1.0, 3 2.0 } 2 true 3 RIGHT } }.
#[test]
fn the_binary_form_is_read_by_its_numbers() {
    let mut segment = vec![0x0a, 1, b'a', 0x11];
    segment.extend(1.0_f64.to_le_bytes());
    segment.push(0x19);
    segment.extend(2.0_f64.to_le_bytes());
    let nested = |tag: u8, inside: &[u8]| [&[tag, u8::try_from(inside.len()).unwrap()], inside].concat();
    let passage = [nested(0x0a, &segment), vec![0x10, 1, 0x18, 2]].concat();
    let bytes = nested(0x12, &nested(0x12, &passage));
    let response = read_routing(&bytes).unwrap_or_else(|error| panic!("{error}"));
    let passage = &response.roads[0].passages[0];
    assert_eq!(
        (passage.can_exit, passage.change_lane_type),
        (true, ChangeLaneType::Right)
    );
    assert_eq!(
        (passage.segments[0].lane.as_str(), passage.segments[0].end_s),
        ("a", 2.0)
    );
}

#[test]
fn mistakes_are_named_with_their_place() {
    let cases = [
        (
            "end_s: 10",
            "end_s: 1",
            "5:36: routing_response.road[0].passage[0].segment[0].end_s is 1, before start_s",
        ),
        (
            "end_s: 10",
            "",
            "5:5: routing_response.road[0].passage[0].segment[0].end_s is missing; expected a number",
        ),
        (
            "change_lane_type: LEFT",
            "change_lane_type: UP",
            "7:5: `change_lane_type` is UP; expected one of FORWARD, LEFT, RIGHT",
        ),
        (
            "change_lane_type: LEFT",
            "change_lane_type: 7",
            "change_lane_type is 7; expected 0 to 2",
        ),
        (
            "segment { id: \"c\" end_s: 30 }",
            "",
            "road[0].passage[1].segment is missing",
        ),
        ("id: \"b\" ", "", "segment[1].id is missing or empty"),
        (
            "x: 1 y: 2",
            "x: nan y: 2",
            "routing_request.waypoint[1].pose.x is NaN; expected at most 1e8 m",
        ),
    ];
    for (right, wrong, expected) in cases {
        assert!(RESPONSE.contains(right), "{right}");
        let error = read_routing(RESPONSE.replacen(right, wrong, 1).as_bytes())
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{wrong}: {error}");
        assert!(
            error.starts_with(|c: char| c.is_ascii_digit()),
            "no place: {error}"
        );
    }
    let error = read_routing(b"").unwrap_err().to_string();
    assert!(
        error.contains("road is missing; expected at least one road"),
        "{error}"
    );
    assert!(
        read_routing_request(b"waypoint { s: 1 }")
            .unwrap_err()
            .to_string()
            .contains("names no place")
    );
}
