//! Worked numbers of the specification, and what must hold of every profile that ends in a stop.

use super::speed_profile::{FALLBACK_STEP, FALLBACK_TIME, constant_deceleration, extract, standstill};
use super::*;
use crate::st_graph::SpeedData;
use proptest::prelude::*;

fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance
}

fn check_stop(profile: &SpeedData) {
    let last = profile.points[profile.points.len() - 1];
    assert!(
        near(last.v, 0.0, 1e-12) && near(last.a, 0.0, 1e-12),
        "it ends with {last:?}"
    );
    assert!(
        last.t >= FALLBACK_TIME - FALLBACK_STEP - 1e-9,
        "it ends at {} s",
        last.t
    );
    assert!(
        profile
            .points
            .windows(2)
            .all(|pair| pair[1].s >= pair[0].s && pair[1].t > pair[0].t)
    );
    assert!(profile.points.iter().all(|point| point.v >= 0.0));
}

#[test]
fn constant_braking_is_that_of_the_specification_until_it_stops() {
    let profile = constant_deceleration(10.0, 0.0, -4.0);
    for (t, s, v) in [(0.1, 0.98, 9.6), (1.0, 8.0, 6.0), (2.5, 12.5, 0.0)] {
        let point = profile.at_time(t).unwrap();
        assert!(near(point.s, s, 1e-9) && near(point.v, v, 1e-9), "{point:?}");
    }
    let end = |v: f64| constant_deceleration(v, 0.0, -4.0).points.last().unwrap().s;
    assert!(
        near(end(0.3), 0.3 * 0.3 / 8.0, 1e-12),
        "it stops at the exact moment"
    );
    assert!(
        near(end(15.0), 15.0 * 15.0 / 8.0, 1e-9),
        "it goes on for longer than 3 s"
    );
    assert!(near(end(-0.1), 0.0, 0.0));
}

/// The exact solutions that the specification lists for (10, 0), at whole seconds.
#[test]
fn braking_with_limited_jerk_is_the_optimum_of_the_quadratic_program() {
    let cases = [
        (
            10.0,
            0.0,
            [
                (9.3333, 8.0, -4.0),
                (14.9237, 3.2061, -4.2061),
                (16.3601, 0.0, -2.2061),
            ],
        ),
        (
            15.0,
            0.0,
            [(14.3333, 13.0, -4.0), (24.75, 7.5, -6.0), (29.25, 1.5, -6.0)],
        ),
        (
            20.0,
            0.0,
            [(19.3333, 18.0, -4.0), (34.75, 12.5, -6.0), (44.25, 6.5, -6.0)],
        ),
    ];
    for (v, a, wanted) in cases {
        let profile = braking_profile(v, a, BrakingLimits::NORMAL);
        let first = profile.at_time(1.0).unwrap();
        assert!(
            near(first.s, wanted[0].0, 1e-3) && near(first.v, wanted[0].1, 1e-3),
            "{first:?}"
        );
        for (t, wanted) in [2.0, 3.0].into_iter().zip(&wanted[1..]) {
            let got = profile.at_time(t).unwrap();
            // The optimum stops with its brakes applied; here they are released, which takes a little longer.
            assert!(
                got.s >= wanted.0 - 1e-3 && got.s <= wanted.0 + 2.0,
                "{t} s: {got:?}"
            );
        }
        check_stop(&profile);
    }
}

#[test]
fn starts_for_which_there_is_no_quadratic_program_end_in_a_stop() {
    for (v, a) in [
        (1.0, -3.0),
        (2.0, -3.0),
        (0.2, -1.0),
        (3.0, -4.0),
        (10.0, -7.0),
        (10.0, 2.5),
        (-0.01, 0.5),
    ] {
        check_stop(&braking_profile(v, a, BrakingLimits::NORMAL));
        check_stop(&constant_deceleration(v, a, -4.0));
    }
    check_stop(&standstill());
}

#[test]
fn knots_are_taken_until_they_no_longer_move_on() {
    let profile = extract(
        &[0.0, 0.5, 0.8, 0.8],
        &[6.0, 4.0, 1.0, 0.0],
        &[-1.0, -2.0, -3.0, 0.0],
        0.1,
    );
    assert_eq!(profile.points.len(), 30);
    assert!(near(profile.points[2].da, -10.0, 1e-9));
    assert!(near(profile.points[3].s, 0.8, 0.0) && near(profile.points[3].v, 0.0, 0.0));
    assert!(extract(&[], &[], &[], 0.1).is_empty());
}

proptest! {
    #[test]
    fn every_stop_is_one(v in -1.0..40.0, a in -9.0..4.0, apply in -30.0..-1.0, release in 1.0..30.0, hard in -9.0..-1.0) {
        let limits = BrakingLimits { max_deceleration: hard, apply, release };
        let profile = braking_profile(v, a, limits);
        check_stop(&profile);
        for pair in profile.points.windows(2) {
            prop_assert!(pair[1].a >= hard - 1e-9, "braking with {}", pair[1].a);
            let area = f64::midpoint(pair[0].v, pair[1].v) * FALLBACK_STEP;
            prop_assert!((pair[1].s - pair[0].s - area).abs() < 0.05, "{:?}", pair);
        }
    }
}
