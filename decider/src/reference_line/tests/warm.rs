//! The projection from a hint against the one without: the same bits where both mean the same place, the hint's pass
//! where the line crosses itself, and the whole line where the hint is of no use.

use crate::geometry::{Vec2, angle};
use crate::reference_line::{LineQuery, ReferenceLine, SlPoint, testing};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// How far from a hint the foot is looked for, m.
const WINDOW: f64 = 8.0;

/// Radius of both loops of the eight, m.
const RADIUS: f64 = 15.0;

/// Length of one loop of the eight, m.
const LOOP: f64 = TAU * RADIUS;

/// Two full circles, to the left and to the right, that touch at the origin, with straights before, between and after:
/// the line passes every place near the origin up to three times.
fn eight() -> ReferenceLine {
    testing::line(2.0 * LOOP + 60.0, |s| match s - 20.0 {
        s if (0.0..LOOP).contains(&s) => 1.0 / RADIUS,
        s if (LOOP..2.0 * LOOP).contains(&s) => -1.0 / RADIUS,
        _ => 0.0,
    })
}

/// Straight, five eighths of a circle, straight on through the first straight.
fn crossing() -> ReferenceLine {
    let bend = TAU * RADIUS * 0.75;
    testing::line(60.0 + bend + 60.0, move |s| {
        if (60.0..60.0 + bend).contains(&s) {
            1.0 / RADIUS
        } else {
            0.0
        }
    })
}

/// The nearest place within the window around `hint`, among points a centimetre apart.
fn nearest_near(line: &ReferenceLine, point: Vec2, hint: f64) -> (f64, f64) {
    let from = (hint - WINDOW).max(0.0);
    let to = (hint + WINDOW).min(line.length());
    let places = (0..).map(|k| from + f64::from(k) * 0.01).take_while(|s| *s <= to);
    let distance = |s: f64| {
        let at = line.point(s);
        (point - Vec2::new(at.x, at.y)).norm()
    };
    let all = places.map(|s| (distance(s), s));
    let (distance, s) = all
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .expect("a window on the line");
    (s, distance)
}

proptest! {
    /// On a line that keeps clear of itself, from any hint, the bits are those of the cold search: on curves, before
    /// the start and behind the end, near the hint or far from it.
    #[test]
    fn it_is_the_cold_search_where_the_foot_is_unique(
        s in -12.0..272.0_f64,
        l in -8.0..8.0_f64,
        off in -20.0..20.0_f64,
    ) {
        let line = testing::s_curve();
        let inside = s.clamp(0.0, line.length());
        let heading = line.point(inside).theta;
        let (sin, cos) = angle::sin_cos(heading);
        let point = line.to_cartesian(SlPoint { s, l }) + Vec2::new(cos, sin) * (s - inside);
        prop_assert_eq!(line.to_frenet_near(point, s + off), line.to_frenet(point));
    }

    /// Where the line passes several times the place is the nearest one in the hint's window, whatever else is nearer.
    #[test]
    fn it_stays_on_the_pass_of_the_hint(
        s in 8.0..180.0_f64,
        l in -3.0..3.0_f64,
        off in -4.0..4.0_f64,
    ) {
        for line in [eight(), crossing()] {
            let point = line.to_cartesian(SlPoint { s, l });
            let hint = s + off;
            let (nearest, distance) = nearest_near(&line, point, hint);
            let found = line.to_frenet_near(point, hint);
            // Where the curvature jumps, the foot of the perpendicular and the nearest point lie centimetres apart.
            prop_assert!(
                (found.s - nearest).abs() < 0.05 && (found.l.abs() - distance).abs() < 6e-3,
                "{found:?}, but {nearest} is {distance} away"
            );
            prop_assert!((found.s - s).abs() < 1e-6 && (found.l - l).abs() < 1e-6, "{found:?} for {s} {l}");
        }
    }

    /// Whatever the numbers are, and on whatever side of a bend, it comes to an end with a place.
    #[test]
    fn it_finds_some_place_from_anywhere(x in -90.0..90.0_f64, y in -90.0..90.0_f64, hint in -20.0..280.0_f64) {
        let line = eight();
        let found = line.to_frenet_near(Vec2::new(x, y), hint);
        let cold = line.to_frenet(Vec2::new(x, y));
        prop_assert!((found.s - hint).abs() <= WINDOW || found == cold, "{found:?} from {hint}, cold {cold:?}");
    }
}

/// The touching point of the eight lies on four stretches of the line; the hint says which is meant.
#[test]
fn the_hint_decides_on_an_eight() {
    let line = eight();
    let centre = line.point(20.0);
    let point = Vec2::new(centre.x, centre.y);
    for pass in [20.0, 20.0 + LOOP, 20.0 + 2.0 * LOOP] {
        for off in [-5.0, -0.3, 0.0, 2.0, 5.0] {
            let found = line.to_frenet_near(point, pass + off);
            assert!((found.s - pass).abs() < 1e-3, "{found:?}, not {pass}");
        }
    }
}

/// A hint from elsewhere, or one that is none, costs time and nothing else.
#[test]
fn a_hint_of_no_use_leads_to_the_cold_search() {
    let line = crossing();
    let point = line.to_cartesian(SlPoint { s: 30.0, l: 1.2 });
    for hint in [f64::NAN, f64::INFINITY, -1e9, 1e9, 5.0, 55.0] {
        assert_eq!(
            line.to_frenet_near(point, hint),
            line.to_frenet(point),
            "from {hint}"
        );
    }
    for v in [f64::NAN, f64::INFINITY, 1e300] {
        let _ = line.to_frenet_near(Vec2::new(v, 0.0), 10.0);
    }
}

/// A car that drives along and hands on its last station stays on its pass all the way.
#[test]
fn following_an_eight_never_jumps() {
    let line = eight();
    let mut hint = 0.0;
    for k in 0..2400 {
        let s = f64::from(k) * 0.1;
        let l = 2.0 * angle::sin_cos(s / 9.0).0;
        hint = line.to_frenet_near(line.to_cartesian(SlPoint { s, l }), hint).s;
        assert!((hint - s).abs() < 1e-6, "at {s} it says {hint}");
    }
}
