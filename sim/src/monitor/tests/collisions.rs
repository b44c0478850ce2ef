//! Every class of collision, who is to blame, and what could have been avoided.

use super::fixture::*;
use crate::monitor::Motion;
use crate::verdict::{Collision, CollisionClass, Ending};
use corridor_decider::frame::EgoState;
use corridor_decider::geometry::Pose;
use corridor_scenarios::scenario::Expectation;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

const NOWHERE: [Pose; 1] = [Pose::new(0.0, 0.0, 0.0)];

/// The first collision when the ego and one car move on straight at their velocities for 3 s.
fn collide(ego: EgoState, car: Motion) -> Option<Collision> {
    let mut run = Run::new(scenario(&NOWHERE, Expectation::Progress(100.0)));
    let ego_at = |t: f64| EgoState {
        pose: ego.pose.advanced(ego.v * t),
        ..ego
    };
    let car_at = |t: f64| {
        let pose = car.pose;
        let pose = Pose::new(
            pose.x + car.velocity.x * t,
            pose.y + car.velocity.y * t,
            pose.theta,
        );
        vec![Motion { pose, ..car }]
    };
    run.drive(3.0, ego_at, car_at);
    let verdict = run.verdict();
    if verdict.ending == Ending::Collision {
        assert!(!verdict.pass && !run.metric("no_collision").pass && run.metric("no_collision").gate);
        assert_eq!(
            run.metric("no_at_fault_collision").pass,
            !verdict.collisions[0].at_fault
        );
        assert!(verdict.summary.contains("car_0"), "{}", verdict.summary);
    }
    verdict.collisions.first().cloned()
}

fn class(ego: EgoState, car: Motion) -> (CollisionClass, bool) {
    let collision = collide(ego, car).expect("they collide");
    (collision.class, collision.at_fault)
}

#[test]
fn a_standing_ego_that_is_hit_is_not_to_blame() {
    let standing = class(ego(50.0, 0.0, 0.0, 0.05), motion(65.0, 0.0, PI, 8.0));
    assert_eq!(standing, (CollisionClass::StoppedEgo, false));
    let creeping = class(ego(50.0, 0.0, 0.0, 0.051), motion(65.0, 0.0, PI, 8.0));
    assert_eq!(creeping, (CollisionClass::ActiveFront, true));
}

#[test]
fn running_into_a_standing_car_is_to_blame_and_avoidable() {
    let collision = collide(ego(50.0, 0.0, 0.0, 8.0), motion(75.0, 0.5, 0.2, 0.0)).unwrap();
    assert_eq!(
        (collision.class, collision.at_fault),
        (CollisionClass::StoppedTrack, true)
    );
    assert!(collision.avoidable && (collision.delta_v - 8.0).abs() < 1e-12);
    let creeping = class(ego(50.0, 0.0, 0.0, 8.0), motion(65.0, 0.5, 0.2, 0.051));
    assert_eq!(creeping, (CollisionClass::ActiveFront, true));
}

#[test]
fn a_car_that_jumps_out_cannot_be_avoided() {
    // From the side, 3 m ahead of the bumper of an ego at 8 m/s: it needs 5.3 m to stop.
    let crossing = motion(58.5, -4.4, FRAC_PI_2, 5.0);
    let collision = collide(ego(50.0, 0.0, 0.0, 8.0), crossing).unwrap();
    assert!(!collision.avoidable, "{collision:?}");
    // The same, seen from far enough.
    let early = collide(ego(40.0, 0.0, 0.0, 8.0), motion(59.0, -9.0, FRAC_PI_2, 4.0)).unwrap();
    assert!(early.avoidable, "{early:?}");
}

#[test]
fn whoever_is_hit_from_behind_is_not_to_blame() {
    let found = class(ego(50.0, 0.0, 0.0, 3.0), motion(40.0, 0.0, 0.0, 9.0));
    assert_eq!(found, (CollisionClass::ActiveRear, false));
}

#[test]
fn side_by_side_blame_depends_on_the_lane() {
    // The other drifts into an ego that keeps its lane.
    let kept = class(ego(50.0, 0.0, 0.0, 8.0), motion(51.0, 3.0, -0.15, 8.0));
    assert_eq!(kept, (CollisionClass::ActiveLateral, false));
    // The same while the ego straddles the lane line.
    let straddling = class(ego(50.0, 1.5, 0.0, 8.0), motion(51.0, 4.5, -0.15, 8.0));
    assert_eq!(straddling, (CollisionClass::ActiveLateral, true));
    // The same with the ego off the road by 0.305 m, and by 0.295 m.
    let off = class(ego(50.0, -1.0, 0.0, 8.0), motion(51.0, 2.0, -0.15, 8.0));
    assert_eq!(off, (CollisionClass::ActiveLateral, true));
    let just_on = class(ego(50.0, -0.99, 0.0, 8.0), motion(51.0, 2.0, -0.15, 8.0));
    assert_eq!(just_on, (CollisionClass::ActiveLateral, false));
}

#[test]
fn touching_is_not_yet_colliding_and_clearance_warns_below_its_limit() {
    let beside = |gap: f64| {
        let mut run = Run::new(scenario(&NOWHERE, Expectation::Progress(100.0)));
        let car = motion(51.0, 1.055 + 0.9 + gap, 0.0, 0.0);
        run.step(ego(50.0, 0.0, 0.0, 8.0), vec![car]);
        run
    };
    assert_eq!(beside(1e-9).ending(), None);
    assert_eq!(beside(-1e-3).ending(), Some(Ending::Collision));
    assert!(beside(0.401).metric("min_clearance").pass);
    let warned = beside(0.399).metric("min_clearance");
    assert!(!warned.pass && !warned.gate && warned.worst_obstacle.as_deref() == Some("car_0"));
}

proptest! {
    /// Left and right are alike: the mirrored contact has the class, speed and avoidability of the original.
    #[test]
    fn classes_are_the_same_in_the_mirror(
        theta in -0.2..0.2f64, v in 0.0..12.0f64,
        x in -12.0..14.0f64, y in -6.0..6.0f64, heading in -3.1..3.1f64, speed in 0.0..12.0f64,
    ) {
        let (car, state) = (motion(50.0 + x, y, heading, speed), ego(50.0, 0.0, theta, v));
        let one = collide(state, car);
        let other = collide(ego(50.0, 0.0, -theta, v), mirrored(car));
        prop_assert_eq!(one.is_some(), other.is_some());
        if let (Some(one), Some(other)) = (one, other) {
            prop_assert_eq!((one.class, one.avoidable), (other.class, other.avoidable));
            prop_assert!((one.delta_v - other.delta_v).abs() < 1e-9);
        }
    }
}
