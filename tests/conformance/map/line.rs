//! Lines as deciders ask them: at stations, at poses, about boxes, and cut to a part.

use super::compare::{compare, compare_at};
use super::json::{name, path_point, point, segments, xy};
use super::path::raw;
use super::{MapCase, SharedMap, list};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle};
use corridor_decider::hd_map::{CartesianState, Path, PathPoint, PathQuirks};
use corridor_decider::reference_line::{LineQuery, SlPoint};
use serde::Deserialize;
use serde_json::{Value, json};

/// The original's `planning_upper_speed_limit`, m/s: it answers no higher limit.
const UPPER_SPEED_LIMIT: f64 = 31.3;

/// Error of a unit vector whose angle was rounded to 16 bit.
const ROUNDED_ANGLE: f64 = 1e-4;

/// How near an 8-bit search for a station comes, relative to that station: the original's search stops when it knows
/// twice this.
const SEARCH_TOLERANCE: f64 = 1.0 / 64.0;

#[derive(Deserialize)]
struct Asked {
    segments: Vec<(String, f64, f64)>,
    sl: Vec<[f64; 2]>,
    x_y_theta_kappa_v_a: Vec<[f64; 6]>,
    box_x_y_heading_length_width_gap: Vec<[f64; 6]>,
    segment_s_back_forward: Vec<[f64; 3]>,
}

pub(super) fn queries(case: &MapCase, map: &SharedMap) -> Result<(), String> {
    let asked: Asked = case.input()?;
    let expected = &case.expected;
    let line = raw(map, &asked.segments)?;
    compare_at(".length", &expected["length"], &json!(line.length()))?;
    for (at, expected) in asked.sl.iter().zip(list(&expected["at_sl"], asked.sl.len())?) {
        at_sl(&line, *at, expected).map_err(|mismatch| format!("{at:?}{mismatch}"))?;
    }
    for (at, expected) in asked
        .x_y_theta_kappa_v_a
        .iter()
        .zip(list(&expected["at_pose"], asked.x_y_theta_kappa_v_a.len())?)
    {
        at_pose(&line, *at, expected).map_err(|mismatch| format!("{at:?}{mismatch}"))?;
    }
    for (at, expected) in asked.box_x_y_heading_length_width_gap.iter().zip(list(
        &expected["boxes"],
        asked.box_x_y_heading_length_width_gap.len(),
    )?) {
        at_box(&line, *at, expected).map_err(|mismatch| format!("{at:?}{mismatch}"))?;
    }
    for (at, expected) in asked
        .segment_s_back_forward
        .iter()
        .zip(list(&expected["segment"], asked.segment_s_back_forward.len())?)
    {
        part(&line, *at, expected).map_err(|mismatch| format!("{at:?}{mismatch}"))?;
    }
    Ok(())
}

fn at_sl(line: &Path, [s, l]: [f64; 2], expected: &Value) -> Result<(), String> {
    let at = line.point_at(s);
    let nearest = line.nearest_point(s);
    let lanes = line
        .lanes_at(s)
        .into_iter()
        .map(|lane| json!(name(line.map(), lane)));
    let limit = line.speed_limit_at(s).unwrap_or(UPPER_SPEED_LIMIT);
    let place = SlPoint { s, l };
    let there = line.to_cartesian(s, l);
    let mut got = json!({
        "reference_point": path_point(line.map(), &at),
        "kappa": at.kappa,
        "dkappa": at.dkappa,
        "nearest_reference_point": [nearest.position.x, nearest.position.y, nearest.heading],
        "nearest_index": line.index_from(s),
        "lane_width": line.lane_width_at(s),
        "road_width": line.road_width_at(s),
        "offset_to_map": line.offset_to_map(s),
        "lanes": lanes.collect::<Value>(),
        "speed_limit": limit.min(UPPER_SPEED_LIMIT),
        "sl_to_xy": xy(there),
        "is_on_lane": line.is_on_lane(place),
        "is_on_road": line.is_on_road(place),
    });
    // A limit that a lane does not name is 0 in the original.
    let names_none = |lane| line.map().lane(lane).data().speed_limit.is_none();
    if expected["speed_limit"] == 0 && line.lanes_at(s).into_iter().any(names_none) {
        got["speed_limit"] = json!(0);
    }
    if is_near(&expected["sl_to_xy"], there, ROUNDED_ANGLE * l.abs()) {
        got["sl_to_xy"] = expected["sl_to_xy"].clone();
    }
    compare(expected, &got)
}

fn is_near(expected: &Value, got: Vec2, tolerance: f64) -> bool {
    let wanted = Vec::<f64>::deserialize(expected).unwrap_or_default();
    matches!(wanted[..], [x, y, ..] if (Vec2::new(x, y) - got).norm() <= tolerance)
}

fn at_pose(line: &Path, [x, y, theta, kappa, v, a]: [f64; 6], expected: &Value) -> Result<(), String> {
    let position = point([x, y]);
    let at = line.project(position);
    let state = line.to_frenet_state(&CartesianState {
        position,
        theta,
        kappa,
        v,
        a,
    });
    let chord = line.chord_point(position);
    let mut got = json!({
        "sl": [at.s, at.l],
        "reference_point_xy": [chord.position.x, chord.position.y, chord.heading],
        "to_frenet_s": state.s,
        "to_frenet_l": state.l,
    });
    if is_on_same_chord(line, position, &chord, &expected["reference_point_xy"]) {
        got["reference_point_xy"] = expected["reference_point_xy"].clone();
    }
    compare(expected, &got)
}

/// Whether the original's search ended on the same chord, as near to the best place as it goes.
fn is_on_same_chord(line: &Path, position: Vec2, best: &PathPoint, expected: &Value) -> bool {
    let points = line.points();
    let distance = |k: &usize| (points[*k].position - position).norm();
    let nearest = (0..points.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let nearest = nearest.unwrap_or(0);
    let last = (nearest + 1).min(points.len() - 1);
    let (from, to) = (&points[nearest.saturating_sub(1)], &points[last]);
    let [x, y, heading] = Vec::<f64>::deserialize(expected).unwrap_or_default()[..] else {
        return false;
    };
    let (found, chord) = (Vec2::new(x, y), to.position - from.position);
    let t = (found - from.position).dot(&chord) / chord.norm_squared();
    let turn = angle::difference(to.heading, from.heading);
    let reach = SEARCH_TOLERANCE * line.stations()[last];
    (found - from.position - chord * t).norm() <= 1e-6
        && angle::difference(heading, from.heading + turn * t).abs() <= 1e-7
        && (found - best.position).norm() <= reach
}

fn at_box(
    line: &Path,
    [x, y, heading, length, width, gap]: [f64; 6],
    expected: &Value,
) -> Result<(), String> {
    let pose = Pose { x, y, theta: heading };
    let body = ConvexPolygon::rectangle(pose, length / 2.0, length / 2.0, width / 2.0);
    let at = line.sl_box(&body);
    let outline = line.sl_outline(&body);
    let to_sl = |point: Vec2| {
        let at = line.project(point);
        SlPoint { s: at.s, l: at.l }
    };
    // The original begins with the front right corner, our boxes with the one before.
    let mut edges: Vec<(Vec2, Vec2)> = body.edges().collect();
    edges.rotate_left(1);
    let corners = edges.iter().map(|(corner, _)| to_sl(*corner));
    let middles = edges.iter().enumerate().map(|(k, (from, to))| {
        let middle = to_sl((from + to) * 0.5);
        let added = outline.contains(&middle);
        let open = expected["edge_midpoints"][k][2] == "either";
        let flag = if open {
            "either"
        } else if added {
            "added"
        } else {
            "not_added"
        };
        json!([middle.s, middle.l, flag])
    });
    compare(
        expected,
        &json!({
            "ok": true,
            "sl_boundary": [at.start_s, at.end_s, at.start_l, at.end_l],
            "corners": corners.map(|at| json!([at.s, at.l])).collect::<Value>(),
            "edge_midpoints": middles.collect::<Value>(),
            "is_on_lane": line.is_box_on_lane(&at),
            "is_on_road": line.is_box_on_road(&at),
            "driving_width": line.driving_width(&at),
            "is_block_road": line.is_blocked_by(&body, gap),
            "has_overlap": line.has_overlap(&body),
        }),
    )
}

/// The original's points remember one lane each once they are cut out, and where none in a row share one it crashes.
fn part(line: &Path, [s, back, forward]: [f64; 3], expected: &Value) -> Result<(), String> {
    let forgetful = line.points().iter().map(|point| PathPoint {
        waypoints: point.waypoints.first().into_iter().copied().collect(),
        ..point.clone()
    });
    let forgetful = Path::through(line.map(), forgetful.collect(), PathQuirks::apollo());
    let part = forgetful.and_then(|line| line.segment(s, back, forward));
    if expected.get("defect").is_some() {
        let is_empty = |part: Path| part.lane_segments().is_empty();
        return match part.map(is_empty) {
            Ok(true) => Ok(()),
            other => Err(format!(": expected a line without lanes, got {other:?}")),
        };
    }
    let ok = part.is_ok();
    let part = part.as_ref().unwrap_or(line);
    let (first, last) = (part.points().first(), part.points().last());
    compare(
        expected,
        &json!({
            "ok": ok,
            "length": part.length(),
            "num_points": part.points().len(),
            "first_xy": first.map(|point| xy(point.position)),
            "last_xy": last.map(|point| xy(point.position)),
            "lane_segments": segments(part.map(), part.lane_segments()),
        }),
    )
}
