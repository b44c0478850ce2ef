//! Surrogate safety measures against closed forms of simple motions, and against what they must not depend on.

use super::fixture::*;
use crate::monitor::Motion;
use crate::verdict::Metric;
use corridor_decider::frame::{EgoState, ObstacleId, ObstacleKind};
use corridor_decider::geometry::Pose;
use corridor_scenarios::scenario::{Behaviour, Expectation, Waypoint};
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// Front bumper and rear of the ego's axle, half its width; half length and half width of a car, m.
const FRONT: f64 = 3.89;
const REAR: f64 = 1.043;
const HALF: f64 = 1.055;
const CAR: (f64, f64) = (2.25, 0.9);

/// A run with this many cars that may move.
fn run(cars: usize) -> Run {
    let poses = vec![Pose::new(0.0, 0.0, 0.0); cars];
    let mut scenario = scenario(&poses, Expectation::Progress(1e6));
    for obstacle in &mut scenario.obstacles {
        let waypoint = Waypoint {
            t: 0.0,
            pose: Pose::new(0.0, 0.0, 0.0),
        };
        obstacle.behaviour = Behaviour::Waypoints(vec![waypoint]);
    }
    Run::new(scenario)
}

/// Everyone goes straight on at their velocity.
fn straight_on(ego: EgoState, cars: &[Motion], duration: f64) -> Run {
    let mut run = run(cars.len());
    go(&mut run, ego, cars, duration);
    run
}

fn go(run: &mut Run, ego: EgoState, cars: &[Motion], duration: f64) {
    let moved = |car: &Motion, t: f64| {
        let (pose, v) = (car.pose, car.velocity);
        Motion {
            pose: Pose::new(pose.x + v.x * t, pose.y + v.y * t, pose.theta),
            ..*car
        }
    };
    run.drive(
        duration,
        |t| EgoState {
            pose: ego.pose.advanced(ego.v * t),
            ..ego
        },
        |t| cars.iter().map(|car| moved(car, t)).collect(),
    );
}

/// One sample of an ego at 8 m/s with a car that goes the same way, `gap` ahead.
fn behind(gap: f64, y: f64, v: f64) -> Run {
    let car = motion(50.0 + FRONT + gap + CAR.0, y, 0.0, v);
    let mut run = run(1);
    run.drive(0.1, |_| ego(50.0, 0.0, 0.0, 8.0), |_| vec![car]);
    run
}

#[test]
fn following_measures_are_the_closed_forms() {
    let found = behind(20.0, 0.0, 3.0);
    assert!((found.value("ssm_ttc") - 4.0).abs() < 1e-9 && found.metric("ssm_ttc").pass);
    assert!((found.value("drac") - 25.0 / 40.0).abs() < 1e-9 && found.metric("drac").pass);
    assert_eq!(found.metric("drac").worst_obstacle.as_deref(), Some("car_0"));
    for (gap, pass) in [(24.1, true), (23.9, false)] {
        assert_eq!(behind(gap, 0.0, 0.0).metric("ssm_ttc").pass, pass);
    }
    for (gap, pass) in [(10.7, true), (10.6, false)] {
        assert_eq!(behind(gap, 0.0, 0.0).metric("drac").pass, pass);
    }
    // 64 / (2 (gap − 8)) against 3.4: from 17.41 m on.
    for (gap, count) in [(17.42, 0.0), (17.40, 1.0), (7.9, 1.0)] {
        assert!(
            (behind(gap, 0.0, 0.0).value("mdrac_count") - count).abs() < 1e-12,
            "{gap}"
        );
    }
    assert_eq!(
        behind(5.0, 0.0, 8.0).metric("drac").value,
        None,
        "nobody gets nearer"
    );
    assert_eq!(
        behind(5.0, HALF + CAR.1 + 1e-3, 0.0).metric("drac").value,
        None,
        "beside"
    );
    assert!(
        behind(5.0, -(HALF + CAR.1 - 1e-3), 0.0)
            .metric("drac")
            .value
            .is_some()
    );
    let oncoming = behind(50.0, 0.0, -2.0);
    assert!(
        (oncoming.value("ssm_ttc") - 5.0).abs() < 1e-9,
        "they close at 10 m/s"
    );
}

#[test]
fn what_the_front_is_past_is_not_ahead() {
    let car = motion(50.0 + 8.0, -1.0, 0.0, 0.0);
    let mut run = run(1);
    // Its rear right corner is at -0.94, its front one at 0.11; the car reaches to -0.1.
    run.drive(0.1, |_| ego(50.0, 0.1, 0.3, 8.0), |_| vec![car]);
    assert!(
        run.metric("ssm_ttc").value.is_none(),
        "{:?}",
        run.metric("ssm_ttc")
    );
}

/// The ego clears the strip that a crossing car takes `delay` later.
fn crossing(delay: f64) -> Run {
    // The ego's rear leaves the strip |x − 80| <= 0.9 when its axle is at 80.9 + 1.043.
    let (v, w) = (8.0, 6.0);
    let leaves = (80.0 + CAR.1 + REAR - 50.0) / v;
    // The car's front enters the ego's strip at y = −1.055.
    let start = -HALF - CAR.0 - w * (leaves + delay);
    straight_on(
        ego(50.0, 0.0, 0.0, v),
        &[motion(80.0, start, FRAC_PI_2, w)],
        leaves + delay + 2.0,
    )
}

#[test]
fn post_encroachment_is_the_time_between_leaving_and_taking() {
    for delay in [0.35, 0.8, 1.5, 1.79, 2.4, 4.0] {
        let pet = crossing(delay).metric("pet");
        let late = pet.value.unwrap() - delay;
        assert!((-1e-9..0.2 + 1e-9).contains(&late), "{delay}: {pet:?}");
        assert_eq!(pet.worst_obstacle.as_deref(), Some("car_0"));
        assert!(!pet.gate);
    }
    assert!(!crossing(1.5).metric("pet").pass && crossing(2.4).metric("pet").pass);
    assert_eq!(crossing(5.5).metric("pet").value, None, "nobody remembers");
    let following = straight_on(ego(50.0, 0.0, 0.0, 8.0), &[motion(65.0, 0.0, 0.0, 8.0)], 5.0);
    assert_eq!(
        following.metric("pet").value,
        None,
        "a distance, not an encroachment"
    );
}

/// The car may also come first: roles of the two do not matter.
#[test]
fn post_encroachment_knows_no_first() {
    let (v, w, delay) = (8.0, 6.0, 1.25);
    let enters = (80.0 - CAR.1 - FRONT - 50.0) / v;
    let start = HALF + CAR.0 - w * (enters - delay);
    let car = motion(80.0, start, FRAC_PI_2, w);
    let pet = straight_on(ego(50.0, 0.0, 0.0, v), &[car], 8.0).value("pet");
    assert!((-1e-9..0.2 + 1e-9).contains(&(pet - delay)), "{pet}");
}

fn dangerous(scenario_parked: bool, gap: f64, y: f64) -> Metric {
    let car = motion(50.0 + FRONT + gap + CAR.0, y, 0.0, 0.0);
    let mut run = if scenario_parked {
        Run::new(scenario(&[car.pose], Expectation::Progress(1e6)))
    } else {
        run(1)
    };
    run.drive(0.1, |_| ego(50.0, 0.0, 0.0, 10.0), |_| vec![car]);
    assert_eq!(
        run.metric("rss_dangerous").pass,
        run.value("rss_dangerous") <= 0.0
    );
    run.metric("rss_dangerous")
}

#[test]
fn danger_is_neither_along_nor_across_at_a_safe_distance() {
    let beside = |gap| HALF + CAR.1 + gap;
    // 34.53 m along for 10 m/s, 0.225 m across from who never moves, 0.125 + 0.5 + 0.1 m from who may.
    assert!(!dangerous(true, 34.5, 0.0).pass && dangerous(true, 34.6, 0.0).pass);
    assert!(!dangerous(true, 10.0, beside(0.22)).pass && dangerous(true, 10.0, beside(0.23)).pass);
    assert!(!dangerous(false, 10.0, -beside(0.72)).pass && dangerous(false, 10.0, -beside(0.73)).pass);
    assert!(!dangerous(true, 34.5, 0.0).gate);
}

#[test]
fn a_response_is_due_after_the_response_time() {
    let respond = |braking: f64, duration: f64| {
        let mut run = run(1);
        let car = motion(50.0 + FRONT + 30.0 + CAR.0, 0.0, 0.0, 0.0);
        let state = EgoState {
            a: -braking,
            ..ego(50.0, 0.0, 0.0, 10.0)
        };
        run.drive(duration, |_| state, |_| vec![car]);
        assert!((run.value("rss_dangerous") - duration).abs() < 1e-9);
        run.value("rss_violation")
    };
    assert!(respond(0.0, 1.0).abs() < 1e-9, "not due yet");
    assert!((respond(0.0, 1.5) - 0.5).abs() < 1e-9);
    assert!((respond(3.9, 1.5) - 0.5).abs() < 1e-9);
    assert!(respond(4.0, 1.5).abs() < 1e-9);
}

/// Who comes from behind or from the side has to see to it himself.
#[test]
fn the_ego_does_not_brake_for_who_is_behind() {
    let run = straight_on(ego(50.0, 0.0, 0.0, 8.0), &[motion(35.0, 0.0, 0.0, 8.0)], 4.0);
    assert!(run.value("rss_dangerous") > 3.0 && run.value("rss_violation").abs() < 1e-9);
}

#[test]
fn a_contact_takes_half_the_velocity_and_its_energy() {
    let run = straight_on(ego(50.0, 0.0, 0.0, 8.0), &[motion(75.0, 0.5, 0.2, 0.0)], 5.0);
    assert!((run.value("delta_v") - 4.0).abs() < 1e-9);
    assert!(
        (run.value("impact_energy") - 32.0).abs() < 1e-9,
        "½ · 1000 kg · 8² in kJ"
    );
    let hit = run.metric("delta_v");
    assert!(hit.worst_obstacle.as_deref() == Some("car_0") && hit.worst_t.is_some() && !hit.gate);
    let free = straight_on(ego(50.0, 0.0, 0.0, 8.0), &[motion(75.0, 9.0, 0.0, 0.0)], 1.0);
    assert_eq!(
        (free.metric("delta_v").value, free.metric("pet").value),
        (None, None)
    );
}

/// A cone is a thing: one contact with it halves nuPlan's score, one with a car takes it all.
#[test]
fn things_count_half() {
    let hit = |kind: ObstacleKind| {
        let mut scenario = scenario(&[Pose::new(75.0, 0.0, 0.0)], Expectation::Standstill);
        scenario.obstacles[0].kind = kind;
        let mut run = Run::new(scenario);
        go(
            &mut run,
            ego(50.0, 0.0, 0.0, 8.0),
            &[motion(75.0, 0.0, 0.0, 0.0)],
            4.0,
        );
        assert!(!run.metric("ttc").pass && run.value("ext_cls").abs() < 1e-12);
        run.value("nuplan_cls")
    };
    let rest = 11.0 / 16.0;
    assert!((hit(ObstacleKind::Cone) - rest / 2.0).abs() < 1e-9);
    assert!((hit(ObstacleKind::Other) - rest / 2.0).abs() < 1e-9);
    assert!(hit(ObstacleKind::Car).abs() < 1e-12 && hit(ObstacleKind::Pedestrian).abs() < 1e-12);
}

#[test]
fn tr1_is_the_sum_of_its_integrals() {
    let cost = |state: &dyn Fn(f64) -> EgoState, cars: Vec<Motion>| {
        let mut run = run(cars.len());
        run.drive(2.1, state, |_| cars.clone());
        run.value("tr1")
    };
    // 21 samples from 0.1 to 2.1 s: 2 s.
    let still = |_: f64| ego(50.0, 0.0, 0.0, 8.0);
    assert!(cost(&still, Vec::new()).abs() < 1e-9);
    let jerk = cost(
        &|t| EgoState {
            a: 0.5 * t,
            ..still(t)
        },
        Vec::new(),
    );
    assert!((jerk - 0.01 * 0.25 * 2.0).abs() < 1e-9);
    let steering = cost(
        &|t| EgoState {
            steer: 0.1 * t,
            ..still(t)
        },
        Vec::new(),
    );
    assert!((steering - 22.0 * 0.01 * 2.0).abs() < 1e-9);
    let offset = cost(&|_| ego(50.0, -0.4, 0.0, 8.0), Vec::new());
    assert!((offset - 0.5 * 0.16 * 2.0).abs() < 1e-9);
    let near = cost(&still, vec![motion(50.0 + FRONT + 5.0 + CAR.0, 0.0, 0.0, 8.0)]);
    assert!((near - 8.0 * libm::exp(-1.0) * 2.0).abs() < 1e-9);
}

/// What has no side and no lane in it.
const MIRRORED: [&str; 12] = [
    "min_clearance",
    "rss_lon",
    "rss_lat",
    "rss_dangerous",
    "rss_violation",
    "ssm_ttc",
    "drac",
    "mdrac_count",
    "pet",
    "delta_v",
    "impact_energy",
    "tr1",
];

fn same(name: &str, one: &Metric, other: &Metric) -> bool {
    let near = |a: Option<f64>, b: Option<f64>| match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-6 * (1.0 + a.abs()),
        (a, b) => a == b,
    };
    assert_eq!(one.name, name);
    near(one.value, other.value) && one.pass == other.pass
}

/// The time until two boxes along the axes touch, the first at rest.
fn closed_form(gap: (f64, f64), size: (f64, f64), v: (f64, f64)) -> Option<f64> {
    let axis = |gap: f64, size: f64, v: f64| {
        if v.abs() < 1e-12 {
            return (gap.abs() < size).then_some((0.0, f64::INFINITY));
        }
        let (a, b) = ((-size - gap) / v, (size - gap) / v);
        Some((a.min(b), a.max(b)))
    };
    let (x, y) = (axis(gap.0, size.0, v.0)?, axis(gap.1, size.1, v.1)?);
    let (enter, leave) = (x.0.max(y.0), x.1.min(y.1));
    (enter < leave && leave > 0.0).then_some(enter.max(0.0))
}

fn any_car() -> impl Strategy<Value = Motion> {
    (40.0..110.0f64, -7.0..7.0f64, -3.1..3.1f64, 0.0..9.0f64)
        .prop_map(|(x, y, theta, v)| motion(x, y, theta, v))
}

proptest! {
    /// Boxes along the axes meet when the later of their two intervals begins; nuPlan sees it at its next step.
    #[test]
    fn time_to_collision_is_the_closed_form(
        x in 6.5..40.0f64, y in -1.5..1.5f64, v in 0.5..12.0f64, w in -8.0..8.0f64,
    ) {
        let mut run = run(1);
        let middle = (FRONT - REAR) / 2.0;
        let car = motion(50.0 + middle + x, y, 0.0, w);
        run.drive(0.1, |_| ego(50.0, 0.0, 0.0, v), |_| vec![car]);
        let size = (f64::midpoint(FRONT, REAR) + CAR.0, HALF + CAR.1);
        let expected = closed_form((x, y), size, (w - v, 0.0)).filter(|t| *t < 3.0);
        match (run.metric("ttc").value, expected) {
            (Some(found), Some(expected)) => {
                prop_assert!((-1e-9..0.1 + 1e-9).contains(&(found - expected)), "{found} {expected}");
                let following = run.value("ssm_ttc");
                prop_assert!((following - expected).abs() < 1e-9, "{following} {expected}");
            }
            (None, None) => (),
            // A contact in the last step before the horizon, which counts as none or as one.
            (found, expected) => prop_assert!(expected.or(found).is_some_and(|t| t > 2.89)),
        }
    }

    #[test]
    fn left_and_right_are_alike(
        cars in proptest::collection::vec(any_car(), 1..4),
        y in -1.5..1.5f64, theta in -0.2..0.2f64, v in 0.0..9.0f64, a in -5.0..2.0f64,
    ) {
        let state = |side: f64| EgoState { a, ..ego(50.0, side * y, side * theta, v) };
        let here = straight_on(state(1.0), &cars, 4.0);
        let turned: Vec<Motion> = cars.into_iter().map(mirrored).collect();
        let there = straight_on(state(-1.0), &turned, 4.0);
        for name in MIRRORED {
            let (one, other) = (here.metric(name), there.metric(name));
            prop_assert!(same(name, &one, &other), "{one:?} {other:?}");
            prop_assert_eq!(one.worst_obstacle, other.worst_obstacle);
        }
    }

    /// Whoever is listed first is treated as the rest.
    #[test]
    fn the_order_of_obstacles_does_not_matter(
        cars in proptest::collection::vec(any_car(), 2..5), v in 0.0..9.0f64, shift in 1usize..4,
    ) {
        let state = ego(50.0, 0.3, 0.02, v);
        let here = straight_on(state, &cars, 4.0);
        let count = cars.len();
        let mut turned = cars;
        turned.rotate_left(shift % count);
        let there = straight_on(state, &turned, 4.0);
        let (here, there) = (here.verdict().metrics, there.verdict().metrics);
        prop_assert_eq!(here.len(), there.len());
        for (one, other) in here.iter().zip(&there) {
            prop_assert!(same(&one.name, one, other), "{one:?} {other:?}");
            prop_assert_eq!(one.worst_t, other.worst_t, "{}", one.name);
        }
    }
}

#[test]
fn the_obstacle_of_the_worst_moment_is_named() {
    let far = motion(150.0, 0.0, 0.0, 0.0);
    let near = motion(70.0, 0.5, 0.0, 2.0);
    let mut run = run(2);
    run.drive(0.1, |_| ego(50.0, 0.0, 0.0, 9.0), |_| vec![far, near]);
    for name in ["rss_lon", "ssm_ttc", "drac", "min_clearance", "ttc"] {
        assert_eq!(
            run.metric(name).worst_obstacle.as_deref(),
            Some("car_1"),
            "{name}"
        );
    }
    assert_eq!(ObstacleId(1), run.scenario.obstacles[1].id);
}
