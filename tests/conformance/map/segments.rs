//! Route segments by themselves.

use super::json::{point, segments, to_segments, waypoint};
use super::{MapCase, SharedMap, lane_id};
use corridor_decider::hd_map::LaneWaypoint;
use corridor_decider::lane_follow_map::RouteSegments;
use serde::Deserialize;
use serde_json::{Value, json};

#[derive(Deserialize)]
struct Asked {
    segments: Vec<(String, f64, f64)>,
    xy: Vec<[f64; 2]>,
    s: Vec<f64>,
    waypoints: Vec<(String, f64)>,
    shrink_s_back_forward: Vec<[f64; 3]>,
    other: Vec<(String, f64, f64)>,
}

pub(super) fn queries(case: &MapCase, map: &SharedMap) -> Result<(), String> {
    let asked: Asked = case.input()?;
    let route = RouteSegments::from(to_segments(map, &asked.segments)?);
    let other = RouteSegments::from(to_segments(map, &asked.other)?);
    let project = |xy: &[f64; 2]| match route.project(map, point(*xy)) {
        Some(at) => json!({ "ok": true, "s": at.s, "l": at.l, "waypoint": waypoint(map, at.waypoint) }),
        None => json!({ "ok": false }),
    };
    let place = |s: &f64| json!(route.waypoint_at(*s).map(|at| waypoint(map, at)));
    let drive = |(lane, s): &(String, f64)| {
        let at = LaneWaypoint::on(lane_id(map, lane)?, *s);
        Ok(json!({ "on_segment": route.contains(&at), "can_drive_from": route.can_drive_from(map, &at) }))
    };
    let drives: Result<Value, String> = asked.waypoints.iter().map(drive).collect();
    let shrink = |[s, back, forward]: &[f64; 3]| {
        let mut shrunk = route.clone();
        let ok = shrunk.shrink(*s, *back, *forward);
        json!({ "ok": ok, "segments": segments(map, &shrunk.segments) })
    };
    let mut stitched = route.clone();
    let stitch = stitched.stitch(&other);
    case.expect(&json!({
        "length": route.length(),
        "GetProjection": asked.xy.iter().map(project).collect::<Value>(),
        "GetWaypoint": asked.s.iter().map(place).collect::<Value>(),
        "waypoint_queries": drives?,
        "Shrink": asked.shrink_s_back_forward.iter().map(shrink).collect::<Value>(),
        "is_connected_other": route.is_connected(&other),
        "stitch_other": stitch,
        "stitched": segments(map, &stitched.segments),
    }))
}
