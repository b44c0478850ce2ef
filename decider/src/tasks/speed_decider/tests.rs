//! One test a row of the specification's table, and the order of obstacles.

use super::*;
use crate::st_graph::{SpeedPoint, StPair};

fn profile(v: f64) -> SpeedData {
    let point = |k: i32| SpeedPoint {
        t: f64::from(k),
        s: v * f64::from(k),
        v,
        ..SpeedPoint::default()
    };
    SpeedData::new((0..=7).map(point).collect())
}

fn strip(pairs: &[(f64, f64, f64)]) -> StBoundary {
    let pairs = pairs.iter().map(|p| StPair::new(p.0, p.1, p.2)).collect();
    StBoundary::new(pairs).unwrap()
}

fn car(id: u32, boundary: &StBoundary) -> Object<'_> {
    Object {
        id: ObstacleId(id),
        boundary: Some(boundary),
        is_virtual: false,
        is_pedestrian: false,
        is_blocking: true,
        is_on_lane: true,
        speed: 8.0,
        velocity: Vec2::new(8.0, 0.0),
        station: (40.0, 45.0),
        offset: (-1.0, 1.0),
        decision: ObjectDecision::default(),
        reason: None,
    }
}

fn run(objects: &mut [Object], v: f64, main_stop_s: f64) -> Result<(), SpeedDeciderError> {
    run_at(objects, v, main_stop_s, 0.0, &mut PedestrianTimers::default())
}

fn run_at(
    objects: &mut [Object],
    v: f64,
    main_stop_s: f64,
    now: f64,
    timers: &mut PedestrianTimers,
) -> Result<(), SpeedDeciderError> {
    let profile = profile(v);
    let question = Question {
        profile: &profile,
        init_v: v,
        init_theta: 0.0,
        ego_start_s: 5.0,
        ego_length: 5.0,
        main_stop_s,
        now,
        front_station: &|s| 10.0 + s,
    };
    decide(&question, objects, timers)
}

fn decided(object: Object, v: f64) -> Option<Longitudinal> {
    let mut objects = [object];
    run(&mut objects, v, f64::INFINITY).unwrap();
    objects[0].decision.longitudinal
}

/// Drives ahead at 8 m/s.
fn ahead() -> StBoundary {
    strip(&[(0.0, 30.0, 36.0), (7.0, 86.0, 92.0)])
}

#[test]
fn a_leader_is_followed_at_two_and_a_half_seconds() {
    let ahead = ahead();
    let fence = Fence {
        distance: -20.0,
        s: 20.0,
    };
    assert_eq!(decided(car(1, &ahead), 8.0), Some(Longitudinal::Follow(fence)));
}

#[test]
fn a_slow_leader_who_is_near_is_stopped_for() {
    let near = strip(&[(0.0, 9.0, 15.0), (7.0, 80.0, 86.0)]);
    let slow = Object {
        speed: 1.0,
        ..car(1, &near)
    };
    let fence = Fence {
        distance: -6.0,
        s: 13.0,
    };
    assert_eq!(decided(slow, 8.0), Some(Longitudinal::Stop(fence)));
}

#[test]
fn who_crosses_ahead_is_let_pass_and_who_crosses_behind_is_passed() {
    let ahead = strip(&[(2.0, 30.0, 36.0), (3.0, 30.0, 36.0)]);
    let fence = Fence {
        distance: -5.0,
        s: 35.0,
    };
    assert_eq!(decided(car(1, &ahead), 8.0), Some(Longitudinal::Yield(fence)));
    let behind = strip(&[(5.0, 10.0, 16.0), (6.0, 10.0, 16.0)]);
    let fence = Fence {
        distance: 24.0,
        s: 44.0,
    };
    assert_eq!(decided(car(1, &behind), 8.0), Some(Longitudinal::Overtake(fence)));
}

#[test]
fn a_profile_through_an_obstacle_is_an_error_that_leaves_the_stop() {
    let (wall, ahead) = (strip(&[(0.0, 30.0, 36.0), (7.0, 30.0, 36.0)]), ahead());
    let mut objects = [car(1, &wall), car(2, &ahead)];
    let result = run(&mut objects, 8.0, f64::INFINITY);
    assert_eq!(result, Err(SpeedDeciderError::Crossing(ObstacleId(1))));
    let fence = Fence {
        distance: -6.0,
        s: 34.0,
    };
    assert_eq!(objects[0].decision.longitudinal, Some(Longitudinal::Stop(fence)));
    assert_eq!(objects[1].decision, ObjectDecision::default());
}

#[test]
fn a_zone_one_would_stand_in_is_stopped_before() {
    let zone = strip(&[(0.0, 20.0, 60.0), (7.0, 20.0, 60.0)]).with_kind(BoundaryType::KeepClear);
    let object = Object {
        is_virtual: true,
        is_blocking: false,
        station: (33.0, 73.0),
        ..car(1, &zone)
    };
    assert_eq!(
        decided(object, 10.0),
        Some(Longitudinal::Ignore),
        "it comes out of it"
    );
    let fence = Fence {
        distance: 0.0,
        s: 33.0,
    };
    assert_eq!(
        decided(object, 4.0),
        Some(Longitudinal::Ignore),
        "it is fast enough at the end"
    );
    let mut queue = [
        object,
        Object {
            station: (74.0, 79.0),
            boundary: None,
            ..car(2, &zone)
        },
    ];
    run(&mut queue, 10.0, f64::INFINITY).unwrap();
    assert_eq!(
        queue[0].decision.longitudinal,
        Some(Longitudinal::Stop(fence)),
        "it is queued behind"
    );
}

#[test]
fn one_stops_for_people_and_drives_on_when_they_only_stand_there() {
    let near = strip(&[(0.0, 8.0, 9.0), (7.0, 8.0, 9.0)]);
    let walker = Object {
        is_pedestrian: true,
        velocity: Vec2::zeros(),
        speed: 0.0,
        ..car(1, &near)
    };
    let mut timers = PedestrianTimers::default();
    let fence = Fence {
        distance: -6.0,
        s: 12.0,
    };
    for (now, wanted) in [
        (0.0, Some(Reason::Pedestrian)),
        (3.9, Some(Reason::Pedestrian)),
        (4.0, Some(Reason::TooClose)),
    ] {
        let mut objects = [walker];
        run_at(&mut objects, 1.0, f64::INFINITY, now, &mut timers).unwrap_or_default();
        if wanted == Some(Reason::Pedestrian) {
            assert_eq!(objects[0].decision.longitudinal, Some(Longitudinal::Stop(fence)));
            assert_eq!(objects[0].reason, wanted, "after {now} s");
        } else {
            assert_ne!(objects[0].reason, Some(Reason::Pedestrian), "after {now} s");
        }
    }
    let mut objects = [Object {
        velocity: Vec2::new(0.0, 1.0),
        ..walker
    }];
    run_at(&mut objects, 1.0, f64::INFINITY, 5.0, &mut timers).unwrap();
    assert!(timers.since.is_empty(), "who walks starts anew");
    let mut objects = [walker];
    run_at(&mut objects, 1.0, 11.0, 9.0, &mut timers).unwrap();
    assert!(
        objects[0].decision.is_ignored(),
        "something nearer is stopped for"
    );
}

#[test]
fn what_is_not_on_the_path_is_ignored_and_what_is_decided_stays() {
    let ahead = ahead();
    let absent = Object {
        boundary: None,
        ..car(1, &ahead)
    };
    assert_eq!(decided(absent, 8.0), Some(Longitudinal::Ignore));
    let mut object = car(1, &ahead);
    let stop = Longitudinal::Stop(Fence {
        distance: -6.0,
        s: 30.0,
    });
    object.decision.add_longitudinal(stop);
    assert_eq!(decided(object, 8.0), Some(stop));
    let off_lane = Object {
        is_virtual: true,
        is_on_lane: false,
        ..car(1, &ahead)
    };
    assert_eq!(decided(off_lane, 8.0), None);
}

#[test]
fn the_order_of_obstacles_does_not_matter() {
    let strips = [
        ahead(),
        strip(&[(2.0, 30.0, 36.0), (3.0, 30.0, 36.0)]),
        strip(&[(5.0, 10.0, 16.0), (6.0, 10.0, 16.0)]),
    ];
    let ids = [0_u32, 1, 2];
    let mut forward: Vec<Object> = ids
        .iter()
        .zip(&strips)
        .map(|(id, strip)| car(*id, strip))
        .collect();
    let mut backward: Vec<Object> = forward.iter().rev().copied().collect();
    run(&mut forward, 8.0, 60.0).unwrap();
    run(&mut backward, 8.0, 60.0).unwrap();
    let sorted = |objects: &[Object]| {
        let mut decisions: Vec<_> = objects
            .iter()
            .map(|object| (object.id, object.decision))
            .collect();
        decisions.sort_by_key(|decision| decision.0);
        decisions
    };
    assert_eq!(sorted(&forward), sorted(&backward));
}

#[test]
fn a_profile_of_one_point_is_none() {
    let mut timers = PedestrianTimers::default();
    let question = Question {
        profile: &SpeedData::new(vec![SpeedPoint::default()]),
        init_v: 0.0,
        init_theta: 0.0,
        ego_start_s: 0.0,
        ego_length: 5.0,
        main_stop_s: f64::INFINITY,
        now: 0.0,
        front_station: &|s| s,
    };
    assert_eq!(
        decide(&question, &mut [], &mut timers),
        Err(SpeedDeciderError::NoProfile)
    );
}
