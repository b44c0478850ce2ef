//! Input that is wrong on purpose: a clear error, never a panic, never a hang.

use super::{lane, widths};
use crate::import::apollo::{read_map, read_routing, to_road_map};
use corridor_decider::geometry::Vec2;
use corridor_decider::hd_map::{HdLaneKind, LaneData, MapData};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

fn message(bytes: &[u8]) -> String {
    read_map(bytes).expect_err("is wrong").to_string()
}

fn one_lane() -> String {
    let inside = format!(
        "{}\nlength: 30 turn: NO_TURN\nspeed_limit: 10\nsuccessor_id {{ id: \"b\" }}",
        widths(1.5, 2.0)
    );
    lane("a", &[(0.0, 0.0), (30.0, 0.0)], &inside) + &lane("b", &[(30.0, 0.0), (60.0, 0.0)], "")
}

#[test]
fn what_is_not_a_map_says_so() {
    assert!(message(b"").contains("lane the map has none; expected lanes"));
    assert!(message(b"header { version: '1' }").contains("the map has none"));
    assert!(message(b"<?xml version='1.0'?>").contains("1:1: there is `<`; expected the name of a field"));
    assert!(message(b"lane { \xff }").contains("byte 7: the text is not UTF-8 here"));
    assert!(message(&[0x22, 200, 1, 0]).contains("byte 0: field 4 says it has 200 bytes, but 1 are left"));
    assert!(message(&[0x27, 0]).contains("byte 0: invalid wire type value: 7"));
    let undecodable = "lane[0] cannot be decoded at `id`: buffer underflow; expected a message of Apollo's";
    assert_eq!(message(&[0x22, 2, 0x0a, 9]), undecodable);
    // A polyline in whose first point x is a string.
    let nested = [0x22, 10, 0x12, 8, 0x0a, 6, 0x0a, 4, 0x0a, 2, 0x0a, 0];
    let undecodable =
        "lane[0] cannot be decoded at `central_curve.segment.line_segment.point.x`: invalid wire type";
    assert!(message(&nested).starts_with(undecodable), "{}", message(&nested));
}

/// What is replaced, by what, and what the message must say.
#[test]
fn wrong_values_are_named_with_their_place() {
    let cases = [
        ("x: 30", "x: thirty", "`x` is thirty; expected a number"),
        (
            "x: 30",
            "",
            "1:84: lane[0].central_curve.segment[0].line_segment.point[1].x is missing",
        ),
        (
            "x: 30",
            "x: nan",
            "point[1].x is NaN; expected at most 1e8 m from the origin",
        ),
        ("x: 30", "x: -1e300", "from the origin"),
        (
            "x: 30",
            "x: 300",
            "lane[0].length is 30, but the points of `central_curve` are 300.00 m long",
        ),
        (
            "point { x: 30 y: 0 }",
            "",
            "lane[0].central_curve has 1 points; expected at least 2",
        ),
        ("CITY_DRIVING", "9", "lane[0].type is 9; expected 1 to 7"),
        (
            "CITY_DRIVING",
            "ROAD",
            "`type` is ROAD; expected one of NONE, CITY_DRIVING, BIKING",
        ),
        ("NO_TURN", "-1", "2:12: lane[0].turn is -1; expected 1 to 4"),
        (
            "width: 2",
            "width: -2",
            "right_sample[0].width is -2; expected a width of 0 or more",
        ),
        (
            "speed_limit: 10",
            "speed_limit: inf",
            "3:1: lane[0].speed_limit is inf",
        ),
        (
            "id: \"a\"",
            "id: \"\"",
            "lane[0].id is missing or empty; expected a name",
        ),
        ("id: \"a\"", "id: 'b'", "lane[1].id is `b` for the second time"),
        ("id: \"a\"", "id: a", "`id` is a; expected a string in quotes"),
        (
            "id: \"b\"",
            "id: \"c\"",
            "1 of 1 links lead to lanes that are not there, the first to `c`",
        ),
        (
            "length: 30",
            "length: 30 length: 30",
            "there is a second `length`",
        ),
        (
            "length: 30",
            "length { }",
            "`length` is a message; expected a number",
        ),
        (
            "length: 30",
            "length 30",
            "there is `30`; expected `:` or `{` after `length`",
        ),
        (
            "length: 30",
            "length: \"30",
            "2:9: a string does not end on its line",
        ),
        (
            "length: 30",
            "length: }",
            "there is `}`; expected a value for `length`",
        ),
        ("length: 30", "length: [30, 30", "expected `,` or `]`"),
        ("length: 30", "@", "2:1: there is a '@'"),
        ("id: \"a\"", "id: \"\\q\"", "there is no escape \\q"),
    ];
    for (right, wrong, expected) in cases {
        let text = one_lane();
        assert!(text.contains(right), "{right}");
        let message = message(text.replacen(right, wrong, 1).as_bytes());
        assert!(message.contains(expected), "{wrong}: {message}");
    }
}

#[test]
fn deep_nesting_is_refused() {
    for open in ["lane {", "lane: <", "lane: [{", "lane { point ["] {
        let message = message(open.repeat(200_000).as_bytes());
        assert!(
            message.contains("nested more than 32 deep") || message.contains("there is"),
            "{message}"
        );
    }
    // A chain of length-delimited fields inside each other, and one of groups.
    let mut deep = Vec::new();
    for _ in 0..1000 {
        let mut outer = vec![0x12];
        prost::encoding::encode_varint(deep.len() as u64, &mut outer);
        outer.extend(&deep);
        deep = outer;
    }
    assert!(read_map(&deep).is_err());
    assert!(message(&vec![0x1b; 100_000]).contains("byte 0: recursion limit reached"));
}

/// Lists of nothing, in both forms: refused at the first, or at a limit, before they take memory.
#[test]
fn many_empty_messages_are_refused() {
    let empty_lanes = [0x22, 0].repeat(1_000_000);
    assert!(message(&empty_lanes).contains("lane[0].central_curve has 0 points"));
    let points = b"point{}".repeat(1_000_001);
    let text = [
        b"lane { central_curve { segment { line_segment {",
        &points[..],
        b"}}}}",
    ]
    .concat();
    assert!(message(&text).contains("more than 1000000 fields belong together"));
    let mut huge = vec![0x22];
    let sections = [0x12, 0].repeat(3_000_000);
    prost::encoding::encode_varint(sections.len() as u64, &mut huge);
    huge.extend(sections);
    assert!(message(&huge).contains("lane[0] has 6000000 bytes; expected at most 4194304"));
}

fn lane_data(id: &str, points: &[(f64, f64)]) -> LaneData {
    LaneData {
        id: id.to_owned(),
        points: points.iter().map(|&(x, y)| Vec2::new(x, y)).collect(),
        kind: HdLaneKind::CityDriving,
        left_samples: vec![(0.0, 1.5)],
        right_samples: vec![(0.0, 1.5)],
        ..LaneData::default()
    }
}

#[test]
fn a_map_too_large_for_the_memory_is_refused() {
    let too_large = |lane: LaneData| {
        let map = MapData {
            lanes: vec![lane],
            ..MapData::default()
        };
        let error = to_road_map(&map).unwrap_err().to_string();
        assert!(
            error.contains("lane `a` makes the map larger than 5 million cross-sections"),
            "{error}"
        );
    };
    too_large(lane_data("a", &[(-1e8, 0.0), (1e8, 0.0)]));
    let wide = vec![(0.0, 1e6)];
    too_large(LaneData {
        left_samples: wide,
        ..lane_data("a", &[(0.0, 0.0), (100.0, 0.0)])
    });
    // Widths measured to an edge of very many points.
    let mut edged = lane_data("a", &[(0.0, 0.0), (10_000.0, 0.0)]);
    edged.left_samples.clear();
    edged.left_boundary.points = (0..100_000).map(|k| Vec2::new(f64::from(k), 2.0)).collect();
    too_large(edged);
}

/// Data that no file can hold, because [`read_map`] refuses it, may still be handed over.
#[test]
fn data_that_was_not_read_from_a_file_is_refused_too() {
    let refused = |lane: LaneData| {
        let map = MapData {
            lanes: vec![lane],
            ..MapData::default()
        };
        assert!(to_road_map(&map).is_err());
    };
    refused(lane_data("a", &[]));
    refused(lane_data("a", &[(0.0, 0.0)]));
    refused(lane_data("a", &[(0.0, 0.0), (0.0, 0.0)]));
    refused(lane_data("a", &[(0.0, 0.0), (f64::NAN, 0.0)]));
    refused(lane_data("a", &[(0.0, 0.0), (f64::INFINITY, 0.0)]));
    refused(LaneData {
        left_samples: vec![(0.0, f64::NAN)],
        ..lane_data("a", &[(0.0, 0.0), (9.0, 0.0)])
    });
    assert!(to_road_map(&MapData::default()).is_err());
}

/// A file cut short, with a byte changed, or a piece written over another.
fn damaged(original: &[u8], kind: usize, mut below: impl FnMut(usize) -> usize) -> Vec<u8> {
    const PATCH: usize = 12;
    let mut bytes = original.to_vec();
    match kind {
        0 => bytes.truncate(below(original.len())),
        1 => bytes[below(original.len())] = u8::try_from(below(256)).unwrap(),
        2 => bytes[below(original.len())] = b"0123456789-.e{}:\"["[below(18)],
        _ => {
            let (from, to) = (below(bytes.len() - PATCH), below(bytes.len() - PATCH));
            bytes.copy_within(from..from + PATCH, to);
        }
    }
    bytes
}

/// Whatever comes out, it comes out.
#[test]
fn damaged_maps_never_panic() {
    let mut random = Pcg64Mcg::seed_from_u64(20);
    let mut below = |limit: usize| usize::try_from(random.next_u64() % limit as u64).unwrap();
    let (mut read, mut refused) = (0, 0);
    let maps = [
        super::both_forms::binary(),
        super::both_forms::MAP.into(),
        one_lane().into(),
    ];
    for original in maps {
        for round in 0..2000 {
            let bytes = damaged(&original, round % 4, &mut below);
            match read_map(&bytes).and_then(|map| to_road_map(&map)) {
                Ok(_) => read += 1,
                Err(_) => refused += 1,
            }
            // Not a routing, and not to be trusted either.
            let _ = read_routing(&bytes);
        }
    }
    assert!(
        read > 100 && refused > 100,
        "the damage is not mixed: {read} read, {refused} refused"
    );
}
