//! Lines along lanes: joins, lengths, and what cannot be a line.

use crate::geometry::{Vec2, angle};
use crate::reference_line::{LineError, LineQuery, LineSample, ReferenceLine};
use crate::road::{BoundaryType, Junction, JunctionId, Lane, LaneId, LaneKind, LanePoint, Mark, RoadMap};
use std::f64::consts::TAU;

/// A lane of constant curvature through the given stations.
fn lane(name: &str, from: (f64, f64), kappa: f64, stations: &[f64]) -> Lane {
    let point = |s: &f64| {
        let (sin, cos) = angle::sin_cos(kappa * s);
        let (x, y) = if kappa.abs() > 0.0 {
            (sin / kappa, (1.0 - cos) / kappa)
        } else {
            (*s, 0.0)
        };
        LanePoint {
            s: *s,
            x: from.0 + x,
            y: from.1 + y,
            theta: angle::wrap(kappa * s),
            kappa,
            left: 1.75,
            right: 1.75,
            road_left: 5.0,
            road_right: 2.0,
            speed_limit: f64::INFINITY,
        }
    };
    Lane {
        name: name.to_owned(),
        kind: LaneKind::Driving,
        road: "r".to_owned(),
        junction: None,
        points: stations.iter().map(point).collect(),
        left_marks: Vec::new(),
        right_marks: Vec::new(),
        neighbours: [None; 4],
        predecessors: Vec::new(),
        successors: Vec::new(),
    }
}

fn half_metres(count: u32) -> Vec<f64> {
    (0..=count).map(|k| f64::from(k) * 0.5).collect()
}

fn map(lanes: Vec<Lane>) -> RoadMap {
    let junctions = vec![Junction { name: "j".to_owned() }];
    RoadMap::new(lanes, junctions).unwrap()
}

#[test]
fn lines_without_length_are_refused() {
    for stations in [[0.0, 0.0005], [0.0, 0.09]] {
        let map = map(vec![lane("a", (0.0, 0.0), 0.0, &stations)]);
        let refused = ReferenceLine::along(&map, &[LaneId(0)]);
        assert!(matches!(refused, Err(LineError::TooShort { .. })), "{refused:?}");
    }
    let map = map(vec![lane("a", (0.0, 0.0), 0.0, &[0.0, 0.11])]);
    let line = ReferenceLine::along(&map, &[LaneId(0)]).unwrap();
    assert!((line.point(0.05).x - 0.05).abs() < 1e-12);
    assert_eq!(ReferenceLine::along(&map, &[]), Err(LineError::Empty));
}

/// A lane of less than a millimetre between two others is passed over.
#[test]
fn a_short_lane_in_between_does_no_harm() {
    let map = map(vec![
        lane("a", (0.0, 0.0), 0.0, &half_metres(20)),
        lane("b", (10.0, 0.0), 0.0, &[0.0, 0.0004]),
        lane("c", (10.0004, 0.0), 0.0, &half_metres(20)),
    ]);
    let line = ReferenceLine::along(&map, &[LaneId(0), LaneId(1), LaneId(2)]).unwrap();
    assert!((line.length() - 20.0).abs() < 1e-3);
    assert_eq!(line.sample_at(10.01).lane, LaneId(2));
}

#[test]
fn lanes_that_do_not_meet_are_refused() {
    let with_gap = |gap: f64| {
        let map = map(vec![
            lane("a", (0.0, 0.0), 0.0, &half_metres(20)),
            lane("b", (10.0 + gap, 0.0), 0.0, &half_metres(20)),
        ]);
        ReferenceLine::along(&map, &[LaneId(0), LaneId(1)])
    };
    assert!(with_gap(0.49).is_ok());
    match with_gap(0.51) {
        Err(LineError::Gap { from, to, gap }) => {
            assert_eq!((from.as_str(), to.as_str()), ("a", "b"));
            assert!((gap - 0.51).abs() < 1e-9);
        }
        other => panic!("{other:?}"),
    }
}

/// From the first station of the next lane on, that lane's lines, widths and limits rule.
#[test]
fn the_next_lane_rules_from_its_first_station_on() {
    let mark = |kind| vec![Mark { s: 0.0, kind }];
    let mut a = lane("a", (0.0, 0.0), 0.0, &half_metres(20));
    let mut b = lane("b", (10.0, 0.0), 0.0, &half_metres(20));
    (a.left_marks, b.left_marks) = (mark(BoundaryType::DottedWhite), mark(BoundaryType::SolidWhite));
    for point in &mut b.points {
        point.speed_limit = 8.0;
    }
    b.junction = Some(JunctionId(0));
    let c = lane("c", (20.0, 0.0), 0.0, &half_metres(20));
    let map = map(vec![a, b, c]);
    let line = ReferenceLine::along(&map, &[LaneId(0), LaneId(1), LaneId(2)]).unwrap();
    let rules = |s: f64| {
        let at = line.sample_at(s);
        (at.lane, at.marks.0, at.speed_limit)
    };
    assert_eq!(rules(9.99), (LaneId(0), BoundaryType::DottedWhite, None));
    assert_eq!(rules(10.0), (LaneId(1), BoundaryType::SolidWhite, Some(8.0)));
    assert_eq!(rules(19.99).0, LaneId(1));
    assert_eq!(rules(20.0), (LaneId(2), BoundaryType::Unknown, None));
    assert!((line.length() - 30.0).abs() < 1e-9);
    // Both ends of the junction are in it.
    for (s, inside) in [
        (9.5, false),
        (10.0, true),
        (15.0, true),
        (20.0, true),
        (20.5, false),
    ] {
        assert_eq!(line.near_junction(s, 1e-6), inside, "{s}");
    }
    assert!(line.near_junction(9.0, 1.0) && !line.near_junction(8.9, 1.0));
    assert!(line.near_junction(21.0, 1.0) && !line.near_junction(21.1, 1.0));
}

/// Stations are arc lengths, though samples are chords apart: a full circle of 6 m radius to a tenth of a
/// millimetre.
#[test]
fn stations_are_arc_lengths() {
    let length = 6.0 * TAU * 0.99;
    let stations: Vec<f64> = (0..=75).map(|k| f64::from(k) * length / 75.0).collect();
    let map = map(vec![lane("a", (0.0, 0.0), 1.0 / 6.0, &stations)]);
    let line = ReferenceLine::along(&map, &[LaneId(0)]).unwrap();
    assert!(
        (line.length() - length).abs() < 1e-4,
        "{} is not {length}",
        line.length()
    );
    for k in 0..370 {
        let s = f64::from(k) * 0.1;
        let (sin, cos) = angle::sin_cos(s / 6.0);
        let at = line.point(s);
        let off = (Vec2::new(at.x, at.y) - Vec2::new(6.0 * sin, 6.0 * (1.0 - cos))).norm();
        assert!(off < 2e-4, "{off} m off the circle at {s}");
    }
}

/// What a file says is checked before anyone asks it.
#[test]
fn a_written_line_is_checked() {
    let map = map(vec![lane("a", (0.0, 0.0), 0.0, &half_metres(4))]);
    let line = ReferenceLine::along(&map, &[LaneId(0)]).unwrap();
    let good: Vec<LineSample> = line.clone().into();
    let read = |samples: &[LineSample]| {
        let text = serde_json::to_string(samples).unwrap();
        serde_json::from_str::<ReferenceLine>(&text).map_err(|error| error.to_string())
    };
    assert_eq!(read(&good), Ok(line));
    for (count, message) in [(0, "0 m long"), (1, "0 m long")] {
        assert!(read(&good[..count]).unwrap_err().contains(message));
    }
    let mut back = good.clone();
    back[2].s = 0.5;
    assert!(read(&back).unwrap_err().contains("cross-section 2"));
    let mut close = good[..2].to_vec();
    close[1].s = 0.05;
    assert!(read(&close).unwrap_err().contains("0.05 m long"));
}
