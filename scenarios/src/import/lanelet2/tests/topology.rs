//! Directions, neighbours, successors, junctions.

use super::{Osm, lane, lines, names};
use corridor_decider::road::{Lane, Neighbour, RoadMap, Side};

/// Names of the neighbours: left, left oncoming, right, right oncoming.
fn neighbours<'a>(map: &'a RoadMap, name: &str) -> [Option<&'a str>; 4] {
    Neighbour::ALL.map(|kind| Some(map.lane(lane(map, name).neighbour(kind)?).name.as_str()))
}

fn ends(lane: &Lane) -> [(f64, f64); 2] {
    let at = |k: usize| (lane.points[k].x, lane.points[k].y);
    [at(0), at(lane.points.len() - 1)]
}

fn near(a: [(f64, f64); 2], b: [(f64, f64); 2]) -> bool {
    a.iter()
        .zip(b)
        .all(|(a, b)| (a.0 - b.0).abs() < 1e-6 && (a.1 - b.1).abs() < 1e-6)
}

#[test]
fn ways_that_run_against_each_other_make_a_lane_with_left_on_the_left() {
    let map = lines()
        .lanelet(100, 2, 3, &[])
        .lanelet(101, 3, 2, &[("subtype", "highway")])
        .read()
        .map;
    assert!(near(ends(lane(&map, "100")), [(0.0, 4.5), (40.0, 4.5)]));
    assert!(near(ends(lane(&map, "101")), [(40.0, 4.5), (0.0, 4.5)]));
    assert!(
        map.lanes()
            .iter()
            .flat_map(|lane| &lane.points)
            .all(|p| (p.left - 1.5).abs() < 1e-6)
    );
}

#[test]
fn lanes_of_both_directions_share_ways() {
    // Two lanes to the right along x, one to the left beside them.
    let file = lines()
        .lanelet(100, 3, 4, &[])
        .lanelet(101, 2, 3, &[])
        .lanelet(102, 2, 1, &[])
        .read();
    assert!(!file.left_hand_traffic);
    assert_eq!(neighbours(&file.map, "100"), [Some("101"), None, None, None]);
    assert_eq!(
        neighbours(&file.map, "101"),
        [None, Some("102"), Some("100"), None]
    );
    assert_eq!(neighbours(&file.map, "102"), [None, Some("101"), None, None]);
    let middle = lane(&file.map, "101").at(20.0);
    assert!((middle.road_left - 4.5).abs() < 1e-6 && (middle.road_right - 4.5).abs() < 1e-6);
}

#[test]
fn a_mirrored_file_has_left_hand_traffic() {
    // The same ways as bounds of the other side: all lanes run the other way.
    let file = lines()
        .lanelet(100, 4, 3, &[])
        .lanelet(101, 3, 2, &[])
        .lanelet(102, 1, 2, &[])
        .read();
    assert!(file.left_hand_traffic);
    assert_eq!(
        neighbours(&file.map, "101"),
        [Some("100"), None, None, Some("102")]
    );
    assert_eq!(neighbours(&file.map, "102"), [None, None, None, Some("101")]);
}

#[test]
fn a_lanelet_for_both_directions_is_two_lanes() {
    let file = lines()
        .lanelet(100, 2, 3, &[("one_way", "false")])
        .lanelet(101, 3, 4, &[("one_way", "yes")])
        .read();
    let (map, back) = (&file.map, lane(&file.map, "100_back"));
    assert!(near(ends(back), [(40.0, 4.5), (0.0, 4.5)]));
    assert!(
        back.points
            .iter()
            .all(|p| (p.road_left - 4.5).abs() < 1e-6 && (p.road_right - 1.5).abs() < 1e-6)
    );
    assert_eq!(neighbours(map, "100"), [None, None, Some("101"), None]);
    assert_eq!(neighbours(map, "100_back"), [None, Some("101"), None, None]);
    // A lane has one left neighbour; the way back is seen as oncoming too.
    assert_eq!(
        neighbours(map, "101"),
        [Some("100"), Some("100_back"), None, None]
    );
    assert!(!file.left_hand_traffic);
    assert!(
        file.warnings
            .iter()
            .any(|warning| warning.contains("both directions"))
    );
}

/// Lanelets 100 before a fork at x = 0, 101 straight on, 102 to the right, 103 from below into the end of 101.
fn fork() -> Osm {
    let nodes = [
        (1, -20.0, 3.0),
        (2, -20.0, 0.0),
        (3, 0.0, 3.0),
        (4, 0.0, 0.0),
        (5, 20.0, 3.0),
        (6, 20.0, 0.0),
        (7, 9.0, -9.0),
        (8, 6.0, -9.0),
        (9, 40.0, 3.0),
        (10, 40.0, 0.0),
    ];
    let osm = nodes
        .iter()
        .fold(Osm::default(), |osm, (id, x, y)| osm.node(*id, *x, *y));
    osm.lanelet(100, 20, 21, &[("intersection_area", "no")])
        .way(20, &[3, 1], &[])
        .way(21, &[2, 4], &[])
        .way(22, &[3, 5], &[])
        .way(23, &[4, 6], &[])
        .way(24, &[3, 7], &[])
        .way(25, &[8, 4], &[])
        .way(26, &[5, 9], &[])
        .way(27, &[6, 10], &[])
        .lanelet(101, 22, 23, &[("turn_direction", "straight")])
        .lanelet(
            102,
            24,
            25,
            &[("turn_direction", "right"), ("intersection_area", "77")],
        )
        .lanelet(103, 26, 27, &[])
}

#[test]
fn lanes_follow_each_other_by_their_last_nodes() {
    let map = fork().read().map;
    assert_eq!(names(&map, &lane(&map, "100").successors), ["101", "102"]);
    assert_eq!(names(&map, &lane(&map, "101").successors), ["103"]);
    assert_eq!(names(&map, &lane(&map, "103").predecessors), ["101"]);
    assert!(lane(&map, "102").successors.is_empty());
}

#[test]
fn lanelets_that_turn_are_put_together_into_junctions() {
    let map = fork().read().map;
    let name = |lane: &Lane| Some(map.junctions()[lane.junction?.0 as usize].name.clone());
    assert_eq!(name(lane(&map, "101")).as_deref(), Some("77"));
    assert_eq!(name(lane(&map, "102")).as_deref(), Some("77"));
    assert_eq!(name(lane(&map, "103")), None);
    assert_eq!(name(lane(&map, "100")), None, "`no` is no area");
    let map = lines().lanelet(5, 1, 2, &[("turn_direction", "left")]).read().map;
    assert_eq!(name_of_first(&map), "at 5");
}

fn name_of_first(map: &RoadMap) -> &str {
    &map.junctions()[0].name
}

#[test]
fn a_turn_that_is_none_is_told() {
    let told = |turn| {
        let osm = lines().node(50, 22.0, 30.0).node(51, 43.0, 30.0);
        let osm = osm.way(5, &[20, 21, 50], &[]).way(6, &[40, 42, 51], &[]);
        let file = osm.lanelet(9, 5, 6, &[("turn_direction", turn)]).read();
        file.warnings
            .iter()
            .any(|warning| warning.contains("turns the other way"))
    };
    assert!(told("right") && !told("left") && !told("straight"));
}

#[test]
fn a_shoulder_is_part_of_the_road_and_no_neighbour() {
    let map = lines()
        .lanelet(100, 2, 3, &[])
        .lanelet(101, 3, 4, &[("subtype", "road_shoulder")])
        .read()
        .map;
    let own = lane(&map, "100");
    assert_eq!(
        own.neighbour(Neighbour {
            side: Side::Right,
            reverse: false
        }),
        None
    );
    assert!((own.at(20.0).road_right - 4.5).abs() < 1e-6);
    assert!(lane(&map, "101").kind.is_stopping());
}
