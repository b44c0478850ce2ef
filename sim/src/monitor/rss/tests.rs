//! Fixtures of ad-rss-lib and worked numbers.

use super::*;
use proptest::prelude::*;

const PROFILE: RssProfile = RssProfile {
    response_time: 1.0,
    response_time_others: 2.0,
    acceleration: 3.5,
    min_braking: 4.0,
    max_braking: 8.0,
    min_braking_correct: 3.0,
    lateral_acceleration: 0.2,
    lateral_braking: 0.8,
    lateral_fluctuation: 0.1,
    margin: 0.0,
};

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

/// Both respond after 2 s; lateral speeds in km/h, to the left.
fn side_by_side(right: f64, left: f64) -> f64 {
    let at = |v: f64| Lateral {
        v: v / 3.6,
        response: 2.0,
    };
    PROFILE.lateral(at(right), at(left))
}

#[test]
fn the_defaults_are_those_of_the_library() {
    assert_eq!(RssProfile::default(), PROFILE);
}

#[test]
fn lateral_distances_are_those_of_the_library_tests() {
    for (speed, expected) in [(0.0, 1.10), (1.0, 1.19), (-1.0, 1.19), (5.0, 2.90), (-5.0, 2.90)] {
        near(side_by_side(speed, speed), expected, 0.01);
    }
    // One moves towards the other or away from it, which stands.
    for (right, left, expected) in [
        (1.0, 0.0, 1.84),
        (-1.0, 0.0, 0.45),
        (5.0, 0.0, 5.77),
        (-5.0, 0.0, 0.0),
        (0.0, -1.0, 1.84),
        (0.0, 1.0, 0.45),
        (0.0, -5.0, 5.77),
        (0.0, 5.0, 0.0),
    ] {
        near(side_by_side(right, left), expected, 0.01);
    }
    near(side_by_side(1.0, 1.0), 1.196, 1e-3);
    near(side_by_side(1.0, 0.0), 1.843, 1e-3);
    near(side_by_side(-1.0, 0.0), 0.454, 1e-3);
    near(side_by_side(5.0, 0.0), 5.778, 1e-3);
}

#[test]
fn a_parked_car_goes_nowhere_to_the_side() {
    let parked = Lateral {
        v: 0.0,
        response: 0.0,
    };
    let ego = |v| Lateral { v, response: 1.0 };
    near(PROFILE.lateral(ego(0.0), parked), 0.225, 1e-3);
    near(PROFILE.lateral(ego(0.5), parked), 1.006, 1e-3);
    near(PROFILE.lateral(parked, ego(-0.5)), 1.006, 1e-3);
}

#[test]
fn longitudinal_distances_are_those_of_the_appendix() {
    for (rear, front, expected) in [
        (5.0, 0.0, 15.78),
        (8.33, 0.0, 27.57),
        (10.0, 0.0, 34.53),
        (13.89, 0.0, 53.44),
        (10.0, 10.0, 28.28),
        (13.89, 13.89, 41.38),
    ] {
        near(PROFILE.same_direction(rear, front, 1.0), expected, 0.01);
    }
    near(PROFILE.same_direction(0.0, 30.0, 1.0), 0.0, 0.0);
}

/// Each goes on for its own time, then brakes as it must: 10 + 1.75 + 13.5²/6 m and 20 + 7 + 17²/8 m.
#[test]
fn those_who_meet_both_brake() {
    let found = PROFILE.opposite_direction((10.0, 1.0), (10.0, 2.0));
    near(found, 11.75 + 30.375 + 27.0 + 36.125, 1e-9);
}

#[test]
fn nobody_is_without_brakes() {
    assert!(PROFILE.is_sound());
    let without = RssProfile {
        lateral_braking: 0.0,
        ..PROFILE
    };
    assert!(!without.is_sound());
}

proptest! {
    /// The distance is what is needed: whoever keeps it, and drives as badly as is allowed, does not touch.
    #[test]
    fn the_safe_distance_is_just_enough(rear in 0.0..20.0f64, front in 0.0..20.0f64, response in 0.1..2.0f64) {
        let gap = PROFILE.same_direction(rear, front, response);
        let (mut x, mut v, mut ahead, mut w) = (0.0, rear, gap, front);
        let mut least = gap;
        let dt = 1e-3;
        for k in 0..20_000 {
            let t = f64::from(k) * dt;
            let a = if t < response { PROFILE.acceleration } else { -PROFILE.min_braking };
            let (v_next, w_next) = ((v + a * dt).max(0.0), (w - PROFILE.max_braking * dt).max(0.0));
            x += f64::midpoint(v, v_next) * dt;
            ahead += f64::midpoint(w, w_next) * dt;
            (v, w) = (v_next, w_next);
            least = f64::min(least, ahead - x);
        }
        prop_assert!(least > -0.1, "{least}");
        // At the end they stand as close as that, where the distance is not 0 anyway.
        prop_assert!(gap <= 0.0 || (ahead - x).abs() < 0.1, "{}", ahead - x);
    }

    #[test]
    fn left_and_right_are_alike(v in -3.0..3.0f64, w in -3.0..3.0f64, one in 0.0..2.0f64, other in 0.0..2.0f64) {
        let at = |v, response| Lateral { v, response };
        let here = PROFILE.lateral(at(v, one), at(w, other));
        let there = PROFILE.lateral(at(-w, other), at(-v, one));
        prop_assert!((here - there).abs() < 1e-12);
    }
}
