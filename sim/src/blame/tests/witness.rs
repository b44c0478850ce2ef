//! The check of a witness finds what is wrong with one.

use super::scene::{mover, start, surroundings};
use crate::blame::car::{CarState, Limits};
use crate::blame::search::{Answer, Grid, Question};
use crate::blame::tracks::Surroundings;
use crate::blame::witness::Witness;
use crate::testing;
use corridor_decider::geometry::{Pose, Vec2};

/// A car drives at a wall 30 m ahead of its nose; beside it another keeps pace.
fn scene() -> (Surroundings, Limits, CarState) {
    let wall = corridor_scenarios::scenario::Behaviour::Parked(Pose::new(66.2, 0.0, 0.0));
    let beside = mover(Pose::new(30.0, 2.4, 0.0), Pose::new(60.0, 2.4, 0.0));
    let scenario = testing::scenario(Pose::new(30.0, 0.0, 0.0), 10.0, vec![wall, beside]);
    let (car, limits) = start(&scenario);
    (surroundings(&scenario, 4.0), limits, car)
}

fn witness(surroundings: &Surroundings, limits: &Limits, car: CarState) -> Witness {
    let grid = Grid::default();
    let ask = Question {
        surroundings,
        limits,
        grid: &grid,
        body: surroundings.body(),
        start: car,
        samples: (0, 200),
        budget: 10_000,
    };
    match ask.answer() {
        Answer::Survives(witness) => witness,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_witness_passes_and_each_way_to_spoil_it_is_found() {
    let (surroundings, limits, car) = scene();
    let good = witness(&surroundings, &limits, car);
    assert_eq!(good.check(&surroundings, &limits), Ok(()));
    assert_eq!(good.states.len(), 201);
    let spoilt = |spoil: &dyn Fn(&mut CarState)| {
        let mut bad = good.clone();
        spoil(&mut bad.states[100]);
        bad.check(&surroundings, &limits).unwrap_err()
    };
    assert!(spoilt(&|car| car.v += 1.0).contains("accelerates"));
    assert!(spoilt(&|car| car.kappa += 0.1).contains("turns the wheels"));
    assert!(spoilt(&|car| car.place += Vec2::new(0.0, 0.01)).contains("moves"));
    assert!(spoilt(&|car| car.forward = Vec2::new(0.6, 0.8)).contains("turns by"));
}

#[test]
fn a_motion_through_others_or_off_the_road_is_no_witness() {
    let (surroundings, limits, car) = scene();
    let drive = |kappa: f64| {
        let command = crate::blame::car::Command {
            acceleration: 0.0,
            kappa,
        };
        let mut states = vec![car];
        for _ in 0..200 {
            let last = states[states.len() - 1];
            states.push(last.advanced(command, &limits, surroundings.dt));
        }
        Witness { first: 0, states }
            .check(&surroundings, &limits)
            .unwrap_err()
    };
    assert!(drive(0.0).contains("overlaps `car 0`"));
    assert!(drive(0.02).contains("overlaps `car 1`"));
    assert!(drive(-0.02).contains("off the road"));
}
