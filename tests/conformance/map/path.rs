//! Lines along lanes: their points, lanes, widths and overlaps.

use super::compare::compare;
use super::json::{path_point, point, segments, to_segments};
use super::{MapCase, SharedMap};
use corridor_decider::hd_map::{ObjectKind, Path, PathQuirks, Projection};
use corridor_decider::road::BoundaryType;
use serde::Deserialize;
use serde_json::{Value, json};

/// The raw line along lane segments of a case, as the original has it.
pub(super) fn raw(map: &SharedMap, given: &[(String, f64, f64)]) -> Result<Path, String> {
    let segments = to_segments(map, given)?;
    Path::along(map, &segments, PathQuirks::apollo()).map_err(|error| error.to_string())
}

#[derive(Deserialize)]
struct Asked {
    segments: Vec<(String, f64, f64)>,
    s: Vec<f64>,
    xy_hs_he: Vec<[f64; 4]>,
    lane_segment_ranges: Vec<[f64; 2]>,
}

pub(super) fn queries(case: &MapCase, map: &SharedMap) -> Result<(), String> {
    let asked: Asked = case.input()?;
    let path = raw(map, &asked.segments)?;
    let ranges = asked.lane_segment_ranges.iter();
    let points = path.points().iter().map(|point| path_point(map, point));
    let mut got = json!({
        "length": path.length(),
        "num_points": path.points().len(),
        "lane_segments": segments(map, path.lane_segments()),
        "path_points": points.collect::<Value>(),
        "accumulated_s": path.stations(),
        "at_s": asked.s.iter().map(|s| at_station(&path, *s)).collect::<Value>(),
        "at_xy": asked.xy_hs_he.iter().map(|at| at_point(&path, *at)).collect::<Value>(),
        "GetLaneSegments": ranges
            .map(|[start, end]| segments(map, &path.lane_segments_between(*start, *end)))
            .collect::<Value>(),
    });
    for kind in ObjectKind::ALL {
        let met = path
            .overlaps(kind)
            .iter()
            .map(|met| json!([met.object, met.start_s, met.end_s]));
        got[overlaps_of(kind)] = met.collect();
    }
    if let Some(got) = got.as_object_mut() {
        // Points are written for one of the maps only.
        got.retain(|key, _| {
            case.expected.get(key).is_some() || !["path_points", "accumulated_s"].contains(&key.as_str())
        });
    }
    compare(&case.expected, &got)
}

fn overlaps_of(kind: ObjectKind) -> String {
    format!("{}_overlaps", super::json::enumerator(kind).to_lowercase())
}

fn at_station(path: &Path, s: f64) -> Value {
    let lines = path.boundary_types_at(s);
    let (left, right) = lines.unwrap_or((BoundaryType::Unknown, BoundaryType::Unknown));
    json!({
        "index": path.locate(s),
        "point": path_point(path.map(), &path.point_at(s)),
        "lane_width": path.lane_width_at(s),
        "road_width": path.road_width_at(s),
        "lane_index": path.locate_lane(s),
        "left_boundary_type": left,
        "right_boundary_type": right,
        "next_lane_overlap_start_s": path.next_lane_overlap(s).map(|next| next.start_s),
    })
}

fn at_point(path: &Path, [x, y, start, end]: [f64; 4]) -> Value {
    let at = point([x, y]);
    let all = |at: Projection| json!([at.s, at.l, at.distance]);
    let Projection { s, l, distance } = path.project(at);
    json!({
        "ok": true,
        "s": s,
        "l": l,
        "distance": distance,
        "nearest_point_s_l_distance": all(path.nearest(at)),
        "is_on_path": path.is_on_path(at),
        "heading_along_path": path.heading_along(at),
        "heuristic_s_l_distance": all(path.project_between(at, start, end)),
    })
}
