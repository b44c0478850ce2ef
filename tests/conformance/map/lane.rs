//! One lane: what the map says about it, at stations and near points.

use super::compare::compare_at;
use super::json::{enumerator, point, xy};
use super::{MapCase, SharedMap, lane_id, list};
use corridor_decider::hd_map::{BoundaryData, HdLane, ObjectKind};
use corridor_decider::road::Side;
use serde::Deserialize;
use serde_json::{Value, json};

#[derive(Deserialize)]
struct Asked {
    lane: String,
    #[serde(default)]
    s: Vec<f64>,
    #[serde(default)]
    xy: Vec<[f64; 2]>,
}

pub(super) fn properties(case: &MapCase, map: &SharedMap) -> Result<(), String> {
    let asked: Asked = case.input()?;
    let id = lane_id(map, &asked.lane)?;
    let lane = map.lane(id);
    let data = lane.data();
    let overlaps = |kind| {
        map.overlaps(id, kind)
            .map(|overlap| json!(overlap.id))
            .collect::<Value>()
    };
    let points = lane.points().iter().map(|point| xy(*point));
    let [left_forward, left_reverse, right_forward, right_reverse] = &data.neighbours;
    case.expect(&json!({
        "total_length": lane.length(),
        "proto_length": data.length,
        "num_points": lane.points().len(),
        "points": points.collect::<Value>(),
        "headings": lane.headings(),
        "accumulate_s": lane.stations(),
        "type": enumerator(data.kind),
        "turn": enumerator(data.turn),
        "direction": enumerator(data.direction),
        "speed_limit": data.speed_limit,
        "left_boundary": boundary(&data.left_boundary),
        "right_boundary": boundary(&data.right_boundary),
        "predecessors": data.predecessors,
        "successors": data.successors,
        "left_neighbor_forward": left_forward,
        "left_neighbor_reverse": left_reverse,
        "right_neighbor_forward": right_forward,
        "right_neighbor_reverse": right_reverse,
        "road_id": lane.road().unwrap_or(""),
        "section_id": lane.section().unwrap_or(""),
        "junction_id": data.junction.as_deref().unwrap_or(""),
        "cross_lanes": overlaps(ObjectKind::Lane),
        "signals": overlaps(ObjectKind::Signal),
        "yield_signs": overlaps(ObjectKind::YieldSign),
        "stop_signs": overlaps(ObjectKind::StopSign),
        "crosswalks": overlaps(ObjectKind::Crosswalk),
        "junctions": overlaps(ObjectKind::Junction),
        "clear_areas": overlaps(ObjectKind::ClearArea),
        "speed_bumps": overlaps(ObjectKind::SpeedBump),
        "parking_spaces": overlaps(ObjectKind::ParkingSpace),
        "pnc_junctions": overlaps(ObjectKind::PncJunction),
    }))
}

fn boundary(boundary: &BoundaryData) -> Value {
    let types = boundary.types.iter().map(|(s, kinds)| json!([s, kinds]));
    json!({ "virtual": boundary.is_virtual, "types": types.collect::<Value>() })
}

pub(super) fn at_stations(case: &MapCase, map: &SharedMap) -> Result<(), String> {
    let asked: Asked = case.input()?;
    let lane = map.lane(lane_id(map, &asked.lane)?);
    for (s, expected) in asked.s.iter().zip(list(&case.expected, asked.s.len())?) {
        let mut expected = expected.clone();
        if remove(&mut expected, "defect") {
            expected["heading"] = json!(lane.headings().last());
        }
        let got = at_station(lane, *s);
        if forgets_to_wrap(lane, *s, &expected["curvature"], &got["curvature"]) {
            expected["curvature"] = got["curvature"].clone();
        }
        compare_at(&format!("s = {s}"), &expected, &got)?;
    }
    Ok(())
}

/// Whether the expected curvature is a whole turn per piece off.
fn forgets_to_wrap(lane: &HdLane, s: f64, expected: &Value, got: &Value) -> bool {
    let at = lane.stations().partition_point(|station| *station < s);
    let (Some([from, to]), Some(expected), Some(got)) = (
        lane.stations().get(at.wrapping_sub(1)..=at),
        expected.as_f64(),
        got.as_f64(),
    ) else {
        return false;
    };
    let turn = std::f64::consts::TAU / (to - from + 1e-3);
    ((expected - got).abs() - turn).abs() < 1e-6
}

fn at_station(lane: &HdLane, s: f64) -> Value {
    json!({
        "smooth_point": xy(lane.point_at(s)),
        "heading": lane.heading_at(s),
        "curvature": lane.curvature_at(s),
        "width": lane.width_at(s),
        "effective_width": lane.effective_width_at(s),
        "road_width": lane.road_width_at(s),
        "left_boundary_type": lane.boundary_type_at(Side::Left, s),
        "right_boundary_type": lane.boundary_type_at(Side::Right, s),
    })
}

pub(super) fn at_points(case: &MapCase, map: &SharedMap) -> Result<(), String> {
    let asked: Asked = case.input()?;
    let lane = map.lane(lane_id(map, &asked.lane)?);
    for (asked, expected) in asked.xy.iter().zip(list(&case.expected, asked.xy.len())?) {
        let mut expected = expected.clone();
        let foot = lane.foot(point(*asked));
        if remove(&mut expected, "segment_tie") {
            expected["segment_index"] = json!(foot.piece);
        }
        let at = lane.project(point(*asked));
        let got = json!({
            "ok": true,
            "s": at.s,
            "l": at.l,
            "distance": foot.distance,
            "map_point": xy(foot.point),
            "s_offset": foot.s,
            "segment_index": foot.piece,
            "nearest_point": xy(foot.point),
            "is_on_lane": lane.contains(point(*asked)),
        });
        compare_at(&format!("{asked:?}"), &expected, &got)?;
    }
    Ok(())
}

/// Whether the expectation had a remark, which is taken off.
fn remove(expected: &mut Value, remark: &str) -> bool {
    let removed = expected
        .as_object_mut()
        .and_then(|expected| expected.remove(remark));
    removed.is_some()
}
