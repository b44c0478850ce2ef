//! Hand-made lanelets against what can be worked out on paper.

use super::{Lanelet, build};
use crate::import::ImportError;
use crate::import::notes::Notes;
use crate::import::xml::{Element, Lines};
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::reference_line::{LineQuery, ReferenceLine};
use corridor_decider::road::{BoundaryType, Lane, LaneId, LaneKind, Neighbour, RoadMap, Side};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

fn lanelet(name: &str, left: &[(f64, f64)], right: &[(f64, f64)]) -> Lanelet {
    let points = |list: &[(f64, f64)]| list.iter().map(|(x, y)| Vec2::new(*x, *y)).collect();
    Lanelet {
        name: name.to_owned(),
        kind: LaneKind::Driving,
        left: points(left),
        right: points(right),
        left_mark: BoundaryType::Unknown,
        right_mark: BoundaryType::Unknown,
        neighbours: [None; 4],
        predecessors: Vec::new(),
        successors: Vec::new(),
        speed_limit: None,
        junction: None,
    }
}

/// The map, with the warnings.
fn built(lanelets: &[Lanelet]) -> (Result<RoadMap, ImportError>, Vec<String>) {
    let lines = Lines::new("<osm/>", "osm");
    let document = lines.parse().unwrap();
    let place = Element::root(&document, &lines, "osm").unwrap().place();
    let mut notes = Notes::new(&lines);
    let places = vec![place; lanelets.len()];
    let map = build(lanelets, vec!["crossing".to_owned()], &places, &mut notes);
    (map, notes.into_warnings())
}

fn map(lanelets: &[Lanelet]) -> RoadMap {
    built(lanelets).0.unwrap()
}

/// Points of a circle around the origin, from the positive x axis on, counter-clockwise.
fn arc(radius: f64, turn: f64, count: u32) -> Vec<(f64, f64)> {
    let at = |k| {
        let (sin, cos) = angle::sin_cos(turn * f64::from(k) / f64::from(count - 1));
        (radius * cos, radius * sin)
    };
    (0..count).map(at).collect()
}

const LEFT: Neighbour = Neighbour {
    side: Side::Left,
    reverse: false,
};
const RIGHT: Neighbour = Neighbour {
    side: Side::Right,
    reverse: false,
};
const ONCOMING: Neighbour = Neighbour {
    side: Side::Left,
    reverse: true,
};

fn worst(lane: &Lane, off: impl Fn(&corridor_decider::road::LanePoint) -> f64) -> f64 {
    lane.points.iter().map(|p| off(p).abs()).fold(0.0, f64::max)
}

#[test]
fn a_straight_lanelet_of_different_point_counts() {
    let left = [(0.0, 4.0), (13.0, 4.0), (13.0, 4.0), (40.0, 4.0)];
    let map = map(&[lanelet("a", &left, &[(0.0, 0.0), (40.0, 0.0)])]);
    let lane = &map.lanes()[0];
    assert!((lane.length() - 40.0).abs() < 1e-9);
    assert_eq!(lane.points.len(), 81);
    assert!(worst(lane, |p| p.y - 2.0) < 1e-9);
    assert!(worst(lane, |p| p.left - 2.0) < 1e-9 && worst(lane, |p| p.right - 2.0) < 1e-9);
    assert!(worst(lane, |p| p.theta) < 1e-9 && worst(lane, |p| p.kappa) < 1e-9);
}

#[test]
fn coarse_chords_of_a_bend_give_its_heading_and_curvature() {
    // Radius 28, chords of 7 m outside and 5 m inside: the polyline turns in steps of 15 degrees.
    let map = map(&[lanelet("a", &arc(26.0, PI, 15), &arc(30.0, PI, 13))]);
    let lane = &map.lanes()[0];
    assert!((lane.length() - 28.0 * PI).abs() < 0.2, "{}", lane.length());
    for p in &lane.points {
        let (radius, turn) = (libm::hypot(p.x, p.y), libm::atan2(p.y, p.x));
        assert!((radius - 28.0).abs() < 0.08, "{radius} at {}", p.s);
        let off = angle::difference(p.theta, turn + FRAC_PI_2);
        assert!(off.abs() < 0.02, "heading {off} off at {}", p.s);
        assert!(
            (p.kappa * 28.0 - 1.0).abs() < 0.25,
            "radius {} at {}",
            1.0 / p.kappa,
            p.s
        );
        // Chords lie within the outer circle by up to 26 cm.
        assert!((1.8..2.3).contains(&p.left) && (1.6..2.2).contains(&p.right));
    }
}

#[test]
fn a_wedge_opens_from_nothing() {
    let left = [(0.0, 0.0), (30.0, 3.0), (60.0, 3.0)];
    let map = map(&[lanelet("a", &left, &[(0.0, 0.0), (60.0, 0.0)])]);
    let lane = &map.lanes()[0];
    assert!(lane.points[0].left + lane.points[0].right < 1e-6);
    for p in &lane.points {
        let expected = (p.x / 10.0).min(3.0);
        assert!(
            (p.left + p.right - expected).abs() < 0.08,
            "{} at {}",
            p.left + p.right,
            p.x
        );
        // Around the kink the left bound is taken for a bend of 150 m.
        assert!(
            (p.left - p.right).abs() < 0.3,
            "off the middle by {} at {}",
            p.left - p.right,
            p.x
        );
    }
}

#[test]
fn lanes_go_on_smoothly_through_a_polyline_cut_at_its_kinks() {
    // A bend of radius 50 in chords of 5 m, cut after every second chord.
    let (left, right) = (arc(48.0, 1.0, 11), arc(52.0, 1.0, 11));
    let mut lanelets: Vec<Lanelet> = (0..5)
        .map(|k| {
            lanelet(
                &format!("{k}"),
                &left[2 * k..=2 * k + 2],
                &right[2 * k..=2 * k + 2],
            )
        })
        .collect();
    for (k, lanelet) in lanelets.iter_mut().take(4).enumerate() {
        lanelet.successors = vec![k + 1];
    }
    let map = map(&lanelets);
    for pair in map.lanes().windows(2) {
        assert_eq!(pair[1].predecessors.len(), 1);
        let (end, start) = (pair[0].points.last().unwrap(), &pair[1].points[0]);
        assert!(libm::hypot(end.x - start.x, end.y - start.y) < 1e-9);
        assert!(angle::difference(end.theta, start.theta).abs() < 1e-12);
        assert!((end.kappa - start.kappa).abs() < 1e-12);
    }
    for p in map.lanes().iter().flat_map(|lane| &lane.points) {
        assert!(
            (p.kappa * 50.0 - 1.0).abs() < 0.3,
            "radius {} at {}",
            1.0 / p.kappa,
            p.s
        );
    }
}

#[test]
fn through_traffic_is_straight_where_a_lane_forks() {
    let mut before = lanelet("before", &[(-20.0, 4.0), (0.0, 4.0)], &[(-20.0, 0.0), (0.0, 0.0)]);
    before.successors = vec![1, 2];
    let on = lanelet("on", &[(0.0, 4.0), (20.0, 4.0)], &[(0.0, 0.0), (20.0, 0.0)]);
    let off = lanelet(
        "off",
        &[(0.0, 4.0), (4.0, 2.0), (6.0, -6.0)],
        &[(0.0, 0.0), (2.0, -6.0)],
    );
    let map = map(&[before, on, off]);
    assert_eq!(map.lanes()[0].successors.len(), 2);
    for lane in &map.lanes()[..2] {
        assert!(
            worst(lane, |p| p.y - 2.0) < 0.02,
            "{}",
            worst(lane, |p| p.y - 2.0)
        );
    }
    for next in [LaneId(1), LaneId(2)] {
        ReferenceLine::along(&map, &[LaneId(0), next]).unwrap();
    }
}

#[test]
fn the_road_is_what_lies_side_by_side() {
    // From left to right: oncoming lane, own lane, hard shoulder, cycle path.
    let line = |y: f64| [(0.0, y), (50.0, y)];
    let back = |y: f64| [(50.0, y), (0.0, y)];
    let mut own = lanelet("own", &line(3.0), &line(0.0));
    own.neighbours[ONCOMING.index()] = Some(1);
    own.neighbours[RIGHT.index()] = Some(2);
    let oncoming = lanelet("oncoming", &back(3.0), &back(6.5));
    let mut shoulder = lanelet("shoulder", &line(0.0), &line(-2.0));
    shoulder.kind = LaneKind::Stop;
    shoulder.neighbours[RIGHT.index()] = Some(3);
    let mut path = lanelet("path", &line(-2.0), &line(-4.0));
    path.kind = LaneKind::Biking;
    let map = map(&[own, oncoming, shoulder, path]);
    let [own, oncoming, shoulder, path] = map.lanes() else {
        panic!("four lanes")
    };
    assert_eq!(own.neighbour(ONCOMING), Some(LaneId(1)));
    assert_eq!(oncoming.neighbour(ONCOMING), Some(LaneId(0)));
    assert_eq!(own.neighbour(RIGHT), None, "no drivable lane");
    assert!(worst(own, |p| p.road_left - 5.0) < 1e-6 && worst(own, |p| p.road_right - 3.5) < 1e-6);
    assert!(
        worst(oncoming, |p| p.road_left - 6.75) < 1e-6 && worst(oncoming, |p| p.road_right - 1.75) < 1e-6
    );
    assert!(worst(shoulder, |p| p.road_left - 7.5) < 1e-6);
    assert!(worst(path, |p| p.road_left - 1.0) < 1e-6);
    assert_eq!(own.road, shoulder.road);
    assert!(map.distance_off_road(Vec2::new(25.0, 6.6)) > 0.05);
}

#[test]
fn neighbours_that_only_one_side_names_are_mutual() {
    let line = |y: f64| [(0.0, y), (50.0, y)];
    let a = lanelet("a", &line(3.0), &line(0.0));
    let mut b = lanelet("b", &line(6.0), &line(3.0));
    b.neighbours[RIGHT.index()] = Some(0);
    // A third one claims a's left side too, and something that is not there.
    let mut c = lanelet("c", &line(6.0), &line(3.0));
    c.neighbours[RIGHT.index()] = Some(0);
    c.neighbours[LEFT.index()] = Some(77);
    c.successors = vec![99];
    let (map, warnings) = built(&[a, b, c]);
    let map = map.unwrap();
    assert_eq!(map.lanes()[0].neighbour(LEFT), Some(LaneId(1)));
    assert_eq!(map.lanes()[2].neighbours, [None; 4]);
    assert_eq!(warnings.len(), 1, "{warnings:?}");
}

#[test]
fn the_far_edge_of_an_oncoming_lane_is_looked_up_from_its_end() {
    let mut own = lanelet("own", &[(0.0, 3.0), (100.0, 3.0)], &[(0.0, 0.0), (100.0, 0.0)]);
    own.neighbours[ONCOMING.index()] = Some(1);
    // It is 3 m wide where it begins, at x = 100, and 8 m where it ends.
    let oncoming = lanelet(
        "oncoming",
        &[(100.0, 3.0), (0.0, 3.0)],
        &[(100.0, 6.0), (0.0, 11.0)],
    );
    let map = map(&[own, oncoming]);
    assert!(worst(&map.lanes()[0], |p| p.road_left - (9.5 - 0.05 * p.x)) < 1e-6);
}

#[test]
fn links_between_lanes_that_do_not_meet_are_told() {
    let mut a = lanelet("a", &[(0.0, 4.0), (9.0, 4.0)], &[(0.0, 0.0), (9.0, 0.0)]);
    a.successors = vec![1];
    let b = lanelet("b", &[(12.0, 4.0), (20.0, 4.0)], &[(12.0, 0.0), (20.0, 0.0)]);
    let (map, warnings) = built(&[a, b]);
    assert!(map.unwrap().lanes()[0].successors.is_empty());
    assert!(warnings[0].contains("lanelet `a`: linked lanelets that do not meet"));
}

#[test]
fn a_fifth_of_a_metre_survives_and_nothing_does_not() {
    let mut lanelets = vec![
        lanelet("a", &[(0.0, 4.0), (10.0, 4.0)], &[(0.0, 0.0), (10.0, 0.0)]),
        lanelet("b", &[(10.0, 4.0), (10.2, 4.0)], &[(10.0, 0.0), (10.2, 0.0)]),
        lanelet("c", &[(10.2, 4.0), (30.0, 4.0)], &[(10.2, 0.0), (30.0, 0.0)]),
        lanelet("nothing", &[(0.0, 4.0); 2], &[(0.0, 0.0); 2]),
        lanelet("flat", &[(0.0, 0.0), (9.0, 0.0)], &[(0.0, 0.0), (9.0, 0.0)]),
    ];
    (lanelets[0].successors, lanelets[1].successors) = (vec![1, 3], vec![2]);
    lanelets[2].junction = Some(0);
    let (map, warnings) = built(&lanelets);
    let map = map.unwrap();
    assert_eq!(map.lanes().len(), 3);
    assert!((map.lanes()[1].length() - 0.2).abs() < 1e-9);
    assert_eq!(map.lanes()[0].successors, [LaneId(1)]);
    assert!(map.lanes()[2].junction.is_some());
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    let line = ReferenceLine::along(&map, &[LaneId(0), LaneId(1), LaneId(2)]).unwrap();
    assert!((line.length() - 30.0).abs() < 1e-9);
}

#[test]
fn a_mirrored_file_gives_the_mirrored_map() {
    let (left, right) = (arc(20.0, 1.3, 9), arc(24.0, 1.3, 6));
    let mirrored = |points: &[(f64, f64)]| points.iter().map(|(x, y)| (*x, -y)).collect::<Vec<_>>();
    let one = map(&[lanelet("a", &left, &right)]);
    let other = map(&[lanelet("a", &mirrored(&right), &mirrored(&left))]);
    for (p, q) in one.lanes()[0].points.iter().zip(&other.lanes()[0].points) {
        assert!((p.x - q.x).abs() < 1e-9 && (p.y + q.y).abs() < 1e-9);
        assert!((p.kappa + q.kappa).abs() < 1e-9 && (p.left - q.right).abs() < 1e-9);
    }
}

#[test]
fn a_map_that_would_never_end_is_refused() {
    let long = lanelet("a", &[(0.0, 4.0), (1e8, 4.0)], &[(0.0, 0.0), (1e8, 0.0)]);
    assert!(matches!(built(&[long]).0, Err(ImportError::TooLarge { .. })));
    let wide: Vec<Lanelet> = (0..200)
        .map(|k| {
            lanelet(
                &format!("{k}"),
                &[(0.0, 900.0), (90.0, 900.0)],
                &[(0.0, 0.0), (90.0, 0.0)],
            )
        })
        .collect();
    assert!(matches!(built(&wide).0, Err(ImportError::TooLarge { .. })));
    let overflow = lanelet("a", &[(-1e300, 0.0), (1e300, 0.0)], &[(0.0, 0.0), (1.0, 0.0)]);
    assert!(matches!(built(&[overflow]).0, Err(ImportError::TooLarge { .. })));
}

proptest! {
    /// Whatever the points and links are: an answer, and a sound one.
    #[test]
    fn any_points_and_links_give_an_answer(
        bounds in prop::collection::vec(
            (prop::collection::vec((-30.0..30.0, -30.0..30.0), 0..6),
             prop::collection::vec((-30.0..30.0, -30.0..30.0), 0..6)), 1..6),
        links in prop::collection::vec((0usize..7, 0usize..7, 0usize..4), 0..12),
    ) {
        let mut lanelets: Vec<Lanelet> = bounds.iter().enumerate()
            .map(|(k, (left, right))| lanelet(&k.to_string(), left, right)).collect();
        let count = lanelets.len();
        for (from, to, kind) in links {
            lanelets[from % count].successors.push(to);
            lanelets[to % count].predecessors.push(from);
            lanelets[from % count].neighbours[kind] = Some(to);
        }
        if let (Ok(map), _) = built(&lanelets) {
            for (number, lane) in (0u32..).zip(map.lanes()) {
                for kind in Neighbour::ALL {
                    let back = Neighbour { side: if kind.reverse { kind.side } else { kind.side.opposite() }, ..kind };
                    if let Some(other) = lane.neighbour(kind) {
                        prop_assert_eq!(map.neighbour(other, back), Some(LaneId(number)));
                    }
                }
                for p in &lane.points {
                    prop_assert!(p.road_left >= p.left && p.road_right >= p.right);
                }
            }
        }
    }
}
