//! What must hold of every plan.

use super::scene::{bend, body, planned, with_lattice};
use crate::frame::Obstacle;
use crate::geometry::angle;
use crate::geometry::frenet::FrenetMotion;
use crate::lattice::*;
use crate::reference_line::LineQuery;
use crate::vehicle::VehicleParams;
use proptest::prelude::*;

fn is_found(plan: &Planned) -> bool {
    matches!(plan.outcome, Outcome::Found(_))
}

/// Places, headings, curvatures, speeds and accelerations are each other's differences.
#[test]
fn the_chain_of_derivatives_is_consistent() {
    let line = bend(1.0);
    for (l, v) in [
        ([0.4, 0.05, 0.0], 8.0),
        ([-0.6, -0.02, 0.003], 10.0),
        ([0.0, 0.0, 0.0], 5.0),
    ] {
        let plan = planned(&line, l, v, &[], 390.0);
        assert!(is_found(&plan));
        let points = trajectory(&plan.points);
        for triple in points.windows(3) {
            let (before, here, after) = (triple[0], triple[1], triple[2]);
            let dt = after.t - before.t;
            let v = (after.distance - before.distance) / dt;
            assert!((v - here.v).abs() < 5e-3 * here.v.max(1.0), "{v} {here:?}");
            let a = (after.v - before.v) / dt;
            // Where one curve ends and the next goes on the jerk jumps.
            assert!((a - here.a).abs() < 0.1, "{a} {here:?}");
            let moved = after.pose.position() - before.pose.position();
            let heading = libm::atan2(moved.y, moved.x);
            assert!(
                angle::difference(heading, here.pose.theta).abs() < 1e-3,
                "{heading} {here:?}"
            );
            let turn = angle::difference(after.pose.theta, before.pose.theta);
            let kappa = turn / (after.distance - before.distance);
            assert!((kappa - here.kappa).abs() < 1e-3, "{kappa} {here:?}");
        }
    }
}

#[test]
fn to_the_plane_and_back_on_a_curved_line_is_the_same() {
    let line = bend(1.0);
    for k in 0..300 {
        let (s, phase) = (5.0 + 1.3 * f64::from(k), f64::from(k));
        let motion = FrenetMotion {
            s: [s, 3.0 + phase % 7.0, angle::sin_cos(phase).0],
            l: [
                angle::sin_cos(phase * 0.7).0 * 2.0,
                angle::sin_cos(phase * 1.1).0 * 0.3,
                0.02 * angle::sin_cos(phase).1,
            ],
        };
        let plane = foot_on(&line, s).to_plane(&motion).unwrap();
        let found = line.to_frenet(plane.pose.position());
        let again = foot_on(&line, found.s).to_frenet(&plane).unwrap();
        for (got, wanted) in again
            .s
            .iter()
            .chain(&again.l)
            .zip(motion.s.iter().chain(&motion.l))
        {
            assert!(
                (got - wanted).abs() < 1e-9 * wanted.abs().max(1.0),
                "{again:?} {motion:?}"
            );
        }
    }
}

fn obstacles(line: &crate::reference_line::ReferenceLine, side: f64) -> Vec<Obstacle> {
    vec![
        body(line, 4, (75.0, side * 1.9), 0.0),
        body(line, 9, (110.0, side * -2.2), 0.0),
        body(line, 2, (95.0, side * 0.3), 7.0),
        body(line, 7, (50.0, side * 3.6), 12.0),
    ]
}

#[test]
fn a_mirrored_scene_gives_the_mirrored_trajectory() {
    let (left, right) = (bend(1.0), bend(-1.0));
    let one = planned(&left, [0.3, 0.01, 0.0], 8.0, &obstacles(&left, 1.0), 390.0);
    let other = planned(&right, [-0.3, -0.01, 0.0], 8.0, &obstacles(&right, -1.0), 390.0);
    assert_eq!(one.points.len(), other.points.len());
    for (a, b) in one.points.iter().zip(&other.points) {
        assert!((a.position.x - b.position.x).abs() < 1e-9 && (a.position.y + b.position.y).abs() < 1e-9);
        assert!(
            (a.kappa + b.kappa).abs() < 1e-9 && (a.v - b.v).abs() < 1e-9,
            "{a:?} {b:?}"
        );
    }
}

#[test]
fn the_order_of_obstacles_does_not_matter() {
    let line = bend(1.0);
    let mut bodies = obstacles(&line, 1.0);
    let one = planned(&line, [0.3, 0.01, 0.0], 8.0, &bodies, 390.0);
    for _ in 0..bodies.len() {
        bodies.rotate_left(1);
        assert_eq!(
            one.points,
            planned(&line, [0.3, 0.01, 0.0], 8.0, &bodies, 390.0).points
        );
    }
}

#[test]
fn a_car_stops_before_its_stop_point_and_stays_there() {
    let line = bend(1.0);
    let plan = planned(&line, [0.0; 3], 6.0, &[], 55.0);
    let last = plan.points.last().unwrap();
    assert!(is_found(&plan) && last.s <= 55.0 && last.v < 0.1, "{last:?}");
    let there = planned(&line, [0.0; 3], 0.0, &[], 30.05);
    assert!(there.points.iter().all(|point| point.s <= 30.05), "it moves on");
    let start = [30.0, 6.0, 0.0];
    let passes = |stop_s: f64| {
        let curves = longitudinal_bundle(start, &[], &[], &stop(30.0, stop_s));
        curves.iter().any(|curve| keeps_stop(&curve.curve, Some(55.0)))
    };
    assert!(
        passes(54.97) && !passes(55.0),
        "the stop filter drops curves that end at the stop point"
    );
}

#[test]
fn the_queue_gives_all_pairs_in_order() {
    let line = bend(1.0);
    let bodies = obstacles(&line, 1.0);
    let initial = FrenetMotion {
        s: [30.0, 8.0, 0.3],
        l: [0.3, 0.0, 0.0],
    };
    with_lattice(&line, initial, &bodies, 390.0, |lattice| {
        let queue = lattice.pairs();
        let count = queue.pairs();
        let pairs: Vec<Pair> = queue.collect();
        assert!(count > 100 && pairs.len() == count);
        assert!(pairs.windows(2).all(|pair| pair[0].cost <= pair[1].cost));
        let survey = lattice.assessed();
        let free = survey
            .iter()
            .filter(|(_, rejection)| rejection.is_none())
            .map(|(pair, _)| pair.cost);
        let cheapest = free.fold(f64::MAX, f64::min);
        match lattice.plan().unwrap().outcome {
            Outcome::Found(pair) => assert!((pair.cost - cheapest).abs() < 1e-12),
            other => assert!(cheapest.to_bits() == f64::MAX.to_bits(), "{other:?}"),
        }
    });
}

/// Where nothing is free the outcome says so, and the car brakes as hard as it can.
#[test]
fn a_wall_right_ahead_is_no_secret() {
    let line = bend(1.0);
    let wall = [body(&line, 1, (42.0, 0.0), 0.0)];
    let plan = planned(&line, [0.0; 3], 15.0, &wall, 390.0);
    let Outcome::LastResort(pair, Rejection::Touches(id)) = plan.outcome else {
        panic!("{:?}", plan.outcome);
    };
    assert_eq!(id, wall[0].id);
    assert!((pair.deceleration - VehicleParams::default().max_deceleration).abs() < 1e-12);
}

/// Nearer than the room that is kept, a car that stands waits; that is no emergency, and no reason to go nearer.
#[test]
fn who_stands_too_near_waits() {
    let line = bend(1.0);
    let front = VehicleParams::default().front_edge_to_center;
    for gap in [0.3, 1.0, 1.99, 2.01] {
        let blocker = [body(&line, 1, (30.0 + front + gap + 2.2, 0.0), 0.0)];
        let plan = planned(&line, [0.0; 3], 0.0, &blocker, 390.0);
        assert!(is_found(&plan), "{gap}: {:?}", plan.outcome);
        let (first, last) = (plan.points[0], plan.points[plan.points.len() - 1]);
        assert!(last.s - first.s < 0.1, "{gap}: {}", last.s - first.s);
    }
}

#[test]
fn the_backup_brakes_no_harder_than_it_must() {
    let line = bend(1.0);
    let laterals: Vec<Curve> = [0.5, 0.0, -0.5]
        .iter()
        .filter_map(|l| crate::geometry::Polynomial::quintic([0.0; 3], [*l, 0.0, 0.0], 20.0))
        .map(Curve::from)
        .collect();
    let order = backup_order(0.0, 10.0, &laterals);
    assert!(
        order
            .windows(2)
            .all(|pair| pair[0].end_speed >= pair[1].end_speed)
    );
    assert!(
        order
            .windows(2)
            .all(|pair| pair[0].deceleration >= pair[1].deceleration)
    );
    assert_eq!(order[0].lateral, 1, "the straight one first");
    // A stop point that cannot be kept: no curve keeps it, and braking passes it as little as it can.
    let plan = planned(&line, [0.0; 3], 10.0, &[], 31.0);
    let Outcome::Backup(pair) = plan.outcome else {
        panic!("{:?}", plan.outcome);
    };
    assert!((pair.deceleration + 4.0).abs() < 1e-12);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_found_touches_nothing_and_keeps_its_limits(
        v in 0.0..14.0, l in -0.5..0.5,
        places in prop::collection::vec((36.0..140.0, -5.0..5.0, prop::sample::select(vec![0.0, 0.0, 3.0, 8.0])), 0..6),
    ) {
        let line = bend(1.0);
        let bodies: Vec<Obstacle> = places
            .iter()
            .zip(0..)
            .map(|((s, l, speed), id)| body(&line, id, (*s, *l), *speed))
            .collect();
        let plan = planned(&line, [l, 0.0, 0.0], v, &bodies, 390.0);
        if is_found(&plan) {
            let vehicle = VehicleParams::default();
            for point in &plan.points {
                let ego = vehicle.footprint(point.pose());
                for body in &bodies {
                    let pose = pose_at(&body.prediction, point.t, &mut 0).unwrap_or(body.pose);
                    prop_assert!(!ego.overlaps(&body.shape.at(pose)), "{:?} at {}", body.id, point.t);
                }
            }
            prop_assert!(violation(plan.points.iter().map(Point::dynamics)).is_none());
        }
    }
}
