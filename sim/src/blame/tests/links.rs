//! Whose fault made-up runs are.

use crate::blame::avoidance::Avoidable;
use crate::blame::recorder::Recording;
use crate::blame::{Blame, Failure, Link, Replaced, blame};
use crate::settings::{Prediction, Settings, Tracking};
use crate::testing::{along, line, scenario};
use corridor_decider::geometry::{Pose, Vec2};
use corridor_scenarios::scenario::{Behaviour, Trigger};

fn straight() -> Pose {
    Pose::new(30.0, 0.0, 0.0)
}

/// A wall across the road whose near side is `ahead` of the ego's bumper.
fn wall(ahead: f64) -> Vec<Behaviour> {
    let x = 30.0 + 3.89 + ahead + 2.3;
    vec![Behaviour::Parked(Pose::new(x, 0.0, 0.0))]
}

#[test]
fn what_nobody_can_brake_for_is_the_scenarios_fault() {
    // 14 m/s need 16 m to stop; beside the wall there is no way within 5 m.
    let blame = blame(&scenario(straight(), 14.0, wall(5.0)), &Settings::default()).unwrap();
    assert_eq!(blame.avoidable, Avoidable::No, "{blame}");
    assert_eq!(blame.whose, Link::Scenario);
    assert!(blame.to_string().contains("unavoidable"), "{blame}");
}

#[test]
fn a_mirrored_world_is_not_the_scenarios_fault_and_the_last_moment_is_that_of_braking() {
    let parked = vec![Behaviour::Parked(Pose::new(110.0, -2.0, 0.0))];
    let settings = Settings::with(&["fault=mirrored".to_owned()]).unwrap();
    let Blame {
        failure,
        time,
        avoidable,
        whose,
        ..
    } = blame(&scenario(straight(), 10.0, parked), &settings).unwrap();
    assert!(
        matches!(failure, Failure::Collision { at_fault: true, .. }),
        "{failure}"
    );
    let Avoidable::Yes {
        until: Some(until),
        by: Some(by),
    } = avoidable
    else {
        panic!("{avoidable}")
    };
    // At about 10 m/s braking takes 1.7 s, a step aside of half a metre less than one.
    assert!((0.3..1.8).contains(&(time - until)), "{time} {until}");
    assert!(by.speed < 0.0 || by.left > 0.1, "{by}: the car is on the right");
    assert_eq!(whose, Link::Bound);
}

#[test]
fn a_perfect_tracker_puts_the_ego_on_its_trajectory() {
    let settings = Settings {
        tracker: Tracking::Perfect,
        ..Settings::default()
    };
    let parked = vec![Behaviour::Parked(Pose::new(90.0, -2.3, 0.0))];
    let recording = Recording::of(&scenario(Pose::new(30.0, 0.4, 0.05), 8.0, parked), &settings);
    let mut most = 0.0_f64;
    for (frame, decision) in &recording.ticks {
        for point in &decision.trajectory {
            let sample = recording.sample_at(frame.time + point.t);
            let during = point.t > 0.005 && point.t < 0.1 + 1e-6;
            if let Some(ego) = recording.ego.get(sample).filter(|_| during) {
                most = most.max((ego.pose.position() - point.pose.position()).norm());
            }
        }
    }
    assert!(recording.verdict.pass, "{}", recording.verdict.summary);
    assert!(most < 1e-9, "{most} m off");
    let driven = Recording::of(&recording.surroundings.scenario, &Settings::default());
    assert_ne!(driven.ego, recording.ego, "the usual tracker has errors");
}

#[test]
fn true_futures_are_what_then_happens() {
    let behaviours = |line| {
        vec![
            Behaviour::ConstantSpeed(along(line, 90.0, 0.0, 8.0)),
            Behaviour::Pedestrian {
                from: Vec2::new(160.0, -6.0),
                to: Vec2::new(160.0, 9.0),
                speed: 1.5,
                trigger: Trigger::Time(1.0),
            },
        ]
    };
    let mut scene = scenario(straight(), 8.0, Vec::new());
    let line = line(&scene.map);
    scene.obstacles = (0_u32..)
        .zip(behaviours(&line))
        .map(|(id, behaviour)| crate::testing::car(id, behaviour))
        .collect();
    let worst = |prediction| {
        let settings = Settings {
            prediction,
            ..Settings::default()
        };
        let recording = Recording::of(&scene, &settings);
        let mut worst = 0.0_f64;
        for (frame, _) in &recording.ticks {
            for (obstacle, predicted) in frame
                .obstacles
                .iter()
                .flat_map(|o| o.prediction.iter().map(move |p| (o, p)))
            {
                let sample = recording.sample_at(frame.time + predicted.t);
                if sample < recording.ego.len() {
                    let there = recording.surroundings.tracks[obstacle.id.0 as usize].pose(sample);
                    worst = worst.max((there.place - predicted.pose.position()).norm());
                }
            }
        }
        worst
    };
    let (told, expected) = (worst(Prediction::TrueFuture), worst(Prediction::Expected));
    assert!(told < 1e-3, "{told} m off");
    assert!(
        expected > 1.0,
        "nobody expects the pedestrian to walk: {expected} m off"
    );
}

#[test]
fn each_replacement_is_made_once_and_not_where_it_is_made_already() {
    let kinds = |settings: &Settings, others: &[Behaviour]| {
        let mut behaviours = wall(5.0);
        behaviours.extend_from_slice(others);
        let blame = blame(&scenario(straight(), 14.0, behaviours), settings).unwrap();
        blame.runs.iter().map(|run| run.replaced).collect::<Vec<_>>()
    };
    let all = [Replaced::Prediction, Replaced::Tracker, Replaced::Planner];
    let walker = Behaviour::Pedestrian {
        from: Vec2::new(400.0, -6.0),
        to: Vec2::new(400.0, 9.0),
        speed: 1.5,
        trigger: Trigger::Time(1.0),
    };
    assert_eq!(kinds(&Settings::default(), &[walker]), all);
    assert_eq!(kinds(&Settings::default(), &[]), all[1..], "nobody to predict");
    let perfect = Settings {
        tracker: Tracking::Perfect,
        ..Settings::default()
    };
    assert_eq!(kinds(&perfect, &[]), [Replaced::Planner]);
}

#[test]
fn a_run_that_passes_is_nobodys_fault() {
    assert_eq!(
        blame(&scenario(straight(), 10.0, Vec::new()), &Settings::default()),
        None
    );
}
