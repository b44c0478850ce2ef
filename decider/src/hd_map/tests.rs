//! Hand-made maps and what must hold on them.
#![expect(clippy::float_cmp, reason = "whole numbers on straight lanes are exact")]

use super::testing::{HALF_WIDTH, connect, lane, map, overlap, segment, two_lanes};
use super::*;
use crate::geometry::{ConvexPolygon, Pose, Vec2, angle};
use crate::reference_line::SlPoint;
use crate::road::{BoundaryType, Neighbour, Side};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

fn error(data: MapData) -> HdMapError {
    HdMap::new(data).unwrap_err()
}

#[test]
fn what_is_wrong_with_a_map_is_told() {
    assert_eq!(error(MapData::default()), HdMapError::NoLane);
    let change = |change: fn(&mut MapData)| {
        let mut data = two_lanes();
        change(&mut data);
        error(data).to_string()
    };
    let twice = change(|data| data.lanes.push(lane("left", &[(0.0, 0.0), (1.0, 0.0)])));
    assert_eq!(twice, "lane `left` is there twice");
    let short = change(|data| data.lanes[0].points.truncate(1));
    assert_eq!(short, "lane `aside` needs two points apart from each other");
    let infinite = change(|data| data.lanes[1].points[1].x = f64::INFINITY);
    assert_eq!(infinite, "points of `before` hold a number that is not finite");
    let endless = change(|data| data.lanes[1].points[1].x = 1e300);
    assert_eq!(endless, infinite);
    let unsorted = change(|data| data.lanes[1].left_samples = vec![(3.0, 1.0), (2.0, 1.0)]);
    assert_eq!(unsorted, "left widths of lane `before` are not sorted by station");
    let unknown = change(|data| {
        let section = SectionData {
            id: "s".to_owned(),
            lanes: vec!["gone".to_owned()],
            ..SectionData::default()
        };
        data.roads.push(RoadData {
            id: "r".to_owned(),
            sections: vec![section],
            ..RoadData::default()
        });
    });
    assert!(
        unknown.contains("section `s` of road `r` names lane `gone`"),
        "{unknown}"
    );
}

#[test]
fn links_to_what_was_cut_off_are_left_out() {
    let mut data = two_lanes();
    data.lanes[5].successors.push("gone".to_owned());
    data.lanes[5].overlaps.push("gone".to_owned());
    let map = map(data);
    let right_on = map.find("right on").unwrap();
    assert!(map.lane(right_on).successors().is_empty());
    assert_eq!(map.lane(right_on).data().successors, ["gone"]);
    assert_eq!(map.overlaps(right_on, ObjectKind::Lane).count(), 0);
}

#[test]
fn a_lane_answers_between_its_samples() {
    let mut bend = lane("bend", &[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)]);
    bend.left_samples = vec![(5.0, 1.0), (15.0, 2.0)];
    bend.left_boundary.types.push((12.0, vec![BoundaryType::Curb]));
    let map = map(MapData {
        lanes: vec![bend],
        ..MapData::default()
    });
    let bend = &map.lanes()[0];
    assert_eq!(bend.length(), 20.0);
    assert!((bend.heading_at(5.0) - FRAC_PI_2 / 2.0).abs() < 1e-12 && bend.heading_at(20.0005) == FRAC_PI_2);
    assert!((bend.curvature_at(5.0) - FRAC_PI_2 / 10.001).abs() < 1e-12 && bend.curvature_at(21.0) == 0.0);
    assert_eq!([0.0, 10.0, 30.0].map(|s| bend.width_at(s).0), [1.0, 1.5, 2.0]);
    assert_eq!(bend.effective_width_at(10.0), 3.0);
    let left = [-1.0, 3.0, 13.0].map(|s| bend.boundary_type_at(Side::Left, s));
    assert_eq!(
        left,
        [
            BoundaryType::Unknown,
            BoundaryType::DottedWhite,
            BoundaryType::Curb
        ]
    );
    assert!(bend.contains(Vec2::new(3.0, -1.7)) && !bend.contains(Vec2::new(3.0, -1.8)));
    assert!(!bend.contains(Vec2::new(-0.1, 0.0)));
}

#[test]
fn the_map_finds_what_is_near() {
    let mut data = two_lanes();
    data.junctions.push(Area {
        id: "crossing".to_owned(),
        polygon: [(90.0, -5.0), (110.0, -5.0), (110.0, 9.0), (90.0, 9.0)]
            .map(|(x, y)| Vec2::new(x, y))
            .to_vec(),
        ..Area::default()
    });
    let map = map(data);
    let name = |near: Option<NearLane>| near.map(|near| map.lane(near.lane).name());
    let at = Vec2::new(50.0, 1.9);
    assert_eq!(name(map.nearest_lane(at)), Some("left"));
    assert_eq!(name(map.nearest_lane_with_heading(at, 1.7, PI, 0.1)), None);
    assert_eq!(
        name(map.nearest_lane_with_heading(at, 1.7, 0.05, 0.1)),
        Some("left")
    );
    assert_eq!(map.objects_within(ObjectKind::Lane, at, 2.0), ["left", "right"]);
    assert_eq!(map.objects_within(ObjectKind::Junction, at, 40.0), ["crossing"]);
    assert!(map.objects_within(ObjectKind::Junction, at, 39.9).is_empty());
    // Beyond an end the offset is that from the lane's straight continuation.
    let beyond = map.nearest_lane(Vec2::new(203.0, -1.0)).unwrap();
    assert_eq!((beyond.s, beyond.l), (100.0, -1.0));
    assert!((beyond.distance - 10.0_f64.sqrt()).abs() < 1e-12);
    assert!(map.nearest_lane(Vec2::repeat(f64::NAN)).is_none());
}

/// Along `right` from 10 m on and 50 m of what follows.
fn straight(map: &Arc<HdMap>, quirks: PathQuirks) -> Path {
    let lanes = [
        segment(map, "right", 10.0, 100.0),
        segment(map, "right on", 0.0, 50.0),
    ];
    Path::along(map, &lanes, quirks).unwrap()
}

#[test]
fn a_line_knows_its_lanes() {
    let map = map(two_lanes());
    let line = straight(&map, PathQuirks::default());
    assert_eq!((line.length(), line.points().len()), (140.0, 3));
    let names = |s: f64| {
        line.lanes_at(s)
            .into_iter()
            .map(|id| map.lane(id).name())
            .collect::<Vec<_>>()
    };
    assert_eq!(names(90.0), ["right", "right on"], "the joint is on both");
    assert_eq!(names(89.0), ["right"]);
    assert_eq!(names(91.0), ["right on"]);
    assert_eq!(line.locate_lane(100.0), Some((1, 10.0)));
    let parts = line.lane_segments_between(80.0, 95.0);
    assert_eq!(
        parts,
        [
            segment(&map, "right", 90.0, 100.0),
            segment(&map, "right on", 0.0, 5.0)
        ]
    );
    let left = Neighbour {
        side: Side::Left,
        reverse: false,
    };
    assert_eq!(
        line.neighbour_at(left, 3.0),
        map.find("left").map(|left| (left, 2.0 * HALF_WIDTH))
    );
    assert_eq!(line.lane_width_at(140.0), Some((HALF_WIDTH, HALF_WIDTH)));
    assert!(line.lane_width_at(-1e-9).is_none() && line.lane_width_at(140.1).is_none());
}

#[test]
fn widths_count_from_the_line_and_not_from_the_lane() {
    let map = map(two_lanes());
    let middle = straight(&map, PathQuirks::default());
    let shifted = middle.points().iter().map(|point| PathPoint {
        position: point.position + Vec2::new(0.0, 0.5),
        waypoints: point
            .waypoints
            .iter()
            .map(|at| LaneWaypoint { l: 0.5, ..*at })
            .collect(),
        ..point.clone()
    });
    let line = Path::through(&map, shifted.collect(), PathQuirks::default()).unwrap();
    assert_eq!(line.lane_width_at(60.3), Some((1.25, 2.25)));
    assert!(line.is_on_lane(SlPoint { s: 60.3, l: 1.2 }) && !line.is_on_lane(SlPoint { s: 60.3, l: 1.3 }));
}

#[test]
fn parts_of_one_object_are_one_overlap() {
    let mut data = two_lanes();
    data.crosswalks.push(Area {
        id: "zebra".to_owned(),
        ..Area::default()
    });
    overlap(&mut data, "right", "zebra", (97.0, 99.0));
    overlap(&mut data, "right on", "zebra", (0.4, 3.0));
    let map = map(data);
    let line = straight(&map, PathQuirks::default());
    let [zebra] = line.overlaps(ObjectKind::Crosswalk) else {
        panic!("{:?}", line.overlaps(ObjectKind::Crosswalk));
    };
    assert_eq!((zebra.start_s, zebra.end_s), (87.0, 93.0));
    assert!(line.overlap_at(ObjectKind::Crosswalk, 86.5).is_some());
    assert!(line.first_encountered(ObjectKind::Crosswalk, 93.5).is_none());
}

#[test]
fn every_quirk_shows() {
    let mut data = two_lanes();
    data.lanes
        .push(lane("bend", &[(200.0, 0.0), (250.0, 0.0), (300.0, 50.0)]));
    connect(&mut data, "right on", "bend");
    data.crosswalks.push(Area {
        id: "zebra".to_owned(),
        ..Area::default()
    });
    overlap(&mut data, "right on", "zebra", (10.0, 12.0));
    let map = map(data);
    let lanes = [
        segment(&map, "right", 0.3, 100.0),
        segment(&map, "right on", 0.0, 50.0),
    ];
    let line = |quirks| Path::along(&map, &lanes, quirks).unwrap();
    let (right, wrong) = (line(PathQuirks::default()), line(PathQuirks::apollo()));
    let zebra = |line: &Path| line.overlaps(ObjectKind::Crosswalk)[0].start_s;
    assert!((zebra(&right) - 109.7).abs() < 1e-9 && (zebra(&wrong) - 110.0).abs() < 1e-9);
    let part = |line: &Path| line.lane_segments_between(20.0, 30.0);
    assert!((part(&right)[0].start_s - 20.3).abs() < 1e-9 && part(&right).len() == 1);
    assert_eq!(part(&wrong).len(), 2);
    let body = ConvexPolygon::rectangle(Pose::new(50.0, 0.1, 0.0), 2.0, 2.0, 1.0);
    assert!(right.has_overlap(&body) && !wrong.has_overlap(&body));
    let bend = [segment(&map, "bend", 0.0, 100.0)];
    let heading = |quirks| Path::along(&map, &bend, quirks).unwrap().point_at(25.0).heading;
    assert_eq!(heading(PathQuirks::apollo()), 0.0);
    assert!((heading(PathQuirks::default()) - PI / 8.0).abs() < 1e-12);
}

#[test]
fn frenet_and_back_returns_to_the_point() {
    let arc: Vec<(f64, f64)> = (0..200).map(|k| angle::sin_cos(f64::from(k) * 0.01)).collect();
    let arc: Vec<(f64, f64)> = arc
        .iter()
        .map(|(sin, cos)| (50.0 * sin, 50.0 - 50.0 * cos))
        .collect();
    let map = map(MapData {
        lanes: vec![lane("arc", &arc)],
        ..MapData::default()
    });
    let all = segment(&map, "arc", 0.0, 1e9);
    let line = Path::along(&map, &[all], PathQuirks::default()).unwrap();
    for k in 1..90 {
        let (s, l) = (f64::from(k) + 0.2, 2.0);
        let at = line.project(line.to_cartesian(s, l));
        // Headings of a lane are those of its chords, half a piece ahead of its arc.
        assert!((at.s - s).abs() < 0.03 && (at.l - l).abs() < 1e-3, "{s}: {at:?}");
    }
    let part = line.segment(50.0, 10.0, 20.0).unwrap();
    assert!((part.length() - 30.0).abs() < 1.0 && part.stations()[0] == 0.0);
    assert!(line.segment(50.0, 0.0, 0.1).is_err());
}

#[test]
fn a_body_beside_a_line_is_measured() {
    let map = map(two_lanes());
    let line = straight(&map, PathQuirks::default());
    let body = ConvexPolygon::rectangle(Pose::new(60.0, 2.0, 0.0), 2.0, 2.0, 0.5);
    let at = line.sl_box(&body);
    assert_eq!(
        (at.start_s, at.end_s, at.start_l, at.end_l),
        (48.0, 52.0, 1.5, 2.5)
    );
    assert!(line.is_box_on_lane(&at) && line.has_overlap(&body));
    assert_eq!(line.driving_width(&at), HALF_WIDTH + 1.5);
    assert!(line.is_blocked_by(&body, 1.5) && !line.is_blocked_by(&body, 1.4));
}

#[test]
fn a_line_that_is_none_is_told() {
    let map = map(two_lanes());
    let none = Path::along(&map, &[], PathQuirks::default()).unwrap_err();
    assert_eq!(none, PathError::TooFewPoints(0));
    let mut point = straight(&map, PathQuirks::default()).points()[0].clone();
    let twice = vec![point.clone(), point.clone()];
    assert_eq!(
        Path::through(&map, twice, PathQuirks::default()).unwrap_err(),
        PathError::TooFewPoints(2)
    );
    point.heading = f64::NAN;
    assert_eq!(
        Path::through(&map, vec![point], PathQuirks::default()).unwrap_err(),
        PathError::NotFinite(0)
    );
    let stranger = LaneSegment::new(crate::road::LaneId(77), 0.0, 1.0);
    assert_eq!(
        Path::along(&map, &[stranger], PathQuirks::default()).unwrap_err(),
        PathError::UnknownLane(77)
    );
}
