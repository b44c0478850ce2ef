//! The Lanelet2 files: the example map of the Lanelet2 project (Karlsruhe) and a vector map of Autoware.

use crate::sound::{DRAWN, assert_sound};
use crate::support::{count, map_file, named, successors, worst_joint};
use corridor_decider::geometry::angle;
use corridor_decider::road::{BoundaryType, Lane, LaneKind, LanePoint, RoadMap, Side};
use corridor_scenarios::import::lanelet2::{self, Lanelet2Import};

/// A map that passed the general checks.
fn load(name: &str) -> Option<Lanelet2Import> {
    let file = map_file(&format!("lanelet2/{name}.osm"))?;
    let import = lanelet2::read_file(&file).unwrap_or_else(|error| panic!("{error}"));
    assert_sound(&import.map, DRAWN);
    assert_consistent(&import.map);
    Some(import)
}

/// What a map of lanelets promises beyond [`assert_sound`]: lanes that follow each other meet exactly, with one
/// curvature.
fn assert_consistent(map: &RoadMap) {
    for lane in map.lanes() {
        for next in &lane.successors {
            let (end, start) = (lane.points[lane.points.len() - 1], map.lane(*next).points[0]);
            assert!((end.x - start.x).hypot(end.y - start.y) < 1e-9, "{}", lane.name);
            let turn = angle::difference(end.theta, start.theta);
            assert!(turn.abs() < 1e-9, "{}", lane.name);
            assert!((end.kappa - start.kappa).abs() < 1e-9, "{}", lane.name);
        }
    }
}

/// Speed limit in km/h.
fn kmh(lane: &Lane) -> String {
    format!("{:.0}", lane.points[0].speed_limit * 3.6)
}

fn assert_told(warnings: &[String], what: &str, times: usize) {
    let found = warnings.iter().find(|warning| warning.contains(what));
    let told = found.unwrap_or_else(|| panic!("`{what}` is not in {warnings:?}"));
    let expected = format!("({times} of this kind in the file)");
    assert_eq!(told.contains(&expected), times > 1, "{told}");
}

/// Number of lanes of a kind, and their lengths within a share of what half the bounds sum up to.
fn assert_lanes(map: &RoadMap, kind: LaneKind, lanes: usize, length: f64, share: f64) {
    let (found, metres) = count(map, kind);
    assert_eq!(found, lanes, "{kind:?}");
    assert!(
        (metres / length - 1.0).abs() < share,
        "{kind:?}: {metres} m, not {length} m"
    );
}

#[test]
fn mapping_example_has_roads_for_both_directions() {
    let Some(Lanelet2Import {
        map,
        left_hand_traffic,
        warnings,
    }) = load("mapping_example")
    else {
        return;
    };
    // 345 roads and highways without 17 that are for bicycles and pedestrians, and 60 of them once more.
    assert_lanes(&map, LaneKind::Driving, 328 + 60, 4624.0 + 554.0, 0.01);
    assert_lanes(&map, LaneKind::Biking, 14 + 17, 714.9, 0.01);
    assert_lanes(&map, LaneKind::Sidewalk, 8 + 2, 166.0, 0.06);
    assert_lanes(&map, LaneKind::Rail, 2, 275.1, 0.01);
    assert!(!left_hand_traffic);
    assert!(map.junctions().is_empty());
    assert!(map.lanes().iter().all(|lane| kmh(lane) == "50"));
    assert_told(&warnings, "without a speed limit", 328);
    assert_told(&warnings, "both directions", 60);
    assert_told(&warnings, "an area for parking", 19);
    assert_told(&warnings, "way 44218: a deleted element", 1);
}

#[test]
fn mapping_example_is_linked_by_shared_nodes_and_ways() {
    let Some(Lanelet2Import { map, .. }) = load("mapping_example") else {
        return;
    };
    // Counted by end nodes without the importer.
    let links: usize = map.lanes().iter().map(|lane| lane.successors.len()).sum();
    assert!((385..=392).contains(&links), "{links} links");
    let (gap, turn) = worst_joint(&map);
    assert!(gap < 1e-9 && turn < 1e-9);
    // Lane and bend of real roads: what turns on less than two metres is a kink of the file.
    let driving = || map.lanes().iter().filter(|lane| lane.kind == LaneKind::Driving);
    let sharp = driving().filter(|lane| lane.points.iter().any(|p| p.kappa.abs() > 0.5));
    assert!(sharp.count() <= 2);
    // Wedges begin with no width.
    let wedges = driving().filter(|lane| lane.points[0].left + lane.points[0].right < 0.05);
    assert_eq!(wedges.count(), 3);
    let off = |lane: &&Lane| lane.points.iter().any(|p| p.left.min(p.right) < 0.3);
    assert_eq!(driving().filter(off).count(), 4, "no wedge, but off the middle");
}

/// What the smoothing costs and what it brings, on roads drawn with points metres apart.
#[test]
fn mapping_example_is_smooth_and_in_the_middle() {
    let Some(Lanelet2Import { map, .. }) = load("mapping_example") else {
        return;
    };
    let driving = || map.lanes().iter().filter(|lane| lane.kind == LaneKind::Driving);
    let off = driving()
        .flat_map(|lane| &lane.points)
        .map(|p| (p.left - p.right).abs() / 2.0);
    assert_quantiles(off.collect(), [(0.5, 0.025), (0.9, 0.2), (0.98, 0.8)]);
    let change = |p: &[LanePoint]| (p[1].kappa - p[0].kappa).abs() / (p[1].s - p[0].s);
    let changes = driving().flat_map(|lane| lane.points.windows(2)).map(change);
    assert_quantiles(changes.collect(), [(0.5, 1.2e-3), (0.9, 0.012), (0.98, 0.06)]);
}

/// Checks that shares of the values are below limits.
fn assert_quantiles(mut values: Vec<f64>, limits: [(f64, f64); 3]) {
    values.sort_by(f64::total_cmp);
    for (share, limit) in limits {
        let below = values.partition_point(|value| *value < limit);
        assert!(
            below as f64 >= share * values.len() as f64,
            "less than {share} of them below {limit}"
        );
    }
}

#[test]
fn autoware_has_shoulders_and_a_junction() {
    let Some(Lanelet2Import {
        map,
        left_hand_traffic,
        warnings,
    }) = load("autoware_vm_03_right_hand")
    else {
        return;
    };
    assert_lanes(&map, LaneKind::Driving, 55, 2033.9, 0.01);
    assert_lanes(&map, LaneKind::Biking, 6, 195.4, 0.01);
    assert_lanes(&map, LaneKind::Sidewalk, 5, 115.8, 0.1);
    assert_lanes(&map, LaneKind::Shoulder, 2, 58.6, 0.01);
    assert!(!left_hand_traffic);
    // The twin of a map with left-hand traffic kept the words for turning.
    assert_told(&warnings, "turns the other way", 8);
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    let at = |limit| map.lanes().iter().filter(|lane| kmh(lane) == limit).count();
    assert_eq!((at("60"), at("30"), at("10")), (50, 6, 12));
    assert_eq!(
        map.lanes().iter().filter(|lane| lane.junction.is_some()).count(),
        20
    );
    // Every lane is as wide as a lane, and bends as a road does.
    for lane in map.lanes().iter().filter(|lane| lane.kind == LaneKind::Driving) {
        for p in &lane.points {
            assert!(
                (2.0..5.0).contains(&(p.left + p.right)),
                "{} at {}",
                lane.name,
                p.s
            );
            assert!(
                (p.left - p.right).abs() < 0.4 && p.kappa.abs() < 0.15,
                "{} at {}",
                lane.name,
                p.s
            );
        }
    }
}

#[test]
fn autoware_shoulders_widen_the_road() {
    let Some(Lanelet2Import { map, .. }) = load("autoware_vm_03_right_hand") else {
        return;
    };
    // 2253 has a shoulder of two metres, lane 2254 and two more on its sides.
    let lane = named(&map, "2253");
    let middle = lane.at(lane.length() / 2.0);
    let beyond = (middle.road_left - middle.left, middle.road_right - middle.right);
    let (least, most) = (beyond.0.min(beyond.1), beyond.0.max(beyond.1));
    assert!((least - 2.0).abs() < 0.1 && most > 2.9, "{beyond:?}");
    // Tags let one change lanes over a solid line.
    assert_eq!(lane.mark(Side::Left, 5.0), BoundaryType::DottedWhite);
    assert_eq!(
        named(&map, "2257").mark(Side::Left, 5.0),
        BoundaryType::SolidWhite
    );
    assert!(!successors(&map, "2264").is_empty());
}

/// The file has both metres and degrees: without its metres it gives the same lanes elsewhere.
#[test]
fn autoware_in_degrees_is_as_long_as_in_metres() {
    let Some(file) = map_file("lanelet2/autoware_vm_03_right_hand.osm") else {
        return;
    };
    let text = std::fs::read_to_string(file).expect("the file is text");
    let read = |text: &str| lanelet2::read(text).expect("the file is a map").map;
    let (metres, degrees) = (read(&text), read(&text.replace("\"local_", "\"other_")));
    for (a, b) in metres.lanes().iter().zip(degrees.lanes()) {
        // The metres are those of a grid with a scale of its own.
        assert!((a.length() / b.length() - 1.0).abs() < 1e-3, "{}", a.name);
    }
    let all = |map: &RoadMap| map.lanes().iter().map(Lane::length).sum::<f64>();
    let ratio = all(&metres) / all(&degrees);
    assert!((ratio - 1.0).abs() < 3e-4, "{ratio}");
}
