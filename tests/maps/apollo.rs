//! The Apollo files: a street map drawn for a simulator, a surveyed clip, and a single lane in text form.

use crate::sound::{DRAWN, assert_sound};
use crate::support::{count, line, map_file, named, worst_joint};
use corridor_decider::geometry::Vec2;
use corridor_decider::hd_map::{HdLaneKind, LaneData, MapData, OverlapKind, Turn};
use corridor_decider::road::{BoundaryType, Lane, LaneKind, Neighbour, RoadMap, Side};
use corridor_decider::routing::ChangeLaneType;
use corridor_scenarios::Family;
use corridor_scenarios::import::apollo;
use std::path::Path;

/// The bytes of a file.
fn bytes(name: &str) -> Option<Vec<u8>> {
    let file = map_file(&format!("apollo/{name}"))?;
    Some(std::fs::read(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display())))
}

/// The data of a map, and its road map, which passed the general checks without a warning.
fn load(name: &str) -> Option<(MapData, RoadMap)> {
    let data = apollo::read_map(&bytes(name)?).unwrap_or_else(|error| panic!("{error}"));
    let (map, warnings) = apollo::to_road_map(&data).unwrap_or_else(|error| panic!("{error}"));
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_sound(&map, DRAWN);
    assert_true_to(&data, &map);
    Some((data, map))
}

/// Largest distance from a line of the road map to the points drawn, m.
const OFF_POINTS: f64 = 0.1;

/// Largest distance to the chords between them, m: half the bulge of a bend with 26 m from point to point.
const OFF_CHORDS: f64 = 0.7;

/// What must hold between the data of any map and its road map.
fn assert_true_to(data: &MapData, map: &RoadMap) {
    assert_eq!(data.lanes.len(), map.lanes().len());
    for (drawn, lane) in data.lanes.iter().zip(map.lanes()) {
        assert_eq!(drawn.id, lane.name);
        assert!(
            (lane.length() - drawn.length).abs() < 0.01 * drawn.length,
            "{}",
            lane.name
        );
        assert_near_points(drawn, lane);
        for point in &lane.points {
            assert!(
                point.road_left < 25.0 && point.road_right < 25.0,
                "{}: {point:?}",
                lane.name
            );
        }
        for (edge, sign) in [(&drawn.left_boundary, 1.0), (&drawn.right_boundary, -1.0)] {
            let middle = edge.points[edge.points.len() / 2];
            assert!(
                offset(lane, middle) * sign > 0.0,
                "{}: an edge on the wrong side",
                lane.name
            );
        }
    }
    let (gap, turn) = worst_joint(map);
    assert!(
        gap < 0.01 && turn < 1e-9,
        "lanes meet within {gap} m and {turn} rad"
    );
}

fn assert_near_points(drawn: &LaneData, lane: &Lane) {
    let curve: Vec<Vec2> = lane.points.iter().map(|p| Vec2::new(p.x, p.y)).collect();
    for point in &drawn.points {
        let off = distance(*point, &curve);
        assert!(off < OFF_POINTS, "{}: {off} m from a point", lane.name);
    }
    for point in &curve {
        let off = distance(*point, &drawn.points);
        assert!(off < OFF_CHORDS, "{}: {off} m from a chord", lane.name);
    }
}

/// Distance from a point to a polyline.
fn distance(point: Vec2, line: &[Vec2]) -> f64 {
    let to_chord = |pair: &[Vec2]| {
        let along = pair[1] - pair[0];
        let share = ((point - pair[0]).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        (point - pair[0] - along * share).norm()
    };
    line.windows(2).map(to_chord).fold(f64::INFINITY, f64::min)
}

/// Offset of a point from a lane at its nearest cross-section, left positive.
fn offset(lane: &Lane, point: Vec2) -> f64 {
    let away = |p: &corridor_decider::road::LanePoint| (point - Vec2::new(p.x, p.y)).norm();
    let nearest = lane.points.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
    let at = nearest.expect("a lane has points");
    let (left, right) = (at.offset(1.0), at.offset(-1.0));
    (point - right).norm() - (point - left).norm()
}

/// How many lanes a question is true of.
fn lanes(data: &MapData, question: impl Fn(&LaneData) -> bool) -> usize {
    data.lanes.iter().filter(|lane| question(lane)).count()
}

/// How many lanes have a neighbour of a kind.
fn neighbours(map: &RoadMap, side: Side, reverse: bool) -> usize {
    let kind = Neighbour { side, reverse };
    map.lanes()
        .iter()
        .filter(|lane| lane.neighbour(kind).is_some())
        .count()
}

#[test]
fn borregas_avenue_is_a_street_with_two_crossings() {
    let Some((data, map)) = load("borregas_ave.base_map.bin") else {
        return;
    };
    let counts = [
        data.lanes.len(),
        data.roads.len(),
        data.junctions.len(),
        data.crosswalks.len(),
        data.signals.len(),
        data.stop_signs.len(),
        data.overlaps.len(),
    ];
    assert_eq!(counts, [60, 37, 2, 6, 15, 2, 143]);
    let (driving, length) = count(&map, LaneKind::Driving);
    assert!(
        driving == 60 && (length - 2730.0).abs() < 10.0,
        "{driving} lanes of {length} m"
    );
    let turns = [Turn::NoTurn, Turn::RightTurn, Turn::LeftTurn, Turn::UTurn];
    assert_eq!(
        turns.map(|turn| lanes(&data, |lane| lane.turn == turn)),
        [42, 10, 8, 0]
    );
    for lane in map.lanes() {
        let speed = lane.points[0].speed_limit;
        assert!(
            [6.7, 11.2, 15.6, 20.1]
                .iter()
                .any(|known| (speed - known).abs() < 0.05),
            "{speed}"
        );
        assert!(
            lane.points
                .iter()
                .all(|p| (p.left - 1.75).abs() < 1e-9 && (p.right - 1.75).abs() < 1e-9)
        );
        assert!(!lane.road.is_empty());
    }
    assert!(data.lanes.iter().all(|lane| lane.junction.is_none()));
    assert_eq!(
        data.projection.as_deref().map(|text| text.contains("+zone=10")),
        Some(true)
    );
    let found = [
        (Side::Left, false),
        (Side::Right, false),
        (Side::Left, true),
        (Side::Right, true),
    ];
    assert_eq!(
        found.map(|(side, reverse)| neighbours(&map, side, reverse)),
        [14, 14, 18, 0]
    );
}

/// Junctions are named by overlaps only: 28 lanes cross one, none of those that lead there does.
#[test]
fn borregas_avenue_knows_which_lanes_cross() {
    let Some((data, map)) = load("borregas_ave.base_map.bin") else {
        return;
    };
    for (drawn, lane) in data.lanes.iter().zip(map.lanes()) {
        let number: usize = drawn
            .id
            .strip_prefix("lane_")
            .and_then(|n| n.parse().ok())
            .expect("lane_0 to lane_59");
        assert_eq!(lane.junction.is_some(), number >= 32, "{}", drawn.id);
        let unknown =
            |edge: &[corridor_decider::road::Mark]| edge.iter().all(|m| m.kind == BoundaryType::Unknown);
        if lane.junction.is_none() {
            assert!(!unknown(&lane.left_marks), "{}", drawn.id);
        }
    }
}

/// The road samples say 1.75 m everywhere; the edges of the roads know better.
#[test]
fn borregas_avenue_is_as_wide_as_its_edges() {
    let Some((data, map)) = load("borregas_ave.base_map.bin") else {
        return;
    };
    for lane in &data.lanes {
        let samples = lane.left_road_samples.iter().chain(&lane.right_road_samples);
        assert!(samples.into_iter().all(|(_, width)| (width - 1.75).abs() < 1e-9));
    }
    let edges = |count| {
        data.roads
            .iter()
            .filter(|road| road.sections[0].edges.len() == count)
            .count()
    };
    assert_eq!((edges(2), edges(4)), (28, 9));
    // The rightmost of three lanes one way and the leftmost, which has only a median to its left.
    let at = named(&map, "lane_7").at(15.0);
    assert!(
        (at.road_right - 1.75).abs() < 0.1 && (at.road_left - 8.75).abs() < 0.3,
        "{at:?}"
    );
    let at = named(&map, "lane_9").at(15.0);
    assert!((at.road_left - 1.75).abs() < 0.1, "{at:?}");
    // A lane each way, drawn with half a metre between them.
    let at = named(&map, "lane_18").at(100.0);
    assert!(
        (5.25..5.9).contains(&at.road_left) && (at.road_right - 1.75).abs() < 0.01,
        "{at:?}"
    );
}

/// One can drive from end to end, through a crossing, along a line without kinks.
#[test]
fn borregas_avenue_can_be_followed() {
    let Some((_, map)) = load("borregas_ave.base_map.bin") else {
        return;
    };
    let line = line(
        &map,
        &[
            "lane_20", "lane_55", "lane_27", "lane_19", "lane_31", "lane_45", "lane_15",
        ],
    );
    let samples = line.samples();
    assert!(samples.len() > 100);
    let sharpest = samples
        .iter()
        .map(|sample| sample.point.kappa.abs())
        .fold(0.0, f64::max);
    assert!(sharpest < 0.1, "straight on bends by {sharpest}");
}

#[test]
fn the_surveyed_clip_has_bike_lanes_and_turns() {
    let Some((data, map)) = load("hdmap_unit_test.base_map.bin") else {
        return;
    };
    let counts = [
        data.lanes.len(),
        data.roads.len(),
        data.junctions.len(),
        data.crosswalks.len(),
        data.signals.len(),
        data.stop_signs.len(),
        data.yield_signs.len(),
        data.clear_areas.len(),
        data.overlaps.len(),
    ];
    assert_eq!(counts, [11, 8, 1, 1, 1, 1, 1, 3, 21]);
    let (driving, biking) = (count(&map, LaneKind::Driving), count(&map, LaneKind::Biking));
    assert_eq!((driving.0, biking.0), (9, 2));
    assert!(
        (driving.1 + biking.1 - 540.0).abs() < 5.0,
        "{driving:?} {biking:?}"
    );
    assert_eq!(lanes(&data, |lane| lane.turn == Turn::UTurn), 2);
    assert_eq!(lanes(&data, |lane| lane.turn == Turn::RightTurn), 1);
    assert_eq!(lanes(&data, |lane| lane.kind == HdLaneKind::Biking), 2);
    let nameless = data.overlaps.iter().flat_map(|overlap| &overlap.objects);
    assert_eq!(nameless.filter(|object| object.kind.is_none()).count(), 1);
    for lane in map.lanes() {
        let limit = lane.points[0].speed_limit;
        let expected = [25.0 / 3.0, 40.0 / 3.0]
            .iter()
            .any(|known| (limit - known).abs() < 1e-9);
        assert!(
            if lane.kind == LaneKind::Biking {
                limit.is_infinite()
            } else {
                expected
            },
            "{limit}"
        );
        assert!(
            lane.points
                .iter()
                .all(|p| (0.67..2.0).contains(&p.left) && (0.67..2.0).contains(&p.right))
        );
    }
    // Beside a bike lane the surface for cars ends, whatever the outline of the road says.
    let at = named(&map, "773_1_-1").at(40.0);
    assert!((at.road_right - at.right).abs() < 1e-9);
    let right = Neighbour {
        side: Side::Right,
        reverse: false,
    };
    assert_eq!(named(&map, "200_1_-1").neighbour(right), None);
    assert_eq!(named(&map, "776_1_-1").neighbour(right), map.find("776_1_-2"));
}

/// Points every 0.2 m with millimetres of noise: as raw chords they would bend by 0.2 1/m.
#[test]
fn the_surveyed_clip_is_smooth() {
    let Some((_, map)) = load("hdmap_unit_test.base_map.bin") else {
        return;
    };
    for name in ["200_1_-1", "776_1_-1", "776_1_-2", "773_1_-2", "339_1_-1"] {
        let sharpest = named(&map, name)
            .points
            .iter()
            .map(|p| p.kappa.abs())
            .fold(0.0, f64::max);
        assert!(sharpest < 0.02, "{name} is straight but bends by {sharpest}");
    }
    let line = line(&map, &["200_1_-1", "339_1_-1", "773_1_-1"]);
    assert!(line.samples().len() > 100);
}

#[test]
fn the_garage_lane_is_text_and_its_routing_fits() {
    let Some((data, map)) = load("garage_map.base_map.txt") else {
        return;
    };
    let lane = &data.lanes[0];
    assert_eq!(
        (data.lanes.len(), lane.points.len(), lane.id.as_str()),
        (1, 783, "1_-1")
    );
    assert!((lane.length - 153.87).abs() < 0.01 && lane.speed_limit == Some(4.5));
    assert_eq!(
        (data.stop_signs.len(), data.overlaps.len(), data.roads.len()),
        (1, 1, 0)
    );
    let stop = data.overlaps[0]
        .objects
        .iter()
        .find_map(|object| match object.kind {
            Some(OverlapKind::Lane { start_s, .. }) => Some(start_s),
            _ => None,
        });
    assert!(stop.is_some_and(|s| (s - 152.58).abs() < 0.01), "{stop:?}");
    let lane = named(&map, "1_-1");
    assert_eq!(lane.mark(Side::Left, 50.0), BoundaryType::DottedYellow);
    assert_eq!(lane.mark(Side::Right, 50.0), BoundaryType::Curb);
    assert!(
        lane.points
            .iter()
            .all(|p| (1.62..1.76).contains(&p.left) && (1.62..1.76).contains(&p.right))
    );

    let Some(bytes) = bytes("garage_routing.pb.txt") else {
        return;
    };
    let routing = apollo::read_routing(&bytes).unwrap_or_else(|error| panic!("{error}"));
    let segment = &routing.roads[0].passages[0].segments[0];
    assert!(routing.roads[0].id.is_empty() && routing.roads[0].passages[0].can_exit);
    assert_eq!(
        (segment.lane.as_str(), segment.start_s, segment.end_s),
        ("1_-1", 0.0, 153.0)
    );
    assert_eq!(routing.waypoints.len(), 2);
    assert!(segment.end_s < lane.length());
}

#[test]
fn the_sunnyvale_routing_changes_lanes() {
    let Some(bytes) = bytes("sample_sunnyvale_loop_routing.pb.txt") else {
        return;
    };
    let routing = apollo::read_routing(&bytes).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((routing.roads.len(), routing.waypoints.len()), (1, 4));
    let passages = &routing.roads[0].passages;
    let changes: Vec<_> = passages
        .iter()
        .map(|passage| (passage.change_lane_type, passage.can_exit))
        .collect();
    let expected = [
        (ChangeLaneType::Right, false),
        (ChangeLaneType::Left, false),
        (ChangeLaneType::Right, false),
        (ChangeLaneType::Forward, true),
    ];
    assert_eq!(changes, expected);
    let mut names: Vec<&str> = passages
        .iter()
        .flat_map(|passage| &passage.segments)
        .map(|segment| segment.lane.as_str())
        .collect();
    assert_eq!(names.len(), 18);
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), 17);
    assert!((passages[0].segments[0].start_s - 47.517_420_749_7).abs() < 1e-9);
}

/// A scenario names the map by its path; the trace of a run holds it as text and finds the same map again.
#[test]
fn scenarios_run_on_binary_and_text_maps() {
    for (file, lane) in [
        ("borregas_ave.base_map.bin", "lane_25"),
        ("garage_map.base_map.txt", "1_-1"),
    ] {
        if map_file("apollo").is_none() {
            return;
        }
        let text = format!(
            "description = \"Follow the lane.\"\nmap = \"$MAPS/apollo/{file}\"\ncruise_speed = 4.0\ntimeout = 30.0\n\
             [ego]\nlane = \"{lane}\"\ns = 20.0\n[expect]\noutcome = \"progress\"\ndistance = 50.0\n"
        );
        let family =
            Family::parse(&text, "here.toml", Path::new(".")).unwrap_or_else(|error| panic!("{error}"));
        family.draw(1).unwrap_or_else(|error| panic!("{error}"));
        let again = corridor_scenarios::MapCache::holding(family.map_text())
            .unwrap_or_else(|error| panic!("{error}"));
        let copy = Family::parse_with(&text, "here.toml", Path::new("."), &again)
            .unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(copy.map().lanes(), family.map().lanes());
    }
}
