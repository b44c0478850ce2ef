//! One map written twice: bytes put together by the numbers of the schema, and text by its names.

use super::data;
use crate::import::apollo::read_map;
use corridor_decider::geometry::Vec2;
use corridor_decider::hd_map::{
    Area, BoundaryData, Direction, EdgeData, EdgeKind, HdLaneKind, LaneData, MapData, Overlap, OverlapKind,
    OverlapObject, RoadData, RoadKind, SectionData, StopLines, Turn,
};
use corridor_decider::road::BoundaryType;

const TEXT: &str = r#"
# A map with one of everything.
header { version: "1.0" projection { proj: "+proj=utm +zone=10" } top: 3 }
lane {
  id { id: "a" }
  central_curve: {
    segment { s: 0 line_segment { point { x: 500000.25, y: 4e6 z: 1 } point { x: 500010.25; y: 4000000; } } }
    segment < line_segment < point < x: 500020.25 y: 4000000f > > length: inf >
  }
  left_boundary { virtual: true length: 20 boundary_type { s: 5 types: [CURB, SOLID_WHITE] } boundary_type { types: DOTTED_YELLOW } }
  right_boundary { curve { segment { line_segment { point { x: 1 y: -2.5 } } } } }
  length: 20
}
"#;

/// The text form of the same map, every field of the schema that is read.
pub(super) const MAP: &str = r#"
header { projection { proj: "+proj=utm" } }
crosswalk { id { id: "walk" } polygon { point { x: 1 y: 2 } } overlap_id { id: "o" } }
junction { id { id: "cross" } polygon { point { x: 3 y: 4 } } }
lane {
  id { id: "a" }
  central_curve { segment { line_segment { point { x: 0 y: 0 } point { x: 10 y: 0 } } } }
  left_boundary {
    curve { segment { line_segment { point { x: 0 y: 1.5 } } } }
    virtual: true
    boundary_type { s: 5 types: CURB types: SOLID_WHITE }
    boundary_type { s: 0 types: DOTTED_YELLOW }
  }
  length: 10.125
  speed_limit: 8.5
  overlap_id { id: "o" }
  predecessor_id { id: "b" }
  successor_id { id: "b" }
  left_neighbor_forward_lane_id { id: "c" }
  right_neighbor_forward_lane_id { id: "b" }
  type: BIKING
  turn: U_TURN
  left_neighbor_reverse_lane_id { id: "b" }
  right_neighbor_reverse_lane_id { id: "b" }
  junction_id { id: "cross" }
  left_sample { s: 9 width: 1.25 }
  left_sample { s: 0 width: 1.5 }
  right_sample { s: 0 width: 2 }
  direction: BIDIRECTION
  left_road_sample { s: 0 width: 3 }
  right_road_sample { s: 0 width: 4 }
}
lane { id { id: "b" } central_curve { segment { line_segment { point { x: 0 y: 9 } point { x: 10 y: 9 } } } } }
stop_sign { id { id: "stop" } stop_line { segment { line_segment { point { x: 5 y: 6 } } } } }
signal { id { id: "light" } boundary { point { x: 7 y: 8 } } overlap_id { id: "o" } stop_line { segment { line_segment { point { x: 5 y: 6 } } } } }
yield { id { id: "yield" } overlap_id { id: "o" } }
overlap {
  id { id: "o" }
  object { id { id: "a" } lane_overlap_info { start_s: 1 end_s: 2 is_merge: true } }
  object { id { id: "walk" } crosswalk_overlap_info { region_overlap_id { id: "r" } } }
  object { id { id: "none" } }
  object { id { id: "gate" } barrier_gate_overlap_info { } }
}
clear_area { id { id: "clear" } overlap_id { id: "o" } polygon { point { x: 1 y: 1 } } }
speed_bump { id { id: "bump" } position { segment { line_segment { point { x: 2 y: 2 } } } } }
road {
  id { id: "r" }
  section {
    id { id: "1" }
    lane_id { id: "a" }
    boundary { outer_polygon { edge { curve { segment { line_segment { point { x: 0 y: 3 } } } } type: LEFT_BOUNDARY } } }
  }
  junction_id { id: "cross" }
  type: CITY_ROAD
}
parking_space { id { id: "bay" } polygon { point { x: 6 y: 6 } } heading: 1 }
pnc_junction { id { id: "pnc" } }
"#;

fn varint(mut value: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    while value >= 128 {
        bytes.push(u8::try_from(value & 127).unwrap() | 128);
        value >>= 7;
    }
    bytes.push(u8::try_from(value).unwrap());
    bytes
}

fn tagged(number: u64, wire_type: u64, content: &[u8]) -> Vec<u8> {
    [&varint(number << 3 | wire_type), content].concat()
}

/// A message from its fields.
fn message(number: u64, fields: &[Vec<u8>]) -> Vec<u8> {
    let inside = fields.concat();
    tagged(number, 2, &[varint(inside.len() as u64), inside].concat())
}

fn string(number: u64, text: &str) -> Vec<u8> {
    message(number, &[text.as_bytes().to_vec()])
}

fn double(number: u64, value: f64) -> Vec<u8> {
    tagged(number, 1, &value.to_le_bytes())
}

fn integer(number: u64, value: u64) -> Vec<u8> {
    tagged(number, 0, &varint(value))
}

fn id(number: u64, name: &str) -> Vec<u8> {
    message(number, &[string(1, name)])
}

fn point(x: f64, y: f64) -> Vec<u8> {
    message(1, &[double(1, x), double(2, y), double(3, 99.0)])
}

fn curve(number: u64, points: &[Vec<u8>]) -> Vec<u8> {
    message(number, &[message(1, &[message(1, points), double(9, 1.0)])])
}

fn sample(number: u64, s: f64, width: f64) -> Vec<u8> {
    message(number, &[double(1, s), double(2, width)])
}

fn lane_a() -> Vec<u8> {
    let left = [
        curve(1, &[point(0.0, 1.5)]),
        integer(3, 1),
        // Packed and unpacked enumerations mean the same.
        message(4, &[double(1, 5.0), message(2, &[vec![6, 4]])]),
        message(4, &[double(1, 0.0), integer(2, 1)]),
    ];
    let fields = [
        id(1, "a"),
        curve(2, &[point(0.0, 0.0), point(10.0, 0.0)]),
        message(3, &left),
        double(5, 10.125),
        double(6, 8.5),
        id(7, "o"),
        id(8, "b"),
        id(9, "b"),
        id(10, "c"),
        id(11, "b"),
        integer(12, 3),
        integer(13, 4),
        id(14, "b"),
        id(15, "b"),
        id(16, "cross"),
        sample(17, 9.0, 1.25),
        sample(17, 0.0, 1.5),
        sample(18, 0.0, 2.0),
        integer(19, 3),
        sample(20, 0.0, 3.0),
        sample(21, 0.0, 4.0),
        id(22, "unknown to older versions"),
    ];
    message(4, &fields)
}

fn overlap() -> Vec<u8> {
    let lane = message(3, &[double(1, 1.0), double(2, 2.0), integer(3, 1)]);
    message(
        8,
        &[
            id(1, "o"),
            message(2, &[id(1, "a"), lane]),
            message(2, &[id(1, "walk"), message(6, &[id(1, "r")])]),
            message(2, &[id(1, "none")]),
            message(2, &[id(1, "gate"), message(15, &[])]),
        ],
    )
}

fn road() -> Vec<u8> {
    let edge = message(1, &[curve(1, &[point(0.0, 3.0)]), integer(2, 2)]);
    let section = message(2, &[id(1, "1"), id(2, "a"), message(3, &[message(1, &[edge])])]);
    message(11, &[id(1, "r"), section, id(3, "cross"), integer(4, 2)])
}

/// The binary form of [`MAP`]. Records of different kinds come in another order, which means nothing.
pub(super) fn binary() -> Vec<u8> {
    [
        lane_a(),
        message(4, &[id(1, "b"), curve(2, &[point(0.0, 9.0), point(10.0, 9.0)])]),
        overlap(),
        road(),
        message(
            1,
            &[
                string(1, "\u{1}"),
                message(3, &[string(1, "+proj=utm")]),
                double(8, 1.0),
            ],
        ),
        message(2, &[id(1, "walk"), message(2, &[point(1.0, 2.0)]), id(3, "o")]),
        message(
            3,
            &[id(1, "cross"), message(2, &[point(3.0, 4.0)]), integer(4, 2)],
        ),
        message(5, &[id(1, "stop"), curve(2, &[point(5.0, 6.0)]), integer(4, 1)]),
        message(
            6,
            &[
                id(1, "light"),
                message(2, &[point(7.0, 8.0)]),
                id(4, "o"),
                curve(6, &[point(5.0, 6.0)]),
            ],
        ),
        message(7, &[id(1, "yield"), id(3, "o")]),
        message(9, &[id(1, "clear"), id(2, "o"), message(3, &[point(1.0, 1.0)])]),
        message(10, &[id(1, "bump"), curve(3, &[point(2.0, 2.0)])]),
        message(
            12,
            &[id(1, "bay"), message(2, &[point(6.0, 6.0)]), double(4, 1.0)],
        ),
        message(13, &[id(1, "pnc"), message(4, &[id(1, "group")])]),
        // What later versions add.
        message(16, &[id(1, "gate")]),
        integer(99, 7),
    ]
    .concat()
}

fn expected_lane() -> LaneData {
    let names = |list: &[&str]| list.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
    LaneData {
        id: "a".to_owned(),
        points: vec![Vec2::new(0.0, 0.0), Vec2::new(10.0, 0.0)],
        length: 10.125,
        speed_limit: Some(8.5),
        kind: HdLaneKind::Biking,
        turn: Turn::UTurn,
        direction: Direction::Bidirection,
        left_boundary: BoundaryData {
            points: vec![Vec2::new(0.0, 1.5)],
            is_virtual: true,
            types: vec![
                (0.0, vec![BoundaryType::DottedYellow]),
                (5.0, vec![BoundaryType::Curb, BoundaryType::SolidWhite]),
            ],
        },
        right_boundary: BoundaryData::default(),
        overlaps: names(&["o"]),
        predecessors: names(&["b"]),
        successors: names(&["b"]),
        neighbours: [names(&["c"]), names(&["b"]), names(&["b"]), names(&["b"])],
        junction: Some("cross".to_owned()),
        left_samples: vec![(0.0, 1.5), (9.0, 1.25)],
        right_samples: vec![(0.0, 2.0)],
        left_road_samples: vec![(0.0, 3.0)],
        right_road_samples: vec![(0.0, 4.0)],
    }
}

fn area(id: &str, x: f64, y: f64, overlaps: &[&str]) -> Area {
    Area {
        id: id.to_owned(),
        polygon: vec![Vec2::new(x, y)],
        overlaps: overlaps.iter().map(|&name| name.to_owned()).collect(),
    }
}

fn expected() -> MapData {
    let object = |id: &str, kind| OverlapObject {
        id: id.to_owned(),
        kind,
    };
    let lines = |id: &str, x: f64, y: f64| StopLines {
        id: id.to_owned(),
        lines: vec![vec![Vec2::new(x, y)]],
        ..StopLines::default()
    };
    let on = OverlapKind::Lane {
        start_s: 1.0,
        end_s: 2.0,
        is_merge: true,
    };
    let plain = LaneData {
        id: "b".to_owned(),
        points: vec![Vec2::new(0.0, 9.0), Vec2::new(10.0, 9.0)],
        length: 10.0,
        ..LaneData::default()
    };
    let edge = EdgeData {
        points: vec![Vec2::new(0.0, 3.0)],
        kind: EdgeKind::Left,
    };
    let section = SectionData {
        id: "1".to_owned(),
        lanes: vec!["a".to_owned()],
        edges: vec![edge],
    };
    MapData {
        projection: Some("+proj=utm".to_owned()),
        lanes: vec![expected_lane(), plain],
        roads: vec![RoadData {
            id: "r".to_owned(),
            junction: "cross".to_owned(),
            kind: RoadKind::CityRoad,
            sections: vec![section],
        }],
        junctions: vec![area("cross", 3.0, 4.0, &[])],
        pnc_junctions: vec![Area {
            id: "pnc".to_owned(),
            ..Area::default()
        }],
        crosswalks: vec![area("walk", 1.0, 2.0, &["o"])],
        clear_areas: vec![area("clear", 1.0, 1.0, &["o"])],
        parking_spaces: vec![area("bay", 6.0, 6.0, &[])],
        signals: vec![StopLines {
            boundary: vec![Vec2::new(7.0, 8.0)],
            overlaps: vec!["o".to_owned()],
            ..lines("light", 5.0, 6.0)
        }],
        stop_signs: vec![lines("stop", 5.0, 6.0)],
        yield_signs: vec![StopLines {
            id: "yield".to_owned(),
            overlaps: vec!["o".to_owned()],
            ..StopLines::default()
        }],
        speed_bumps: vec![lines("bump", 2.0, 2.0)],
        overlaps: vec![Overlap {
            id: "o".to_owned(),
            objects: vec![
                object("a", Some(on)),
                object("walk", Some(OverlapKind::Crosswalk)),
                object("none", None),
                object("gate", Some(OverlapKind::Other)),
            ],
        }],
    }
}

#[test]
fn the_text_form_holds_what_it_says() {
    assert_eq!(data(MAP), expected());
}

#[test]
fn the_binary_form_holds_the_same() {
    let map = read_map(&binary()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(map, expected());
}

/// All freedoms that the text form allows.
#[test]
fn every_way_to_write_a_text_is_understood() {
    let map = data(TEXT);
    assert_eq!(map.projection.as_deref(), Some("+proj=utm +zone=10"));
    let lane = &map.lanes[0];
    assert_eq!(lane.points[1], Vec2::new(500_010.25, 4e6));
    assert_eq!((lane.points.len(), lane.kind), (3, HdLaneKind::None));
    let types = [
        (0.0, vec![BoundaryType::DottedYellow]),
        (5.0, vec![BoundaryType::Curb, BoundaryType::SolidWhite]),
    ];
    assert_eq!(lane.left_boundary.types, types);
    assert_eq!(lane.right_boundary.points, [Vec2::new(1.0, -2.5)]);
}
