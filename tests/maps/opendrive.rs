//! The `OpenDRIVE` files: esmini's test roads, an ASAM example, and CARLA's Town07.

use crate::sound::{GIVEN, assert_sound};
use crate::support::{count, first, line, map_file, named, sections, successors, width, worst_joint};
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::reference_line::LineQuery;
use corridor_decider::road::{BoundaryType, LaneKind, Neighbour, RoadMap, Side};
use corridor_scenarios::import::opendrive::{self, ObjectKind, OpenDriveImport};
use std::collections::BTreeSet;

const LEFT_FORWARD: Neighbour = Neighbour {
    side: Side::Left,
    reverse: false,
};
const LEFT_REVERSE: Neighbour = Neighbour {
    side: Side::Left,
    reverse: true,
};
const RIGHT_FORWARD: Neighbour = Neighbour {
    side: Side::Right,
    reverse: false,
};

/// A map that passed the general checks, and its warnings.
fn load(name: &str) -> Option<(RoadMap, Vec<String>)> {
    let import = import(name)?;
    assert_sound(&import.map, GIVEN);
    Some((import.map, import.warnings))
}

fn import(name: &str) -> Option<OpenDriveImport> {
    let file = map_file(&format!("opendrive/{name}.xodr"))?;
    Some(opendrive::read_file(&file).unwrap_or_else(|error| panic!("{error}")))
}

/// How many elements and how many copies of a kind there are.
fn objects(import: &OpenDriveImport, kind: ObjectKind) -> (usize, usize) {
    let of_kind = || import.objects.iter().filter(|object| object.kind == kind);
    let names: BTreeSet<&str> = of_kind().map(|object| object.name.as_str()).collect();
    (names.len(), of_kind().count())
}

fn assert_near(is: f64, expected: f64, tolerance: f64) {
    assert!(
        (is - expected).abs() <= tolerance,
        "{is} is not {expected} ± {tolerance}"
    );
}

#[test]
fn straight_500m_has_narrow_shoulders() {
    let Some((map, warnings)) = load("straight_500m") else {
        return;
    };
    assert_eq!((map.lanes().len(), sections(&map)), (6, 1));
    for (kind, metres) in [
        (LaneKind::Driving, 3.07),
        (LaneKind::Shoulder, 1.68),
        (LaneKind::Border, 6.0),
    ] {
        let (lanes, length) = count(&map, kind);
        assert_eq!(lanes, 2);
        assert_near(length, 1000.0, 1e-6);
        let lane = first(&map, kind);
        assert_near(width(lane, 250.0), metres, 1e-9);
    }
    let ego = named(&map, "1_0_-1");
    let at = ego.at(250.0);
    assert_near(at.road_right, 3.07 / 2.0 + 1.68, 1e-9);
    assert_near(at.road_left, 3.07 * 1.5 + 1.68, 1e-9);
    assert_eq!(ego.mark(Side::Left, 250.0), BoundaryType::DottedWhite);
    assert_eq!(ego.mark(Side::Right, 250.0), BoundaryType::SolidWhite);
    assert_eq!(ego.neighbour(LEFT_REVERSE), map.find("1_0_1"));
    assert!(at.speed_limit.is_infinite() && warnings.iter().any(|w| w.contains("without a speed limit")));
}

#[test]
fn e6mini_is_a_motorway_with_a_median() {
    let Some((map, _)) = load("e6mini") else { return };
    let (driving, length) = count(&map, LaneKind::Driving);
    assert_eq!(
        (
            driving,
            count(&map, LaneKind::Stop).0,
            count(&map, LaneKind::Border).0
        ),
        (6, 2, 6)
    );
    assert_near(length, 8800.0, 50.0);
    // Lanes at equal distance to both sides of the reference line are on average as long as it.
    let (a, b) = (named(&map, "0_0_2"), named(&map, "0_0_-2"));
    assert_near(0.5 * (a.length() + b.length()), 1464.0, 1.0);
    for (name, metres) in [
        ("0_0_-2", 3.65),
        ("0_0_-3", 3.5),
        ("0_0_-4", 3.9),
        ("0_0_-5", 2.85),
    ] {
        assert_near(width(named(&map, name), 700.0), metres, 1e-9);
    }
    assert!(
        map.lanes()
            .iter()
            .all(|lane| lane.neighbour(LEFT_REVERSE).is_none()),
        "a median lies between"
    );
    assert_eq!(b.neighbour(RIGHT_FORWARD), map.find("0_0_-3"));
    assert!(b.neighbour(LEFT_FORWARD).is_none());
    let right = named(&map, "0_0_-4");
    assert_near(right.at(700.0).road_right, 3.9 / 2.0 + 2.85, 1e-9);
    assert_near(right.at(700.0).road_left, 3.9 / 2.0 + 3.5 + 3.65, 1e-9);
    assert_eq!(
        right.mark(Side::Left, 700.0),
        BoundaryType::DottedWhite,
        "whatever laneChange says"
    );
    assert_eq!(right.mark(Side::Right, 700.0), BoundaryType::SolidWhite);
}

#[test]
fn curves_bends_both_ways() {
    let Some((map, _)) = load("curves") else { return };
    let (ego, oncoming) = (named(&map, "1_0_-1"), named(&map, "1_0_1"));
    assert_eq!(count(&map, LaneKind::Driving).0, 2);
    assert_near(0.5 * (ego.length() + oncoming.length()), 1154.0, 1.0);
    assert_near(width(ego, 500.0), 3.07, 1e-9);
    // Radii of the reference line are 100 to 200 m; the lane's centre lies 1.535 m beside it.
    let low = ego.points.iter().map(|p| p.kappa).fold(0.0, f64::min);
    let high = ego.points.iter().map(|p| p.kappa).fold(0.0, f64::max);
    for sharpest in [-1.0 / low, 1.0 / high] {
        assert!(sharpest > 98.0 && sharpest < 202.0, "radius {sharpest}");
    }
    let line = line(&map, &["1_0_-1"]);
    for pair in line.samples().windows(2) {
        let turn = angle::difference(pair[1].point.theta, pair[0].point.theta);
        assert!(turn.abs() < 0.6 / 95.0, "a kink of {turn} at {}", pair[0].s);
    }
}

#[test]
fn fabriksgatan_leads_through_its_crossing() {
    let Some((map, warnings)) = load("fabriksgatan") else {
        return;
    };
    assert_eq!((map.junctions().len(), sections(&map)), (1, 16));
    let (driving, length) = count(&map, LaneKind::Driving);
    assert_eq!(driving, 4 * 2 + 12);
    assert_near(length, 1200.0, 50.0);
    let inside = map
        .lanes()
        .iter()
        .filter(|lane| lane.kind.is_drivable() && lane.junction.is_some());
    for lane in inside.clone() {
        assert_eq!(
            (lane.predecessors.len(), lane.successors.len()),
            (1, 1),
            "{}",
            lane.name
        );
    }
    assert_eq!(inside.count(), 12);
    // Every arm leads to the three others.
    for incoming in ["0_0_1", "1_0_1", "2_0_-1", "3_0_-1"] {
        let exits = named(&map, incoming)
            .successors
            .iter()
            .map(|id| map.lane(*id).successors[0]);
        let mut roads: Vec<&str> = exits.map(|id| map.lane(id).road.as_str()).collect();
        roads.sort_unstable();
        roads.dedup();
        assert_eq!(roads.len(), 3, "from {incoming}");
        assert!(!roads.contains(&named(&map, incoming).road.as_str()));
    }
    let (gap, turn) = worst_joint(&map);
    assert!(
        gap < 0.01 && turn < 0.01,
        "lanes join within {gap} m and {turn} rad"
    );
    assert!(
        !warnings
            .iter()
            .any(|w| w.contains("not joined") || w.contains("not linked")),
        "{warnings:?}"
    );
    let line = line(&map, &["0_0_1", "9_0_-1", "2_0_1"]);
    assert!(line.near_junction(100.0, 1.0));
}

#[test]
fn two_plus_one_is_followed_through_its_sections() {
    let Some((map, _)) = load("two_plus_one") else {
        return;
    };
    assert_eq!(
        (
            sections(&map),
            count(&map, LaneKind::Driving).0,
            map.lanes().len()
        ),
        (5, 17, 17)
    );
    let forward = ["1_0_-1", "1_1_-2", "1_2_-2", "1_3_-2", "1_4_-1"];
    let back = ["1_4_2", "1_3_2", "1_2_1", "1_1_2", "1_0_2"];
    for names in [forward, back] {
        for pair in names.windows(2) {
            assert_eq!(successors(&map, pair[0]), [pair[1]]);
        }
        let line = line(&map, &names);
        assert_near(line.length(), 500.0, 1e-3);
        // Lane 0 and the new lane move against each other: the outer lane runs straight on.
        for s in (0..=500).map(f64::from) {
            let point = line.point(s);
            let (y, theta) = if names == forward {
                (-1.75, 0.0)
            } else {
                (5.25, std::f64::consts::PI)
            };
            assert_near(point.y, y, 1e-9);
            assert_near(angle::difference(point.theta, theta), 0.0, 1e-9);
        }
    }
    let opening = named(&map, "1_1_-1");
    assert_near(width(opening, 0.0), 0.0, 1e-9);
    assert_near(width(opening, opening.length()), 3.5, 1e-9);
    assert!(opening.predecessors.is_empty() && successors(&map, "1_1_-1") == ["1_2_-1"]);
}

#[test]
fn parking_demo_has_bays_that_lead_nowhere() {
    let Some((map, warnings)) = load("parking_demo") else {
        return;
    };
    assert_eq!((map.junctions().len(), sections(&map)), (1, 7));
    assert_eq!(named(&map, "1_0_2").kind, LaneKind::Parking, "the bays");
    assert_eq!(
        (named(&map, "3_0_2").kind, named(&map, "3_0_-2").kind),
        (LaneKind::Parking, LaneKind::Parking)
    );
    assert_eq!(
        count(&map, LaneKind::Driving).0,
        2 * 7,
        "one each way on every road"
    );
    assert!(map.find("2_0_2").is_none() && warnings.iter().any(|w| w.contains("without any width")));
    let ego = named(&map, "1_0_-1");
    assert!(
        ego.neighbours
            .iter()
            .flatten()
            .all(|id| map.lane(*id).kind.is_drivable())
    );
    assert_eq!(ego.neighbour(LEFT_REVERSE), map.find("1_0_1"));
    // Driving 3.25, border 0.3, shoulder 2.05, border 0.2, biking.
    assert_near(ego.at(50.0).road_right, 3.25 / 2.0 + 0.3 + 2.05, 1e-9);
    assert_eq!(named(&map, "1_0_-3").kind, LaneKind::Shoulder);
    let through = map
        .lanes()
        .iter()
        .filter(|lane| lane.kind.is_drivable() && lane.junction.is_some());
    assert!(
        through
            .clone()
            .all(|lane| lane.predecessors.len() == 1 && lane.successors.len() == 1)
    );
    assert_eq!(through.count(), 6);
}

#[test]
fn entry_and_exit_are_joined_by_direct_junctions() {
    let Some((map, warnings)) = load("Ex_Entry_Exit") else {
        return;
    };
    assert_eq!(map.junctions().len(), 2);
    assert_eq!(successors(&map, "300_0_-2"), ["305_0_-2"]);
    assert_eq!(
        successors(&map, "300_0_-3"),
        ["305_0_-3", "308_0_-1"],
        "on or off"
    );
    assert_eq!(successors(&map, "300_0_-4"), ["308_0_-2"]);
    assert_eq!(successors(&map, "315_2_-2"), ["313_0_-2"]);
    assert_eq!(successors(&map, "292_1_-1"), ["313_0_-4"]);
    assert_eq!(named(&map, "308_0_-1").kind, LaneKind::Ramp);
    let (stops, length) = count(&map, LaneKind::Stop);
    assert_eq!(stops, 1);
    assert_near(length, 285.0, 3.0);
    let stop = first(&map, LaneKind::Stop);
    assert_near(width(stop, 100.0), 3.6, 1e-9);
    assert!(
        warnings.iter().any(|w| w.contains("a lane that does not exist")),
        "292 lane -4: {warnings:?}"
    );
    let (gap, turn) = worst_joint(&map);
    assert!(
        gap < 0.02 && turn < 0.02,
        "lanes join within {gap} m and {turn} rad"
    );
}

#[test]
fn town07_is_a_network() {
    let Some((map, warnings)) = load("carla_Town07_libOpenDRIVE_test") else {
        return;
    };
    assert_eq!(map.junctions().len(), 31);
    assert_eq!(
        (
            count(&map, LaneKind::Shoulder).0,
            count(&map, LaneKind::Parking).0
        ),
        (195, 3)
    );
    assert_near(count(&map, LaneKind::Driving).1, 7100.0, 50.0);
    for told in [
        "shorter than 1 mm is skipped (83 of",
        "shorter than 1 mm is skipped (81 of",
    ] {
        assert!(warnings.iter().any(|w| w.contains(told)), "{told}: {warnings:?}");
    }
    let drivable = map.lanes().iter().filter(|lane| lane.kind.is_drivable());
    for lane in drivable.clone() {
        assert!(!lane.successors.is_empty(), "{} leads nowhere", lane.name);
        let opens = width(lane, 0.0) < 1e-3;
        assert!(
            opens || !lane.predecessors.is_empty(),
            "nothing leads to {}",
            lane.name
        );
    }
    let mut connecting: Vec<&str> = drivable
        .filter(|lane| lane.junction.is_some())
        .map(|lane| lane.road.as_str())
        .collect();
    connecting.sort_unstable();
    connecting.dedup();
    assert_eq!(connecting.len(), 166);
    let (gap, turn) = worst_joint(&map);
    assert!(
        gap < 0.1 && turn < 0.05,
        "lanes join within {gap} m and {turn} rad"
    );
    // 25, 35 and 40 mph.
    let mut limits: Vec<f64> = map
        .lanes()
        .iter()
        .map(|lane| lane.points[0].speed_limit)
        .collect();
    limits.retain(|limit| limit.is_finite());
    limits.sort_by(f64::total_cmp);
    limits.dedup();
    let expected = [25.0, 35.0, 40.0].map(|mph: f64| mph * 0.447_04);
    assert_eq!(limits.len(), 3);
    limits
        .iter()
        .zip(expected)
        .for_each(|(is, expected)| assert_near(*is, expected, 1e-3));
}

/// Copies by hand: each repetition's length over its distance, and one.
#[test]
fn objects_are_those_of_the_files() {
    for name in [
        "straight_500m",
        "curves",
        "fabriksgatan",
        "two_plus_one",
        "Ex_Entry_Exit",
        "carla_Town07_libOpenDRIVE_test",
    ] {
        let Some(import) = import(name) else { return };
        assert!(import.objects.is_empty(), "{name}");
    }
    let (Some(motorway), Some(parking)) = (import("e6mini"), import("parking_demo")) else {
        return;
    };
    assert_eq!(objects(&motorway, ObjectKind::Pole), (4, 2 * 367 + 2 * 30));
    assert_eq!(objects(&motorway, ObjectKind::Barrier).0, 2);
    assert_eq!(objects(&parking, ObjectKind::ParkingSpace).0, 7);
    assert_eq!(objects(&parking, ObjectKind::Crosswalk).0, 3);
    // Five trunks, and five crowns of seven outlines.
    assert_eq!(objects(&parking, ObjectKind::Tree), (2, 5 + 5 * 7));
    for import in [&motorway, &parking] {
        let kinds = |kind| objects(import, kind).0;
        assert_eq!(kinds(ObjectKind::Other), 0);
        for object in import.objects.iter().filter(|object| !object.kind.is_flat()) {
            for &corner in object.outline.vertices() {
                assert!(
                    import.map.lanes_at(corner).is_empty(),
                    "{} on a lane",
                    object.name
                );
            }
        }
    }
}

/// Where bays are drawn on road 1 there is a bay lane below them, and each has the size of a car.
#[test]
fn parking_spaces_lie_on_the_bays() {
    let Some(import) = import("parking_demo") else {
        return;
    };
    let spaces = import
        .objects
        .iter()
        .filter(|object| object.kind == ObjectKind::ParkingSpace);
    for space in spaces.filter(|object| object.name.starts_with("1_")) {
        let area = space.outline.area();
        assert!(area > 9.0 && area < 16.0, "{}: {area} m²", space.name);
        let corners = space.outline.vertices();
        let middle = corners.iter().sum::<Vec2>() / corners.len() as f64;
        assert!(
            import.map.distance_off_road(middle) < 1e-9,
            "{} beside the road",
            space.name
        );
        assert!(import.map.lanes_at(middle).is_empty(), "{} on a lane", space.name);
    }
}

#[test]
fn direct_junctions_link_both_ways() {
    let Some((map, _)) = load("Ex_Entry_Exit") else {
        return;
    };
    let predecessors = |name: &str| -> Vec<&str> {
        let ids = &named(&map, name).predecessors;
        ids.iter().map(|id| map.lane(*id).name.as_str()).collect()
    };
    for (to, from) in [
        ("313_0_-2", "315_2_-2"),
        ("313_0_-4", "292_1_-1"),
        ("305_0_-2", "300_0_-2"),
        ("305_0_-3", "300_0_-3"),
        ("308_0_-1", "300_0_-3"),
        ("308_0_-2", "300_0_-4"),
    ] {
        assert_eq!(predecessors(to), [from], "to {to}");
    }
}

#[test]
fn the_place_on_the_earth_is_kept() {
    let Some(import) = import("straight_500m") else {
        return;
    };
    let text = import.geo_reference.unwrap_or_default();
    assert!(text.starts_with("+proj=utm"), "{text}");
}
