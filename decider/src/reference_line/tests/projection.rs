//! The projection against a search over the whole line, millimetre by millimetre: tight bends, a line that crosses
//! itself, both ends, and anywhere in the world.

use crate::geometry::{Pose, Vec2, angle};
use crate::reference_line::{LineQuery, LineSample, ReferenceLine, SlPoint, testing};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Radius of the tightest bend in the original's maps, m: a right turn at a kerb.
const TIGHT: f64 = 6.0;

/// Distance between the points that brute force tries, m.
const FINE: f64 = 1e-3;

/// Nearest of many points of the line: its station and distance.
fn by_brute_force(line: &ReferenceLine, point: Vec2) -> (f64, f64) {
    let distance = |s: f64| {
        let at = line.point(s);
        (point - Vec2::new(at.x, at.y)).norm()
    };
    let coarse = (0..)
        .map(|k| f64::from(k) * 0.05)
        .take_while(|s| *s < line.length());
    let near = coarse
        .min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
        .unwrap();
    let fine = (-60..=60).map(|k| (near + f64::from(k) * FINE).clamp(0.0, line.length()));
    let s = fine.min_by(|a, b| distance(*a).total_cmp(&distance(*b))).unwrap();
    (s, distance(s))
}

/// Straight, a left turn, straight, a right turn, both of 6 m radius, straight.
fn tight() -> ReferenceLine {
    let quarter = TIGHT * TAU / 4.0;
    testing::line(60.0, move |s| match s {
        s if (10.0..10.0 + quarter).contains(&s) => 1.0 / TIGHT,
        s if (30.0..30.0 + quarter).contains(&s) => -1.0 / TIGHT,
        _ => 0.0,
    })
}

/// Three quarters of a circle between two straights that cross each other at a right angle.
fn loop_that_crosses_itself() -> ReferenceLine {
    let bend = TIGHT * TAU * 0.75;
    testing::line(70.0, move |s| {
        if (20.0..20.0 + bend).contains(&s) {
            1.0 / TIGHT
        } else {
            0.0
        }
    })
}

fn moved(line: &ReferenceLine, by: Pose) -> ReferenceLine {
    let samples: Vec<LineSample> = line.clone().into();
    let move_one = |mut sample: LineSample| {
        let at = by.to_world(Vec2::new(sample.point.x, sample.point.y));
        (sample.point.x, sample.point.y) = (at.x, at.y);
        sample.point.theta = angle::wrap(sample.point.theta + by.theta);
        sample
    };
    ReferenceLine::from(samples.into_iter().map(move_one).collect::<Vec<_>>())
}

proptest! {
    /// From anywhere within 30 m the foot is as near as the nearest point, up to what a chord cuts off of the
    /// tightest arc where two stretches are equally near; and the way to it is perpendicular.
    #[test]
    fn the_foot_is_the_nearest_point(
        crossing in any::<bool>(),
        x in -15.0..45.0_f64,
        y in -25.0..35.0_f64,
    ) {
        let line = if crossing { loop_that_crosses_itself() } else { tight() };
        let point = Vec2::new(x, y);
        let found = line.to_frenet(point);
        let (s, nearest) = by_brute_force(&line, point);
        if found.s < 0.0 || found.s > line.length() {
            // Beyond an end the tangent goes on: the end is the nearest point of the line.
            let end = if found.s < 0.0 { 0.0 } else { line.length() };
            let at = line.point(end);
            let away = (point - Vec2::new(at.x, at.y)).norm();
            // The search steps over the very end; where both ends are as near, either will do.
            prop_assert!(away <= nearest + 0.02, "{found:?} is {away} away, {s} {nearest}");
            return Ok(());
        }
        let at = line.point(found.s);
        let d = point - Vec2::new(at.x, at.y);
        let sagitta = 0.5 * 0.5 / (8.0 * TIGHT);
        prop_assert!(d.norm() <= nearest + 2.0 * sagitta, "{found:?} is {} away, {s} {nearest}", d.norm());
        let (sin, cos) = angle::sin_cos(at.theta);
        let inside_the_bend = 1.0 - at.kappa * found.l < 0.15;
        prop_assert!(inside_the_bend || (cos * d.x + sin * d.y).abs() < 1e-9, "not perpendicular: {found:?}");
        prop_assert!((found.l.abs() - d.norm()).abs() < 1e-6 || inside_the_bend);
    }

    /// Beside the line, nearer than the centre of its tightest bend, station and offset come back.
    #[test]
    fn frenet_and_back_in_tight_bends(s in 0.0..59.5_f64, l in -4.5..4.5_f64) {
        let line = tight();
        let there = line.to_frenet(line.to_cartesian(SlPoint { s, l }));
        prop_assert!((there.s - s).abs() < 1e-9 && (there.l - l).abs() < 1e-9, "{s} {l}: {there:?}");
    }

    /// The Frenet frame moves with the line.
    #[test]
    fn a_moved_world_has_the_same_frenet_frame(
        by in (-1e5..1e5_f64, -1e5..1e5_f64, -3.1..3.1_f64),
        s in -5.0..64.0_f64,
        l in -4.5..4.5_f64,
    ) {
        let (line, by) = (tight(), Pose::new(by.0, by.1, by.2));
        let over = (s - s.clamp(0.0, line.length())) * angle::sin_cos(line.point(s).theta).1;
        let point = line.to_cartesian(SlPoint { s, l }) + Vec2::new(over, 0.0);
        let (here, there) = (line.to_frenet(point), moved(&line, by).to_frenet(by.to_world(point)));
        prop_assert!((here.s - there.s).abs() < 1e-6 && (here.l - there.l).abs() < 1e-6, "{here:?} {there:?}");
    }

    /// Beyond the ends `s` runs on along the tangent.
    #[test]
    fn tangents_go_on(beyond in 0.0..50.0_f64, l in -10.0..10.0_f64) {
        let line = testing::s_curve();
        let before = line.to_frenet(Vec2::new(-beyond, l));
        prop_assert!((before.s + beyond).abs() < 1e-9 && (before.l - l).abs() < 1e-9);
        let end = line.point(line.length());
        let pose = Pose::new(end.x, end.y, end.theta);
        let behind = line.to_frenet(pose.to_world(Vec2::new(beyond, l)));
        prop_assert!((behind.s - line.length() - beyond).abs() < 1e-9 && (behind.l - l).abs() < 1e-9);
    }
}

/// The crossing's own point lies on both branches; off it, the nearer branch wins.
#[test]
fn at_a_crossing_the_nearer_branch_wins() {
    let line = loop_that_crosses_itself();
    let bend = TIGHT * TAU * 0.75;
    // The second straight runs along −y through x = 20 − 6 = 14, and meets the first at y = 0.
    let crossing = line.to_frenet(Vec2::new(14.0, 0.0)).s;
    let (first, second) = (14.0, 20.0 + bend + 6.0);
    assert!(
        (crossing - first).abs() < 1e-6 || (crossing - second).abs() < 1e-6,
        "{crossing}"
    );
    let near_first = line.to_frenet(Vec2::new(15.0, 0.3));
    assert!(
        (near_first.s - 15.0).abs() < 1e-6 && (near_first.l - 0.3).abs() < 1e-6,
        "{near_first:?}"
    );
    let near_second = line.to_frenet(Vec2::new(14.3, -1.0));
    assert!(
        (near_second.s - second - 1.0).abs() < 0.01 && (near_second.l - 0.3).abs() < 0.01,
        "{near_second:?}"
    );
}

#[test]
fn no_number_makes_a_query_panic() {
    let line = tight();
    for v in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 0.0] {
        for w in [f64::NAN, f64::INFINITY, 1e300, 1.0] {
            let _ = line.to_frenet(Vec2::new(v, w));
            let _ = line.to_cartesian(SlPoint { s: v, l: w });
            let _ = line.lane_heading(Vec2::new(v, w), v);
        }
        let _ = (line.point(v), line.lane_width(v), line.near_junction(v, 1.0));
        let _ = line.sample_at(v);
    }
}

/// Where a straight turns into a bend between two samples the curvature jumps. Newton's method with the mean of the
/// curvatures was a quarter of a metre off there, five metres beside the line.
#[test]
fn the_foot_is_found_where_the_curvature_jumps() {
    let line = tight();
    for k in 0..80 {
        for (from, l) in [(8.0, 5.0), (8.0, -5.0), (17.5, 5.0), (28.0, -5.0), (37.5, -5.0)] {
            let s = from + f64::from(k) * 0.05;
            let there = line.to_frenet(line.to_cartesian(SlPoint { s, l }));
            assert!(
                (there.s - s).abs() < 1e-9 && (there.l - l).abs() < 1e-9,
                "{s} {l}: {there:?}"
            );
        }
    }
}
