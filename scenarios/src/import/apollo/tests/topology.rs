//! Links, neighbours and junctions, also where only one side names them.

use super::{imported, lane, named, widths};
use corridor_decider::road::{Neighbour, RoadMap, Side};

const LEFT_FORWARD: Neighbour = Neighbour {
    side: Side::Left,
    reverse: false,
};
const RIGHT_FORWARD: Neighbour = Neighbour {
    side: Side::Right,
    reverse: false,
};
const LEFT_REVERSE: Neighbour = Neighbour {
    side: Side::Left,
    reverse: true,
};

fn straight(name: &str, from: (f64, f64), to: (f64, f64), inside: &str) -> String {
    lane(name, &[from, to], &format!("{} {inside}", widths(1.75, 1.75)))
}

fn link(field: &str, name: &str) -> String {
    format!("{field} {{ id: \"{name}\" }} ")
}

fn neighbour<'a>(map: &'a RoadMap, name: &str, kind: Neighbour) -> Option<&'a str> {
    named(map, name)
        .neighbour(kind)
        .map(|id| map.lane(id).name.as_str())
}

fn names(map: &RoadMap, ids: &[corridor_decider::road::LaneId]) -> Vec<String> {
    ids.iter().map(|id| map.lane(*id).name.clone()).collect()
}

#[test]
fn one_side_is_enough_for_a_link() {
    let text = straight("a", (0.0, 0.0), (10.0, 0.0), &link("successor_id", "b"))
        + &straight("b", (10.0, 0.0), (20.0, 0.0), "")
        + &straight("c", (20.0, 0.0), (30.0, 0.0), &link("predecessor_id", "b"));
    let (map, warnings) = imported(&text);
    assert_eq!(names(&map, &named(&map, "b").predecessors), ["a"]);
    assert_eq!(names(&map, &named(&map, "b").successors), ["c"]);
    assert!(warnings.is_empty(), "{warnings:?}");
}

#[test]
fn links_that_the_geometry_contradicts_are_dropped_and_told() {
    let links =
        link("successor_id", "far") + &link("successor_id", "back") + &link("successor_id", "cut off");
    let text = straight("a", (0.0, 0.0), (10.0, 0.0), &links)
        + &straight("far", (11.0, 0.0), (20.0, 0.0), "")
        + &straight("back", (10.0, 0.0), (9.0, 9.0), "");
    let (map, warnings) = imported(&text);
    assert!(named(&map, "a").successors.is_empty());
    for told in [
        "link to `cut off`",
        "`a` ends 1.00 m away from the start of `far`",
        "`a` to `back`",
    ] {
        assert!(
            warnings.iter().any(|warning| warning.contains(told)),
            "{told}: {warnings:?}"
        );
    }
}

#[test]
fn neighbours_know_each_other_even_if_one_side_is_silent() {
    let text = straight(
        "a",
        (0.0, 0.0),
        (10.0, 0.0),
        &link("left_neighbor_forward_lane_id", "b"),
    ) + &straight(
        "b",
        (0.0, 3.5),
        (10.0, 3.5),
        &link("left_neighbor_reverse_lane_id", "c"),
    ) + &straight("c", (10.0, 7.0), (0.0, 7.0), "");
    let (map, warnings) = imported(&text);
    assert_eq!(neighbour(&map, "a", LEFT_FORWARD), Some("b"));
    assert_eq!(neighbour(&map, "b", RIGHT_FORWARD), Some("a"));
    assert_eq!(neighbour(&map, "b", LEFT_REVERSE), Some("c"));
    assert_eq!(neighbour(&map, "c", LEFT_REVERSE), Some("b"));
    assert!(
        warnings[0].contains("a neighbour that only one side names"),
        "{warnings:?}"
    );
}

#[test]
fn lanes_that_are_not_for_cars_are_no_neighbours() {
    let text = straight(
        "a",
        (0.0, 0.0),
        (10.0, 0.0),
        &link("right_neighbor_forward_lane_id", "bike"),
    ) + &straight("bike", (0.0, -3.0), (10.0, -3.0), "type: BIKING");
    let (map, _) = imported(&text);
    assert_eq!(neighbour(&map, "a", RIGHT_FORWARD), None);
}

/// The lane that crosses is in the junction, the one that ends in it is not.
#[test]
fn junctions_are_found_through_overlaps() {
    let part = |lane: &str, from: f64, to: f64| {
        format!(
            "overlap {{ id {{ id: \"o{lane}\" }} object {{ id {{ id: \"{lane}\" }} lane_overlap_info {{ start_s: {from} end_s: {to} }} }} \
             object {{ id {{ id: \"x\" }} junction_overlap_info {{ }} }} }}"
        )
    };
    let text = straight("a", (0.0, 0.0), (10.0, 0.0), &link("successor_id", "b"))
        + &straight("b", (10.0, 0.0), (20.0, 0.0), "")
        + "junction { id { id: \"x\" } }"
        + &part("a", 9.0, 10.0)
        + &part("b", 0.5, 10.0);
    let (map, _) = imported(&text);
    assert_eq!(map.junctions()[0].name, "x");
    assert_eq!(named(&map, "a").junction, None);
    assert_eq!(named(&map, "b").junction.map(|id| id.0), Some(0));
}

/// A straight lane goes on in the first chord of a bend: both leave the joint in the direction of the straight.
#[test]
fn lanes_that_meet_share_their_heading() {
    let text = straight("a", (-30.0, 0.0), (0.0, 0.0), &link("successor_id", "bend"))
        + &lane(
            "bend",
            &[(0.0, 0.0), (5.0, 0.9), (9.6, 2.9), (13.0, 6.5)],
            &widths(1.75, 1.75),
        );
    let (map, _) = imported(&text);
    let (a, bend) = (named(&map, "a"), named(&map, "bend"));
    assert!(a.points[a.points.len() - 1].theta.abs() < 1e-12);
    assert!(bend.points[0].theta.abs() < 1e-12);
    assert_eq!(names(&map, &a.successors), ["bend"]);
}
