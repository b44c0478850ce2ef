//! Tests of the road map: what it refuses, and what it answers, against searches by hand.

use super::{
    BoundaryType, JunctionId, Lane, LaneId, LaneKind, LanePoint, MapError, Mark, Neighbour, RoadMap, Side,
};
use crate::geometry::{Vec2, angle};
use proptest::prelude::*;

/// A straight lane from a point along a heading, 3 m wide.
fn lane(name: &str, from: (f64, f64), theta: f64, length: f64) -> Lane {
    let (sin, cos) = angle::sin_cos(theta);
    let count = (0..).take_while(|k| f64::from(*k) * 0.5 <= length);
    let point = |k: i32| {
        let s = f64::from(k) * 0.5;
        LanePoint {
            s,
            x: from.0 + cos * s,
            y: from.1 + sin * s,
            theta,
            kappa: 0.0,
            left: 1.5,
            right: 1.5,
            road_left: 1.5,
            road_right: 1.5,
            speed_limit: 13.9,
        }
    };
    Lane {
        name: name.to_owned(),
        kind: LaneKind::Driving,
        road: "r".to_owned(),
        junction: None,
        points: count.map(point).collect(),
        left_marks: Vec::new(),
        right_marks: Vec::new(),
        neighbours: [None; 4],
        predecessors: Vec::new(),
        successors: Vec::new(),
    }
}

/// What a map of one lane, spoilt by `change`, is refused for.
fn refusal(change: impl FnOnce(&mut Lane)) -> String {
    let mut spoilt = lane("a", (0.0, 0.0), 0.0, 10.0);
    change(&mut spoilt);
    match RoadMap::new(vec![spoilt], Vec::new()) {
        Ok(_) => "nothing".to_owned(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn broken_lanes_are_refused_by_name() {
    assert_eq!(refusal(|_| ()), "nothing");
    let cases: [(&str, String); 11] = [
        ("at least two", refusal(|it| it.points.truncate(1))),
        ("not finite", refusal(|it| it.points[3].x = f64::NAN)),
        ("not finite", refusal(|it| it.points[3].kappa = f64::INFINITY)),
        ("negative width", refusal(|it| it.points[3].left = -0.1)),
        (
            "negative width",
            refusal(|it| it.points[3].speed_limit = f64::NAN),
        ),
        ("must increase", refusal(|it| it.points[3].s = it.points[2].s)),
        (
            "lane that does not exist",
            refusal(|it| it.successors = vec![LaneId(1)]),
        ),
        (
            "lane that does not exist",
            refusal(|it| it.neighbours[2] = Some(LaneId(7))),
        ),
        (
            "junction that does not exist",
            refusal(|it| it.junction = Some(JunctionId(0))),
        ),
        ("a kilometre", refusal(|it| it.points[3].y = 2e3)),
        ("a kilometre", refusal(|it| it.points[3].left = 2e3)),
    ];
    for (wanted, message) in cases {
        assert!(
            message.contains(wanted) && message.contains("`a`"),
            "{message:?} does not say {wanted:?}"
        );
    }
    assert!(refusal(|it| it.points.iter_mut().for_each(|p| p.x += 1e12)).contains("origin"));
    assert!(refusal(|it| it.kind = LaneKind::Sidewalk).contains("no drivable lane"));
    let twice = vec![lane("a", (0.0, 0.0), 0.0, 5.0), lane("a", (0.0, 9.0), 0.0, 5.0)];
    assert_eq!(
        RoadMap::new(twice, Vec::new()).unwrap_err(),
        MapError::DuplicateName("a".to_owned())
    );
}

#[test]
fn lanes_are_found_by_name_and_by_neighbourhood() {
    let mut right = lane("right", (0.0, 0.0), 0.0, 20.0);
    let left = lane("left", (0.0, 3.0), 0.0, 20.0);
    let kind = Neighbour {
        side: Side::Left,
        reverse: false,
    };
    right.neighbours[kind.index()] = Some(LaneId(1));
    let map = RoadMap::new(vec![right, left], Vec::new()).unwrap();
    assert_eq!(map.find("left"), Some(LaneId(1)));
    assert_eq!(map.find("none"), None);
    assert_eq!(map.neighbour(LaneId(0), kind), Some(LaneId(1)));
    assert_eq!(map.neighbour(LaneId(1), kind), None);
    for (place, kind) in Neighbour::ALL.iter().enumerate() {
        assert_eq!(kind.index(), place);
    }
}

#[test]
fn cross_sections_are_linear_between_samples_and_held_beyond() {
    let mut lane = lane("a", (0.0, 0.0), 0.0, 10.0);
    lane.points[4].left = 2.5;
    let at = lane.at(1.75);
    assert!((at.s - 1.75).abs() < 1e-12 && (at.x - 1.75).abs() < 1e-12 && (at.left - 2.0).abs() < 1e-12);
    assert_eq!((lane.at(-3.0).s, lane.at(-3.0).x), (0.0, 0.0));
    assert_eq!((lane.at(99.0).s, lane.at(99.0).x), (10.0, 10.0));
    assert_eq!(lane.at(99.0).offset(-1.0), Vec2::new(10.0, -1.0));
}

#[test]
fn marks_hold_from_their_station_on() {
    let mut lane = lane("a", (0.0, 0.0), 0.0, 10.0);
    let mark = |s, kind| Mark { s, kind };
    lane.left_marks = vec![
        mark(0.0, BoundaryType::DottedWhite),
        mark(4.0, BoundaryType::SolidWhite),
    ];
    let left = |s| lane.mark(Side::Left, s);
    assert_eq!(left(-1.0), BoundaryType::DottedWhite);
    assert_eq!(left(3.99), BoundaryType::DottedWhite);
    assert_eq!(left(4.0), BoundaryType::SolidWhite);
    assert_eq!(left(99.0), BoundaryType::SolidWhite);
    assert_eq!(lane.mark(Side::Right, 4.0), BoundaryType::Unknown);
}

/// Nearest of many points of the lanes that go the wanted way.
fn nearest_by_brute_force(lanes: &[Lane], point: Vec2, theta: f64) -> f64 {
    let agrees = |lane: &&Lane| angle::difference(lane.points[0].theta, theta).abs() <= 0.5;
    let distance = |lane: &Lane| {
        let count = 2000;
        (0..=count)
            .map(|k| lane.at(lane.length() * f64::from(k) / f64::from(count)))
            .map(|at| (point - Vec2::new(at.x, at.y)).norm())
            .fold(f64::INFINITY, f64::min)
    };
    lanes
        .iter()
        .filter(agrees)
        .map(distance)
        .fold(f64::INFINITY, f64::min)
}

proptest! {
    /// The nearest lane is nearest of those that go the wanted way, and its station and offset lead to it.
    #[test]
    fn the_nearest_lane_is_nearest(
        starts in prop::collection::vec((-40.0..40.0_f64, -40.0..40.0_f64, -3.1..3.1_f64, 2.0..40.0_f64), 1..8),
        x in -60.0..60.0_f64,
        y in -60.0..60.0_f64,
        theta in -3.1..3.1_f64,
        radius in 1.0..30.0_f64,
    ) {
        let lanes: Vec<Lane> = (0..).zip(&starts)
            .map(|(k, (x, y, theta, length))| lane(&format!("l{k}"), (*x, *y), *theta, *length))
            .collect();
        let map = RoadMap::new(lanes.clone(), Vec::new()).unwrap();
        let point = Vec2::new(x, y);
        let nearest = nearest_by_brute_force(&lanes, point, theta);
        match map.nearest_lane(point, radius, theta, 0.5) {
            None => prop_assert!(nearest > radius - 1e-3, "one is {nearest} away, {radius} wanted"),
            Some((id, s, l)) => {
                let at = map.lane(id).at(s);
                let distance = (point - Vec2::new(at.x, at.y)).norm();
                prop_assert!(distance <= radius + 1e-9 && distance <= nearest + 1e-9, "{distance} {nearest}");
                prop_assert!(angle::difference(at.theta, theta).abs() <= 0.5 + 1e-12);
                let inside = s > 0.0 && s < map.lane(id).length();
                prop_assert!(!inside || (at.offset(l) - point).norm() < 1e-9);
            }
        }
    }
}

#[test]
fn no_number_makes_a_question_panic() {
    let map = RoadMap::new(vec![lane("a", (0.0, 0.0), 0.0, 10.0)], Vec::new()).unwrap();
    for v in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300] {
        let point = Vec2::new(v, 1.0);
        assert_eq!(map.nearest_lane(point, 5.0, 0.0, 1.0), None);
        assert!(map.lanes_at(point).is_empty());
        assert!(map.distance_off_road(point) > 0.0, "{v} is not on the road");
    }
}
