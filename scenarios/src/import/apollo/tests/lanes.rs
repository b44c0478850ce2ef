//! Centre lines and widths against worked numbers.

use super::{imported, lane, named, widths};
use corridor_decider::geometry::angle;
use corridor_decider::road::{BoundaryType, Lane, LaneKind, Side};

/// Points every `step` m along an arc from the origin towards +x, with noise that alternates.
fn arc(radius: f64, length: f64, step: f64, noise: f64) -> Vec<(f64, f64)> {
    let count = (length / step).round();
    let mut points = Vec::new();
    let mut k = 0.0;
    while k <= count {
        let turn = k * length / count / radius;
        let r = radius + if k % 2.0 < 1.0 { noise } else { -noise };
        points.push((r * libm::sin(turn), radius - r * libm::cos(turn)));
        k += 1.0;
    }
    points
}

/// Stations, headings and curvatures agree with the positions.
fn assert_smooth(lane: &Lane) {
    for pair in lane.points.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let (ds, turn) = (b.s - a.s, angle::difference(b.theta, a.theta));
        let chord = libm::atan2(b.y - a.y, b.x - a.x);
        assert!(angle::difference(chord, a.theta + 0.5 * turn).abs() < 2e-3);
        assert!((turn / ds - 0.5 * (a.kappa + b.kappa)).abs() < 0.01, "at {}", a.s);
        assert!(ds <= 0.51);
    }
}

#[test]
fn a_sparsely_drawn_bend_becomes_the_arc_through_its_points() {
    for (radius, step) in [(20.0, 5.0), (100.0, 20.0), (400.0, 40.0)] {
        let length = 8.0 * step;
        let (map, warnings) = imported(&lane("a", &arc(radius, length, step, 0.0), &widths(1.5, 2.0)));
        let lane = named(&map, "a");
        assert_smooth(lane);
        assert!(warnings.is_empty(), "{warnings:?}");
        assert!(
            (lane.length() - length).abs() < 0.02,
            "{} is not {length}",
            lane.length()
        );
        for point in &lane.points {
            let off = libm::hypot(point.x, point.y - radius) - radius;
            assert!(off.abs() < 0.01, "radius {radius}: {off} off at {}", point.s);
            assert!(
                (point.kappa * radius - 1.0).abs() < 0.05,
                "{} at {}",
                point.kappa,
                point.s
            );
        }
    }
}

/// Five millimetres from point to point 0.2 m apart would be a curvature of 0.5 1/m.
#[test]
fn a_surveyed_bend_is_smooth_in_spite_of_its_noise() {
    let radius = 30.0;
    let (map, _) = imported(&lane("a", &arc(radius, 50.0, 0.2, 0.005), &widths(1.5, 1.5)));
    let lane = named(&map, "a");
    assert_smooth(lane);
    for point in &lane.points {
        let off = libm::hypot(point.x, point.y - radius) - radius;
        assert!(off.abs() < 0.02, "{off} off at {}", point.s);
        // Both ends stay where they are, noise and all.
        let inside = point.s > 4.0 && point.s < 46.0;
        let tolerance = if inside { 0.003 } else { 0.05 };
        assert!(
            (point.kappa - 1.0 / radius).abs() < tolerance,
            "{} at {}",
            point.kappa,
            point.s
        );
    }
}

/// A hundred metres straight on, then a sharp bend in short pieces: the straight must not swing out.
#[test]
fn a_long_piece_beside_a_short_one_stays_straight() {
    let points = [(0.0, 0.0), (100.0, 0.0), (104.0, 0.8), (107.7, 2.4), (111.0, 4.7)];
    let (map, _) = imported(&lane("a", &points, &widths(1.5, 1.5)));
    for point in named(&map, "a").points.iter().filter(|point| point.x < 100.0) {
        assert!(point.y.abs() < 0.25, "{} at {}", point.y, point.x);
    }
}

#[test]
fn points_that_repeat_or_crowd_are_survived() {
    let points = [
        (0.0, 0.0),
        (0.0, 0.0),
        (1e-7, 0.0),
        (10.0, 0.0),
        (10.0, 0.0),
        (30.0, 0.0),
        (30.0, 1e-9),
    ];
    let (map, _) = imported(&lane("a", &points, &widths(1.5, 1.5)));
    let lane = named(&map, "a");
    assert_smooth(lane);
    assert!((lane.length() - 30.0).abs() < 1e-6);
    assert!(
        lane.points
            .iter()
            .all(|p| p.theta.abs() < 1e-6 && p.y.abs() < 1e-6)
    );
}

#[test]
fn widths_are_linear_between_samples_and_hold_beyond_them() {
    let samples =
        "left_sample { s: 10 width: 1 } left_sample { s: 20 width: 3 } right_sample { s: 0 width: 2 }";
    let (map, _) = imported(&lane("a", &[(0.0, 0.0), (30.0, 0.0)], samples));
    let lane = named(&map, "a");
    for (s, left) in [(0.0, 1.0), (10.0, 1.0), (12.5, 1.5), (20.0, 3.0), (30.0, 3.0)] {
        let at = lane.at(s);
        assert!(
            (at.left - left).abs() < 1e-9 && (at.right - 2.0).abs() < 1e-9,
            "{at:?}"
        );
        assert!(at.road_left >= at.left && at.road_right >= at.right);
    }
}

#[test]
fn without_samples_widths_are_measured_to_the_edges_or_assumed() {
    let left = super::curve(&[(-1.0, 1.0), (31.0, 3.0)]);
    let inside = format!("left_boundary {{ curve {{ {left} }} }}");
    let (map, warnings) = imported(&lane("a", &[(0.0, 0.0), (30.0, 0.0)], &inside));
    let at = named(&map, "a").at(15.0);
    assert!((at.left - 2.0).abs() < 1e-9, "{at:?}");
    assert!((at.right - 1.75).abs() < 1e-9);
    assert!(
        warnings[0].contains("lane `a`: no widths; they are measured to the edge"),
        "{warnings:?}"
    );
    assert!(
        warnings[1].contains("lane `a`: no widths and no edge; 1.75 m are assumed"),
        "{warnings:?}"
    );
}

#[test]
fn what_a_lane_is_for_how_fast_and_between_which_lines() {
    let marks = "boundary_type { s: 0 types: DOTTED_WHITE } boundary_type { s: 15 types: CURB }";
    let text = lane(
        "car",
        &[(0.0, 0.0), (30.0, 0.0)],
        &format!("speed_limit: 12.5 left_boundary {{ {marks} }} right_boundary {{ virtual: true {marks} }}"),
    ) + &lane(
        "bike",
        &[(0.0, -3.0), (30.0, -3.0)],
        "type: BIKING speed_limit: 0",
    );
    let (map, _) = imported(&text);
    let (car, bike) = (named(&map, "car"), named(&map, "bike"));
    assert_eq!((car.kind, bike.kind), (LaneKind::Driving, LaneKind::Biking));
    assert!((car.at(10.0).speed_limit - 12.5).abs() < 1e-12);
    assert!(
        bike.at(10.0).speed_limit.is_infinite(),
        "0 means that there is none"
    );
    assert_eq!(car.mark(Side::Left, 14.9), BoundaryType::DottedWhite);
    assert_eq!(car.mark(Side::Left, 15.1), BoundaryType::Curb);
    assert_eq!(car.mark(Side::Right, 15.1), BoundaryType::Unknown);
}

/// Cross-sections may fall elsewhere by rounding; the curve is the same.
#[test]
fn far_from_the_origin_nothing_is_lost() {
    let here = arc(50.0, 40.0, 4.0, 0.0);
    let there: Vec<_> = here
        .iter()
        .map(|(x, y)| (x + 587_000.0, y + 4_141_000.0))
        .collect();
    let (near, _) = imported(&lane("a", &here, &widths(1.5, 1.5)));
    let (far, _) = imported(&lane("a", &there, &widths(1.5, 1.5)));
    let (near, far) = (named(&near, "a"), named(&far, "a"));
    assert!((near.length() - far.length()).abs() < 1e-6);
    for k in 0..=80 {
        let (a, b) = (near.at(0.5 * f64::from(k)), far.at(0.5 * f64::from(k)));
        assert!((b.x - 587_000.0 - a.x).abs() < 1e-3 && (b.y - 4_141_000.0 - a.y).abs() < 1e-3);
        assert!((b.kappa - a.kappa).abs() < 1e-4 && angle::difference(a.theta, b.theta).abs() < 1e-4);
    }
}
