//! The car and what it may run into: contact, being hit, and nothing where nothing is.

use super::*;
use crate::testing::{along, scenario};
use corridor_scenarios::scenario::Behaviour;

const DT: f64 = 0.01;

fn origin() -> Pose {
    Pose::new(0.0, 0.0, 0.0)
}

#[test]
fn running_into_a_parked_car_overlaps_once_and_throws_the_ego_back() {
    let parked = vec![Behaviour::Parked(Pose::new(30.0, 0.4, 0.0))];
    let mut world = World::new(&scenario(origin(), 8.0, parked), &PhysicsConfig::default());
    assert!(
        (world.clearance().map_or(f64::NAN, |c| c.0)).is_nan(),
        "nothing within ten metres"
    );
    let mut first = None;
    for k in 0..500 {
        let before = world.ego().v;
        world.step(Controls::default(), &[]);
        let gap = 27.7 - (world.ego().pose.x + 3.89);
        if first.is_none() {
            let near = world
                .clearance()
                .is_some_and(|(d, id)| (d - gap).abs() < 1e-6 && id == ObstacleId(0));
            assert!(
                near || gap > CLEARANCE_HORIZON || gap <= 0.0,
                "gap {gap}, clearance {:?}",
                world.clearance()
            );
        }
        if first.is_none() && world.overlaps().next().is_some() {
            first = Some((k, before));
        }
    }
    let (_, speed) = first.expect("it hits the car");
    assert!((speed - 8.0).abs() < 0.2, "it arrives at full speed: {speed}");
    assert!(
        world.ego().v < 2.0,
        "the parked car does not give way: {}",
        world.ego().v
    );
    assert_eq!(world.contacts_seen(), [ObstacleId(0)]);
}

#[test]
fn an_obstacle_that_drives_away_leaves_no_ghost_in_the_engine() {
    let line = crate::testing::line(&crate::testing::road(origin(), 0.0, 600.0));
    let mut others = vec![Behaviour::ConstantSpeed(along(&line, 6.4, 0.0, 20.0))];
    // A row of parked cars a hand's breadth beside the ego keeps the engine at work all the way.
    let parked = |k: u32| Behaviour::Parked(Pose::new(5.0 * f64::from(k), -2.155, 0.0));
    others.extend((0..12).map(parked));
    let scenario = scenario(origin(), 10.0, others);
    let mut world = World::new(&scenario, &PhysicsConfig::default());
    let mut agents = agents::Agents::new(&scenario);
    let mut engaged = 0;
    for _ in 0..500 {
        let moved = agents.advance(&world.ego(), DT);
        world.step(Controls::default(), moved);
        engaged += u32::from(world.obstacle_bodies[0].engaged);
        assert!(world.engine_in_step);
    }
    assert!(
        engaged > 0 && engaged < 100,
        "it starts near and drives away: {engaged}"
    );
    assert!(world.contacts_seen().is_empty(), "nobody was touched");
    assert!((world.obstacles()[0].pose.x - 106.4).abs() < 1e-6);
    assert!(
        (world.ego().pose.x - 50.0).abs() < 1e-6,
        "nothing stopped the ego"
    );
}

#[test]
fn a_car_that_drives_into_the_standing_ego_moves_it() {
    let line = crate::testing::line(&crate::testing::road(origin(), 0.0, 600.0));
    let others = vec![Behaviour::ConstantSpeed(along(&line, 10.0, 0.0, 6.0))];
    let scenario = scenario(Pose::new(60.0, 0.0, 0.0), 0.0, others);
    let mut world = World::new(&scenario, &PhysicsConfig::default());
    let mut agents = agents::Agents::new(&scenario);
    let mut contact = None;
    for k in 0..1200 {
        let moved = agents.advance(&world.ego(), DT);
        world.step(
            Controls {
                steer: 0.0,
                acceleration: -1.0,
            },
            moved,
        );
        if world.overlaps().next().is_some() {
            contact = contact.or(Some(f64::from(k + 1) * DT));
        }
    }
    let expected = (60.0 - 1.043 - 12.3) / 6.0;
    let seen = contact.expect("they meet");
    assert!(
        (seen - expected).abs() < 0.1,
        "contact at {seen}, expected at {expected}"
    );
    assert!(world.ego().pose.x > 61.0, "it is pushed along");
}
