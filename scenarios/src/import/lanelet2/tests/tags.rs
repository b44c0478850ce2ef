//! Kinds, lines, speeds, positions.

use super::{Osm, lane, lines};
use corridor_decider::road::{BoundaryType, LaneKind, RoadMap, Side};

/// Speed limit in km/h.
fn speed(map: &RoadMap, name: &str) -> String {
    format!("{:.1}", lane(map, name).points[0].speed_limit * 3.6)
}

#[test]
fn lines_are_seen_from_both_sides() {
    let line = [("type", "line_thin"), ("subtype", "dashed_solid")];
    let kerb = [("type", "curbstone"), ("subtype", "high")];
    // Way 5 runs along x, way 6 is the same line drawn the other way.
    let osm = lines()
        .way(5, &[20, 21, 22], &line)
        .way(6, &[22, 21, 20], &line)
        .way(7, &[10, 12], &kerb);
    let map = osm
        .lanelet(100, 7, 5, &[])
        .lanelet(101, 5, 3, &[])
        .lanelet(102, 1, 6, &[])
        .lanelet(103, 6, 3, &[])
        .read()
        .map;
    let mark = |name, side| lane(&map, name).mark(side, 3.0);
    assert_eq!(mark("100", Side::Right), BoundaryType::DottedWhite);
    assert_eq!(mark("101", Side::Left), BoundaryType::SolidWhite);
    assert_eq!(mark("102", Side::Right), BoundaryType::SolidWhite);
    assert_eq!(mark("103", Side::Left), BoundaryType::DottedWhite);
    assert_eq!(mark("100", Side::Left), BoundaryType::Curb);
    assert_eq!(mark("102", Side::Left), BoundaryType::Unknown);
}

#[test]
fn speeds_come_from_the_tag_the_rule_or_the_place() {
    let rule = |osm: Osm, id, sign, list: &[(&str, &str)]| {
        let list = [
            &[("type", "regulatory_element"), ("subtype", "speed_limit")],
            list,
        ]
        .concat();
        osm.relation(id, &[("way", sign, "refers")], &list)
    };
    let osm = lines().way(50, &[], &[("type", "traffic_sign"), ("subtype", "de274-70")]);
    let osm = rule(rule(osm, 60, 50, &[]), 61, 51, &[("sign_type", "25 mph")]);
    let ruled = |osm: Osm, id, rule| {
        let members = [
            ("way", 1, "left"),
            ("way", 2, "right"),
            ("relation", rule, "regulatory_element"),
        ];
        osm.relation(id, &members, &[("type", "lanelet")])
    };
    let osm = osm
        .lanelet(100, 1, 2, &[("speed_limit", "30 km/h")])
        .lanelet(101, 1, 2, &[("speed_limit", "fast"), ("location", "nonurban")])
        .lanelet(102, 1, 2, &[("subtype", "play_street")]);
    let file = ruled(ruled(osm, 103, 60), 104, 61).read();
    let speeds = ["100", "101", "102", "103", "104"].map(|name| speed(&file.map, name));
    assert_eq!(speeds, ["30.0", "100.0", "7.0", "70.0", "40.2"]);
    let told = |what: &str| file.warnings.iter().any(|warning| warning.contains(what));
    assert!(told("relation 101: a speed limit that is no speed"));
    assert!(told("relation 102: a lanelet without a speed limit"));
}

#[test]
fn who_may_use_a_lanelet_decides_its_kind() {
    let map = lines()
        .lanelet(100, 1, 2, &[])
        .lanelet(
            101,
            1,
            2,
            &[
                ("subtype", "road"),
                ("participant:bicycle", "yes"),
                ("one_way", "no"),
            ],
        )
        .lanelet(102, 1, 2, &[("subtype", "emergency_lane")])
        .lanelet(103, 1, 2, &[("subtype", "gravel"), ("2237", "3007112")])
        .read()
        .map;
    let kinds: Vec<LaneKind> = map.lanes().iter().map(|lane| lane.kind).collect();
    assert_eq!(
        kinds,
        [
            LaneKind::Driving,
            LaneKind::Biking,
            LaneKind::Restricted,
            LaneKind::Other
        ]
    );
}

#[test]
fn latitudes_and_longitudes_are_projected_around_the_tenth_of_a_degree() {
    let corners = [
        (1, 49.01, 8.42),
        (2, 49.01, 8.421),
        (3, 49.009_96, 8.42),
        (4, 49.009_96, 8.421),
    ];
    let mut osm = Osm::default();
    for (id, lat, lon) in corners {
        osm.elements
            .push(format!("<node id='{id}' lat='{lat}' lon='{lon}'/>"));
    }
    let file = osm
        .way(1, &[1, 2], &[])
        .way(2, &[3, 4], &[])
        .lanelet(9, 1, 2, &[])
        .read();
    let points = &lane(&file.map, "9").points;
    // Degrees are 111.2 km to the north and 73.2 km to the east there.
    assert!((points[0].x - 1463.0).abs() < 2.0 && (points[0].y - 1110.0).abs() < 2.0);
    assert!(
        (lane(&file.map, "9").length() - 73.14).abs() < 0.02,
        "{}",
        lane(&file.map, "9").length()
    );
    assert!((points[0].left + points[0].right - 4.45).abs() < 0.01);
}

#[test]
fn what_is_survived_is_told() {
    let parking = [("type", "multipolygon"), ("subtype", "parking")];
    let mut osm = lines()
        .lanelet(100, 1, 2, &[])
        .lanelet(100, 2, 3, &[])
        .lanelet(101, 1, 99, &[])
        .relation(102, &[("way", 1, "left")], &[("type", "lanelet")])
        .relation(103, &[("way", 1, "outer")], &parking)
        .relation(
            104,
            &[("way", 1, "left"), ("way", 2, "right"), ("way", 3, "centerline")],
            &[("type", "lanelet")],
        );
    osm.elements
        .push("<way id='1' action='delete'/><MetaInfo format_version='2'/>".to_owned());
    osm.elements
        .push("<node id='-9007199254740993' lat='' lon='8.4'/>".to_owned());
    let file = osm.read();
    assert_eq!(file.map.lanes().len(), 2);
    for what in [
        "relation 100: a second element of this id",
        "relation 101: a lanelet with a bound of less than two points",
        "relation 102: a lanelet without exactly one left and one right bound",
        "relation 103: an area for parking",
        "relation 104: a centre line that is drawn is not used",
        "way 1: a deleted element",
        "node -9007199254740993: a node without a position",
    ] {
        assert!(
            file.warnings.iter().any(|warning| warning.contains(what)),
            "{what}: {:?}",
            file.warnings
        );
    }
}
