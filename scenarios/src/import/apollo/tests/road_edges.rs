//! How far the road's surface reaches beside a lane.

use super::{curve, imported, lane, named, widths};
use corridor_decider::road::LanePoint;

const LENGTH: f64 = 40.0;

/// A straight edge, along +x or against it.
fn edge(kind: &str, y: f64, along: bool) -> String {
    let ends = if along {
        [(0.0, y), (LENGTH, y)]
    } else {
        [(LENGTH, y), (0.0, y)]
    };
    format!("edge {{ type: {kind} curve {{ {} }} }} ", curve(&ends))
}

/// A road of the lanes `names` between edges.
fn road(names: &[&str], edges: &str) -> String {
    let names: Vec<String> = names
        .iter()
        .map(|name| format!("lane_id {{ id: \"{name}\" }} "))
        .collect();
    let names = names.concat();
    format!("road {{ id {{ id: \"r\" }} section {{ {names} boundary {{ outer_polygon {{ {edges} }} }} }} }}")
}

/// A lane along +x at `y`, whose road samples say no more than its half width of 1.75 m.
fn own(name: &str, y: f64, inside: &str) -> String {
    let samples = "left_road_sample { s: 0 width: 1.75 } right_road_sample { s: 0 width: 1.75 }";
    lane(
        name,
        &[(0.0, y), (LENGTH, y)],
        &format!("{} {samples} {inside}", widths(1.75, 1.75)),
    )
}

/// A lane the other way.
fn oncoming(name: &str, y: f64) -> String {
    lane(name, &[(LENGTH, y), (0.0, y)], &widths(1.75, 1.75))
}

#[track_caller]
fn assert_edges(text: &str, name: &str, left: f64, right: f64) {
    let (map, _) = imported(text);
    let lane = named(&map, name);
    assert_eq!(lane.road, "r");
    let agrees = |p: &LanePoint| (p.road_left - left).abs() < 1e-9 && (p.road_right - right).abs() < 1e-9;
    assert!(lane.points.iter().all(agrees), "{:?}", lane.points[5]);
}

#[test]
fn one_carriageway_reaches_to_its_edges() {
    let edges = edge("LEFT_BOUNDARY", 5.25, true) + &edge("RIGHT_BOUNDARY", -3.0, true);
    let text = own("a", 0.0, "") + &own("b", 3.5, "") + &road(&["b", "a"], &edges);
    assert_edges(&text, "a", 5.25, 3.0);
    assert_edges(&text, "b", 1.75, 6.5);
}

/// Two carriageways drawn as four edges, in the order in which one walks round the road.
#[test]
fn carriageways_that_touch_are_one_surface() {
    for gap in [-0.3, 0.0, 0.4] {
        let middle = 1.75 + gap;
        let edges = edge("RIGHT_BOUNDARY", -2.0, true)
            + &edge("LEFT_BOUNDARY", middle, false)
            + &edge("RIGHT_BOUNDARY", middle + 4.0, false)
            + &edge("LEFT_BOUNDARY", 1.75, true);
        let text = own("a", 0.0, "") + &oncoming("b", middle + 1.75) + &road(&["a", "b"], &edges);
        assert_edges(&text, "a", middle + 4.0, 2.0);
        assert_edges(&text, "b", middle + 1.75 + 2.0, 2.25);
    }
}

#[test]
fn a_median_divides_the_surface() {
    let edges = edge("RIGHT_BOUNDARY", -2.0, true)
        + &edge("LEFT_BOUNDARY", 4.75, false)
        + &edge("RIGHT_BOUNDARY", 8.25, false)
        + &edge("LEFT_BOUNDARY", 1.75, true);
    let text = own("a", 0.0, "") + &oncoming("b", 6.5) + &road(&["a", "b"], &edges);
    assert_edges(&text, "a", 1.75, 2.0);
    assert_edges(&text, "b", 1.75, 1.75);
}

#[test]
fn a_bike_lane_inside_the_outline_is_no_surface_for_cars() {
    let edges = edge("LEFT_BOUNDARY", 1.75, true) + &edge("RIGHT_BOUNDARY", -4.0, true);
    let bike = lane(
        "bike",
        &[(0.0, -3.0), (LENGTH, -3.0)],
        &format!("type: BIKING {}", widths(1.0, 1.0)),
    );
    let text = own("a", 0.0, "right_neighbor_forward_lane_id { id: \"bike\" }")
        + &bike
        + &road(&["a", "bike"], &edges);
    assert_edges(&text, "a", 1.75, 1.75);
}

#[test]
fn samples_count_where_the_road_has_no_edges() {
    let text = own("a", 0.0, "right_road_sample { s: 40 width: 5.75 }") + &road(&["a"], "");
    let (map, _) = imported(&text);
    let at = named(&map, "a").at(20.0);
    assert!(
        (at.road_right - 3.75).abs() < 1e-9 && (at.road_left - 1.75).abs() < 1e-9,
        "{at:?}"
    );
}
