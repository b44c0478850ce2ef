//! Small maps made by hand, in both forms.

mod both_forms;
mod hostile;
mod lanes;
mod road_edges;
mod routings;
mod topology;

use super::{read_map, to_road_map};
use corridor_decider::hd_map::MapData;
use corridor_decider::road::{Lane, RoadMap};

/// The data of a map in text form.
fn data(text: &str) -> MapData {
    read_map(text.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

/// The road map of a map in text form, and its warnings.
fn imported(text: &str) -> (RoadMap, Vec<String>) {
    to_road_map(&data(text)).unwrap_or_else(|error| panic!("{error}"))
}

fn named<'a>(map: &'a RoadMap, name: &str) -> &'a Lane {
    map.lane(map.find(name).unwrap_or_else(|| panic!("no lane `{name}`")))
}

/// `segment { line_segment { point ... } }` of a curve.
fn curve(points: &[(f64, f64)]) -> String {
    let points: Vec<String> = points
        .iter()
        .map(|(x, y)| format!("point {{ x: {x} y: {y} }} "))
        .collect();
    let points = points.concat();
    format!("segment {{ line_segment {{ {points}}} }}")
}

/// A driving lane through some points, with `inside` in its message.
fn lane(name: &str, points: &[(f64, f64)], inside: &str) -> String {
    let curve = curve(points);
    let typed = if inside.contains("type: BIKING") {
        ""
    } else {
        "type: CITY_DRIVING"
    };
    format!("lane {{ id {{ id: \"{name}\" }} central_curve {{ {curve} }} {typed} {inside} }}\n")
}

/// Samples of constant half width on both sides, 0 to 100 m.
fn widths(left: f64, right: f64) -> String {
    format!(
        "left_sample {{ s: 0 width: {left} }} left_sample {{ s: 100 width: {left} }} \
         right_sample {{ s: 0 width: {right} }}"
    )
}
