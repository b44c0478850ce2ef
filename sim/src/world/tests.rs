//! The car against theory: turning circles, understeer, braking, grip, standstill, symmetry, repeatability.
#![expect(clippy::float_cmp, reason = "standing still and repeating are exact")]

use super::*;
use crate::testing::{along, scenario};
use corridor_decider::geometry::{Vec2, angle};
use corridor_scenarios::scenario::{Behaviour, Trigger};

const DT: f64 = 0.01;
const WHEEL_BASE: f64 = 2.8448;

fn free_world(pose: Pose, speed: f64) -> World {
    World::new(&scenario(pose, speed, Vec::new()), &PhysicsConfig::default())
}

fn origin() -> Pose {
    Pose::new(0.0, 0.0, 0.0)
}

/// Steers by `steer` at a speed that a plain proportional controller holds, until everything is steady.
fn steady_turn(speed: f64, steer: f64, seconds: f64) -> World {
    let mut world = free_world(origin(), speed);
    for _ in 0..steps(seconds) {
        let acceleration = 4.0 * (speed - world.ego().v);
        world.step(Controls { steer, acceleration }, &[]);
    }
    world
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a small positive count"
)]
fn steps(seconds: f64) -> u32 {
    (seconds / DT).round() as u32
}

#[test]
fn at_walking_pace_the_rear_axle_turns_on_the_geometric_circle() {
    for steer in [0.1, -0.25, 0.45] {
        let mut world = steady_turn(2.0, steer, 5.0);
        let expected = WHEEL_BASE / libm::tan(steer);
        let radius = world.ego().v / world.ego().yaw_rate;
        assert!(
            (radius / expected - 1.0).abs() < 0.01,
            "radius {radius}, theory {expected}"
        );
        // The same from positions alone: the circle through three rear-axle places.
        let mut places = Vec::new();
        for _ in 0..3 {
            for _ in 0..100 {
                let acceleration = 4.0 * (2.0 - world.ego().v);
                world.step(Controls { steer, acceleration }, &[]);
            }
            places.push(world.ego().pose.position());
        }
        let circle = circumradius(places[0], places[1], places[2]);
        assert!(
            (circle / expected.abs() - 1.0).abs() < 0.01,
            "circle {circle}, theory {expected}"
        );
    }
}

fn circumradius(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    let doubled_area = corridor_decider::geometry::cross(b - a, c - a).abs();
    (b - a).norm() * (c - b).norm() * (a - c).norm() / (2.0 * doubled_area)
}

#[test]
fn at_speed_it_understeers_as_the_linear_single_track_model_says() {
    let params = DynamicsParams::default();
    let gradient = params.understeer_gradient(&VehicleParams::default());
    assert!((gradient - 0.002_18).abs() < 2e-5, "worked by hand: {gradient}");
    for (speed, steer) in [(15.0, 0.02), (20.0, -0.02), (25.0, 0.015)] {
        let ego = steady_turn(speed, steer, 10.0).ego();
        let expected = ego.v * steer / (WHEEL_BASE + gradient * ego.v * ego.v);
        let ratio = ego.yaw_rate / expected;
        assert!(
            (ratio - 1.0).abs() < 0.02,
            "at {speed} m/s: {} is not {expected}",
            ego.yaw_rate
        );
        let neutral = ego.v * libm::tan(steer) / WHEEL_BASE;
        assert!(
            ego.yaw_rate.abs() < 0.95 * neutral.abs(),
            "it must turn less than the wheels point"
        );
    }
}

#[test]
fn the_rear_axle_slips_as_the_tracker_believes() {
    let gradient = DynamicsParams::default().rear_slip_gradient(&VehicleParams::default());
    let mut world = steady_turn(15.0, 0.03, 10.0);
    let before = world.ego();
    world.step(
        Controls {
            steer: 0.03,
            acceleration: 0.0,
        },
        &[],
    );
    let after = world.ego();
    let way = after.pose.position() - before.pose.position();
    let middle = before.pose.theta + angle::difference(after.pose.theta, before.pose.theta) / 2.0;
    let slip = angle::difference(middle, libm::atan2(way.y, way.x));
    let expected = gradient * before.v * before.yaw_rate;
    assert!(
        (slip / expected - 1.0).abs() < 0.03,
        "slip {slip}, theory {expected}"
    );
}

#[test]
fn the_braking_distance_is_that_of_theory_plus_the_brakes_delay() {
    for (speed, braking) in [(10.0, 2.0), (15.0, 5.0), (30.0, 6.0)] {
        let mut world = free_world(origin(), speed);
        for _ in 0..steps(25.0) {
            world.step(
                Controls {
                    steer: 0.0,
                    acceleration: -braking,
                },
                &[],
            );
        }
        let lag = DynamicsParams::default().brake_lag;
        let ramp = braking / DynamicsParams::default().jerk_limit;
        let distance = world.ego().pose.x;
        let ideal = speed * speed / (2.0 * braking);
        let (shortest, longest) = (ideal + speed * lag * 0.8, ideal + speed * (lag + ramp));
        assert!(
            (shortest..longest).contains(&distance),
            "{distance} is not in {shortest}..{longest}"
        );
        assert_eq!(world.ego().v, 0.0);
        assert_eq!(world.ego().a, 0.0);
    }
}

#[test]
fn a_push_at_motorway_speed_dies_out() {
    let mut world = free_world(origin(), 35.0);
    world.motion.yaw = 0.15;
    world.motion.velocity = Vector::new(35.0, 0.8);
    let mut late: f64 = 0.0;
    for k in 0..steps(6.0) {
        world.step(Controls::default(), &[]);
        if k > steps(3.0) {
            late = late.max(world.ego().yaw_rate.abs());
        }
    }
    assert!(late < 1e-4, "yaw rate after three seconds {late}");
    assert!(
        world.ego().pose.theta.abs() < 0.2,
        "heading {}",
        world.ego().pose.theta
    );
}

#[test]
fn tyres_never_give_more_than_their_grip() {
    let limit = 0.9 * GRAVITY;
    for (speed, steer, acceleration) in [
        (12.0, 0.5, 0.0),
        (25.0, 0.3, -6.0),
        (30.0, -0.5, 2.0),
        (8.0, 0.5, -6.0),
    ] {
        let mut world = free_world(origin(), speed);
        let mut largest: f64 = 0.0;
        let mut last = world.motion.velocity;
        for _ in 0..steps(5.0) {
            world.step(Controls { steer, acceleration }, &[]);
            let now = world.motion.velocity;
            largest = largest.max((now - last).length() / DT);
            last = now;
        }
        assert!(
            largest <= limit * (1.0 + 1e-9),
            "{largest} m/s² is more than {limit}"
        );
        if speed > 20.0 {
            assert!(
                largest > 0.8 * limit,
                "{largest} m/s²: this manoeuvre must reach the limit"
            );
        }
    }
}

#[test]
fn braked_to_rest_it_stands_exactly_whatever_the_wheels_do() {
    let mut world = free_world(Pose::new(3.0, -2.0, 0.7), 5.0);
    for _ in 0..steps(6.0) {
        world.step(
            Controls {
                steer: 0.2,
                acceleration: -1.5,
            },
            &[],
        );
    }
    let rest = world.ego();
    assert_eq!(rest.v, 0.0);
    for k in 0..steps(60.0) {
        let steer = 0.5 * libm::sin(f64::from(k) * 0.03);
        let acceleration = if k % 500 < 250 { -1.0 } else { -0.1 };
        world.step(Controls { steer, acceleration }, &[]);
        let ego = world.ego();
        assert_eq!((ego.pose, ego.v, ego.yaw_rate, ego.a), (rest.pose, 0.0, 0.0, 0.0));
    }
}

#[test]
fn without_pedals_a_standing_car_stays_and_a_slow_one_does_not_shake() {
    let mut standing = free_world(Pose::new(1.0, 2.0, 0.4), 0.0);
    let at = standing.ego().pose;
    let mut slow = free_world(origin(), 0.3);
    let mut last = 0.0;
    for k in 0..steps(20.0) {
        let steer = 0.4 * libm::sin(f64::from(k) * 0.01);
        standing.step(
            Controls {
                steer,
                acceleration: 0.0,
            },
            &[],
        );
        assert_eq!((standing.ego().pose.x, standing.ego().pose.y), (at.x, at.y));
        slow.step(
            Controls {
                steer,
                acceleration: 0.0,
            },
            &[],
        );
        // Wheels that roll without slip turn the car at v·tan(steer)/L, no faster and without ringing.
        let ego = slow.ego();
        let ideal = ego.v * libm::tan(ego.steer) / WHEEL_BASE;
        assert!(
            (ego.yaw_rate - ideal).abs() < 2e-3,
            "{} is not {ideal}",
            ego.yaw_rate
        );
        assert!((ego.yaw_rate - last).abs() < 2e-3, "yaw rate jumps");
        last = ego.yaw_rate;
    }
    assert!(
        slow.ego().v > 0.25 && slow.ego().v <= 0.3,
        "it rolls on: {}",
        slow.ego().v
    );
}

fn wild(k: u32) -> Controls {
    Controls {
        steer: 0.3 * libm::sin(f64::from(k) * 0.021),
        acceleration: 3.0 * libm::sin(f64::from(k) * 0.013),
    }
}

#[test]
fn a_world_can_go_to_another_thread() {
    fn sendable<T: Send>() {}
    sendable::<World>();
    sendable::<agents::Agents>();
}

#[test]
fn two_runs_give_the_same_bits() {
    let run = || {
        let line = crate::testing::line(&crate::testing::road(origin(), 0.0, 600.0));
        let others = vec![
            Behaviour::Parked(Pose::new(40.0, -3.0, 0.1)),
            Behaviour::ConstantSpeed(along(&line, 30.0, 3.5, 8.0)),
            Behaviour::Pedestrian {
                from: Vec2::new(60.0, -5.0),
                to: Vec2::new(60.0, 5.0),
                speed: 1.4,
                trigger: Trigger::EgoWithin(20.0),
            },
        ];
        let scenario = scenario(Pose::new(5.0, 0.0, 0.0), 10.0, others);
        let mut world = World::new(&scenario, &PhysicsConfig::default());
        let mut agents = agents::Agents::new(&scenario);
        let mut hashes = Vec::new();
        for k in 0..1500 {
            let moved = agents.advance(&world.ego(), DT);
            world.step(wild(k), moved);
            hashes.push(world.state_hash());
        }
        hashes
    };
    let hashes = run();
    assert_eq!(hashes, run());
    assert!(
        hashes.windows(2).all(|pair| pair[0] != pair[1]),
        "something moves in every step"
    );
}

#[test]
fn a_turned_and_shifted_scene_gives_the_same_motion() {
    let frame = Pose::new(120.0, -45.0, 2.1);
    let mut plain = free_world(origin(), 12.0);
    let mut moved = free_world(frame, 12.0);
    for k in 0..2000 {
        plain.step(wild(k), &[]);
        moved.step(wild(k), &[]);
        let (a, b) = (plain.ego(), moved.ego());
        let back = frame.to_local(b.pose.position());
        assert!(
            (back - a.pose.position()).norm() < 1e-9,
            "step {k}: {back} is not {}",
            a.pose.position()
        );
        assert!(angle::difference(b.pose.theta - frame.theta, a.pose.theta).abs() < 1e-9);
    }
}

#[test]
fn mirrored_controls_give_mirrored_motion_to_the_bit() {
    let (mut left, mut right) = (free_world(origin(), 14.0), free_world(origin(), 14.0));
    for k in 0..2000 {
        let controls = wild(k);
        left.step(controls, &[]);
        right.step(
            Controls {
                steer: -controls.steer,
                ..controls
            },
            &[],
        );
        let (a, b) = (left.ego(), right.ego());
        assert_eq!(
            (a.pose.x, a.pose.y, a.pose.theta, a.v, a.yaw_rate),
            (b.pose.x, -b.pose.y, -b.pose.theta, b.v, -b.yaw_rate),
            "step {k}"
        );
    }
}

#[test]
fn touching_nothing_it_moves_exactly_as_the_engine_would_move_it() {
    let mut free = free_world(Pose::new(300.0, -80.0, 1.1), 12.0);
    let mut engine = free_world(Pose::new(300.0, -80.0, 1.1), 12.0);
    for k in 0..3000 {
        free.step(wild(k), &[]);
        engine
            .actuators
            .advance(wild(k), &engine.vehicle, &engine.dynamics, DT);
        engine.push_ego();
        engine.step_engine();
        engine.read_ego();
        assert_eq!(free.motion, engine.motion, "step {k}");
        assert_eq!(free.state_hash(), engine.state_hash(), "step {k}");
    }
}
