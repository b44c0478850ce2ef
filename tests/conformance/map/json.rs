//! Corridor's types in the shape in which the cases write them.

use corridor_decider::geometry::Vec2;
use corridor_decider::hd_map::{HdMap, LaneSegment, LaneWaypoint, PathPoint};
use corridor_decider::road::LaneId;
use serde_json::{Value, json};

/// `[x, y]`.
pub(super) fn xy(point: Vec2) -> Value {
    json!([point.x, point.y])
}

pub(super) fn point([x, y]: [f64; 2]) -> Vec2 {
    Vec2::new(x, y)
}

pub(super) fn name(map: &HdMap, lane: LaneId) -> &str {
    map.lane(lane).name()
}

pub(super) fn names(map: &HdMap, lanes: &[LaneId]) -> Value {
    sorted(lanes.iter().map(|lane| name(map, *lane)).collect())
}

/// Names in the order in which the cases list what the original keeps in hash sets.
pub(super) fn sorted(mut names: Vec<&str>) -> Value {
    names.sort_unstable();
    json!(names)
}

/// `[lane, start_s, end_s]`.
pub(super) fn segments(map: &HdMap, segments: &[LaneSegment]) -> Value {
    let written = segments
        .iter()
        .map(|segment| json!([name(map, segment.lane), segment.start_s, segment.end_s]));
    written.collect()
}

/// `[lane, s, l]`.
pub(super) fn waypoint(map: &HdMap, waypoint: LaneWaypoint) -> Value {
    json!([name(map, waypoint.lane), waypoint.s, waypoint.l])
}

/// A point of a line, as `{xy, heading, lane_waypoints}`.
pub(super) fn path_point(map: &HdMap, point: &PathPoint) -> Value {
    let waypoints = point.waypoints.iter().map(|at| waypoint(map, *at));
    json!({
        "xy": xy(point.position),
        "heading": point.heading,
        "lane_waypoints": waypoints.collect::<Value>(),
    })
}

/// The original's name of one of its enumerators: `CityDriving` is `CITY_DRIVING`.
pub(super) fn enumerator(value: impl std::fmt::Debug) -> String {
    let mut written = String::new();
    for letter in format!("{value:?}").chars() {
        if letter.is_uppercase() && !written.is_empty() {
            written.push('_');
        }
        written.extend(letter.to_uppercase());
    }
    written
}

/// Lane segments of a case, by handle.
pub(super) fn to_segments(map: &HdMap, given: &[(String, f64, f64)]) -> Result<Vec<LaneSegment>, String> {
    let segments = given.iter().map(|(lane, start_s, end_s)| {
        let lane = super::lane_id(map, lane)?;
        Ok(LaneSegment::new(lane, *start_s, *end_s))
    });
    segments.collect()
}
