//! The tracker in the loop with the car: paths that bend, lanes that change, stops, starts beside the path.
#![expect(clippy::float_cmp, reason = "standing still is exact")]

use super::*;
use crate::testing::scenario;
use crate::world::{PhysicsConfig, World};
use corridor_decider::geometry::{Pose, Quintic};
use std::f64::consts::PI;

const DT: f64 = 0.01;
const STEPS_PER_TICK: u32 = 10;
/// A planner's horizon, s, and spacing of its points, in fine points.
const HORIZON: f64 = 8.0;
const SPACING: usize = 100;
/// Spacing of the fine points that paths are integrated on, s.
const FINE: f64 = 0.001;

/// The whole motion, finely sampled: curvature over distance, acceleration over time from speed `v`.
fn motion(
    v: f64,
    seconds: f64,
    kappa: impl Fn(f64) -> f64,
    acceleration: impl Fn(f64) -> f64,
) -> Vec<TrajectoryPoint> {
    let mut points = Vec::new();
    let (mut pose, mut v, mut distance, mut t) = (Pose::new(0.0, 0.0, 0.0), v, 0.0, 0.0);
    while t < seconds {
        let a = if v > 0.0 {
            acceleration(t)
        } else {
            acceleration(t).max(0.0)
        };
        points.push(TrajectoryPoint {
            t,
            distance,
            pose,
            kappa: kappa(distance),
            v,
            a,
        });
        let step = v * FINE;
        let middle = pose.theta + kappa(distance + step / 2.0) * step / 2.0;
        let (sin, cos) = angle::sin_cos(middle);
        let theta = angle::wrap(pose.theta + kappa(distance + step / 2.0) * step);
        pose = Pose::new(pose.x + cos * step, pose.y + sin * step, theta);
        distance += step;
        v = (v + a * FINE).max(0.0);
        t += FINE;
    }
    points
}

struct Outcome {
    /// Lateral errors at every step, m, with their sign, left positive.
    errors: Vec<f64>,
    /// Road-wheel angles at every step, rad.
    steers: Vec<f64>,
    end: EgoState,
}

impl Outcome {
    fn p95(&self) -> f64 {
        let mut sizes: Vec<f64> = self.errors.iter().map(|e| e.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        sizes[sizes.len() * 95 / 100]
    }

    fn max(&self) -> f64 {
        self.errors.iter().fold(0.0, |m, e| m.max(e.abs()))
    }
}

/// Follows the motion from `start`, the part ahead handed out anew every tick as a planner does.
fn follow(whole: &[TrajectoryPoint], start: Pose, speed: f64) -> Outcome {
    let scenario = scenario(start, speed, Vec::new());
    let mut world = World::new(&scenario, &PhysicsConfig::default());
    let tracker = Tracker::new(scenario.vehicle, TrackerConfig::default());
    let (mut errors, mut steers, mut near) = (Vec::new(), Vec::new(), 0);
    let mut plan = Vec::new();
    let seconds = whole.last().unwrap().t;
    let mut k = 0;
    while f64::from(k) * DT < seconds {
        let time = f64::from(k) * DT;
        if k % STEPS_PER_TICK == 0 {
            plan = part_from(whole, time);
        }
        let since = f64::from(k % STEPS_PER_TICK) * DT;
        world.step(tracker.track(&world.ego(), &plan, since), &[]);
        let ego = world.ego();
        near = nearest(whole, &ego, near);
        errors.push(whole[near].pose.to_local(ego.pose.position()).y);
        steers.push(ego.steer);
        k += 1;
    }
    Outcome {
        errors,
        steers,
        end: world.ego(),
    }
}

fn part_from(whole: &[TrajectoryPoint], time: f64) -> Vec<TrajectoryPoint> {
    let from = whole
        .partition_point(|p| p.t < time - FINE / 2.0)
        .min(whole.len() - 1);
    let zero = whole[from];
    let shifted = |p: &TrajectoryPoint| TrajectoryPoint {
        t: p.t - zero.t,
        distance: p.distance - zero.distance,
        ..*p
    };
    whole[from..]
        .iter()
        .step_by(SPACING)
        .map(shifted)
        .take_while(|p| p.t <= HORIZON)
        .collect()
}

fn nearest(whole: &[TrajectoryPoint], ego: &EgoState, from: usize) -> usize {
    let distance = |k: usize| (whole[k].pose.position() - ego.pose.position()).norm_squared();
    let window = from.saturating_sub(500)..(from + 2000).min(whole.len());
    window
        .min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
        .unwrap()
}

fn still(_: f64) -> f64 {
    0.0
}

/// A bend of the given curvature that is entered and left over `ramp` metres, alternating sides.
fn s_curve(peak: f64, ramp: f64, hold: f64) -> impl Fn(f64) -> f64 {
    move |s| {
        let period = 2.0 * ramp + hold;
        let s = s - 10.0;
        if s < 0.0 {
            return 0.0;
        }
        let side = if (s / period).floor() % 2.0 == 0.0 {
            1.0
        } else {
            -1.0
        };
        let at = s % period;
        side * peak * (at / ramp).min((period - at) / ramp).min(1.0)
    }
}

fn report(what: &str, outcome: &Outcome) -> String {
    format!("{what}: p95 {:.3} m, max {:.3} m", outcome.p95(), outcome.max())
}

#[test]
fn an_s_curve_of_ten_metres_radius_at_five_metres_per_second() {
    let whole = motion(5.0, 20.0, s_curve(0.1, 8.0, 10.0), still);
    let outcome = follow(&whole, Pose::new(0.0, 0.0, 0.0), 5.0);
    assert!(
        outcome.p95() <= 0.10 && outcome.max() <= 0.20,
        "{}",
        report("S-curve", &outcome)
    );
}

#[test]
fn bends_at_every_speed() {
    for (speed, peak, ramp) in [
        (2.0, 0.15, 6.0),
        (8.0, 0.04, 12.0),
        (12.0, 0.02, 15.0),
        (15.0, 0.013, 20.0),
    ] {
        let whole = motion(speed, 25.0, s_curve(peak, ramp, 3.0 * speed), still);
        let outcome = follow(&whole, Pose::new(0.0, 0.0, 0.0), speed);
        let what = format!("bend of {peak} at {speed} m/s");
        assert!(
            outcome.p95() <= 0.10 && outcome.max() <= 0.20,
            "{}",
            report(&what, &outcome)
        );
    }
}

#[test]
fn a_steady_circle_leaves_no_lasting_error() {
    for (speed, kappa) in [(5.0, 0.1), (10.0, -0.03), (15.0, 0.015)] {
        let whole = motion(speed, 30.0, |s| kappa * (s / 15.0).min(1.0), still);
        let outcome = follow(&whole, Pose::new(0.0, 0.0, 0.0), speed);
        let late = outcome.errors.last().unwrap().abs();
        assert!(late < 0.03, "{late} m beside the circle {kappa} at {speed} m/s");
    }
}

/// A quintic over 60 m: curvature from the second derivative of the offset, which is small enough for that.
fn lane_change(s: f64) -> f64 {
    let curve = Quintic::between([0.0, 0.0, 0.0], [3.5, 0.0, 0.0], 60.0);
    if s < 20.0 {
        return 0.0;
    }
    let [_, slope, bend, _] = curve.evaluate(s - 20.0);
    let stretch = 1.0 + slope * slope;
    bend / (stretch * stretch.sqrt())
}

#[test]
fn a_lane_change_at_fifteen_metres_per_second() {
    let whole = motion(15.0, 10.0, lane_change, still);
    let outcome = follow(&whole, Pose::new(0.0, 0.0, 0.0), 15.0);
    assert!(
        outcome.p95() <= 0.10 && outcome.max() <= 0.15,
        "{}",
        report("lane change", &outcome)
    );
}

#[test]
fn it_stops_at_the_point_and_stands() {
    for (speed, braking, kappa) in [
        (10.0, 1.5, 0.0),
        (15.0, 3.0, 0.0),
        (5.0, 1.0, 0.05),
        (8.0, 4.0, 0.0),
    ] {
        let whole = motion(
            speed,
            2.0 + speed / braking + 4.0,
            |_| kappa,
            |t| if t < 2.0 { 0.0 } else { -braking },
        );
        let outcome = follow(&whole, Pose::new(0.0, 0.0, 0.0), speed);
        let goal = whole.last().unwrap().pose;
        let miss = goal.to_local(outcome.end.pose.position());
        assert_eq!(outcome.end.v, 0.0);
        assert!(
            miss.norm() < 0.1,
            "from {speed} m/s it stands {miss} beside the goal"
        );
    }
}

#[test]
fn it_starts_from_rest_without_shaking_the_wheels() {
    let whole = motion(
        0.0,
        12.0,
        |s| 0.08 * (s / 10.0).min(1.0),
        |t| if (1.0..=5.0).contains(&t) { 1.2 } else { 0.0 },
    );
    let outcome = follow(&whole, Pose::new(0.0, 0.0, 0.0), 0.0);
    assert!(outcome.max() <= 0.1, "{}", report("start", &outcome));
    let turns = |w: &&[f64]| (w[1] - w[0]) * (w[2] - w[1]) < -1e-9;
    let reversals = outcome.steers.windows(3).filter(turns).count();
    assert!(reversals < 20, "the wheels turned back {reversals} times");
    let standing = &outcome.steers[..40];
    assert!(standing.iter().all(|s| *s == 0.0), "no steering while it stands");
}

#[test]
fn from_beside_the_path_it_comes_back_without_overshoot() {
    for (speed, off) in [(1.0, 0.3), (3.0, -0.3), (8.0, 0.3), (15.0, 0.3), (25.0, -0.3)] {
        let whole = motion(speed, 40.0 / speed + 6.0, still, still);
        let outcome = follow(&whole, Pose::new(0.0, off, 0.0), speed);
        let beyond = outcome
            .errors
            .iter()
            .map(|e| -e * off.signum())
            .fold(0.0, f64::max);
        assert!(beyond < 0.1, "at {speed} m/s it overshoots by {beyond} m");
        assert!(
            outcome.errors.last().unwrap().abs() < 0.03,
            "at {speed} m/s it has not come back"
        );
    }
}

#[test]
fn a_path_far_away_is_approached_gently() {
    let whole = motion(6.0, 15.0, still, still);
    let outcome = follow(&whole, Pose::new(0.0, 4.0, 0.0), 6.0);
    assert!(outcome.errors.last().unwrap().abs() < 0.05);
    assert!(outcome.errors.iter().all(|e| *e > -0.3), "it overshoots");
}

#[test]
fn speed_follows_a_changing_trajectory() {
    let whole = motion(8.0, 20.0, still, |t| 1.5 * libm::sin(t * 2.0 * PI / 8.0));
    let outcome = follow(&whole, Pose::new(0.0, 0.0, 0.0), 8.0);
    let end = whole.last().unwrap();
    assert!(
        (outcome.end.v - end.v).abs() < 0.1,
        "{} is not {}",
        outcome.end.v,
        end.v
    );
    assert!(
        (outcome.end.pose.x - end.pose.x).abs() < 0.3,
        "{} is not {}",
        outcome.end.pose.x,
        end.pose.x
    );
}

#[test]
fn odd_trajectories_are_survived() {
    let tracker = Tracker::new(VehicleParams::default(), TrackerConfig::default());
    let ego = EgoState {
        pose: Pose::new(1.0, 2.0, 0.5),
        v: 3.0,
        a: 0.0,
        yaw_rate: 0.0,
        steer: 0.1,
    };
    let none = tracker.track(&ego, &[], 0.0);
    assert_eq!(
        none,
        Controls {
            steer: 0.1,
            acceleration: -6.0
        }
    );
    let point = TrajectoryPoint {
        t: 0.0,
        distance: 0.0,
        pose: ego.pose,
        kappa: 0.0,
        v: 0.0,
        a: 0.0,
    };
    for trajectory in [vec![point], vec![point; 5]] {
        let controls = tracker.track(&ego, &trajectory, 3.0);
        assert!(
            controls.steer.is_finite() && controls.acceleration < -1.0,
            "{controls:?}"
        );
    }
    let standing = EgoState { v: 0.0, ..ego };
    let held = tracker.track(&standing, &[point; 5], 0.0);
    assert_eq!(
        held,
        Controls {
            steer: 0.1,
            acceleration: -1.0
        }
    );
}
