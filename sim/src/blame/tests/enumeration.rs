//! The search against all motions of small grids, tried one after another by a code of its own.

use super::scene::{Stir, random, start, surroundings};
use crate::blame::avoidance::SLACK;
use crate::blame::car::CarState;
use crate::blame::search::{Answer, Grid, Question, Steer, samples_in};
use crate::blame::tracks::{OFF_ROAD, Surroundings};

/// How many steps motions have.
const STEPS: usize = 4;

fn small(cell: [f64; 4]) -> Grid {
    Grid {
        step: 0.5,
        accelerations: vec![-1.0, 1.0],
        steers: vec![Steer::Along, Steer::Share(0.5), Steer::Share(-0.5)],
        cell,
    }
}

/// Cells so small that no two states share one.
const DISTINCT: [f64; 4] = [1e-7; 4];

fn question<'a>(
    surroundings: &'a Surroundings,
    limits: &'a crate::blame::car::Limits,
    grid: &'a Grid,
    car: CarState,
) -> Question<'a> {
    let samples = samples_in(grid.step, surroundings.dt) * STEPS;
    Question {
        surroundings,
        limits,
        grid,
        body: surroundings.body(),
        start: car,
        samples: (0, samples),
        budget: usize::MAX,
    }
}

/// Whether the car is clear of everybody and on the road at a sample, by the polygons of the geometry.
fn is_safe(surroundings: &Surroundings, car: &CarState, sample: usize) -> bool {
    let scenario = &surroundings.scenario;
    let ego = scenario.vehicle.footprint(car.pose());
    let clear = scenario
        .obstacles
        .iter()
        .all(|o| !ego.overlaps(&surroundings.outline(o.id, sample)));
    let on_road = |corner| scenario.map.distance_off_road(corner) <= OFF_ROAD;
    clear && (!sample.is_multiple_of(5) || ego.vertices().iter().all(|c| on_road(*c)))
}

/// How many of all sequences of commands survive, depth first.
fn survivors(question: &Question, car: CarState, station: f64, sample: usize) -> usize {
    if sample >= question.samples.1 {
        return 1;
    }
    let mut count = 0;
    for a in 0..question.grid.accelerations.len() {
        for k in 0..question.grid.steers.len() {
            let (command, station) = question.command(&car, station, (a, k));
            let (mut moved, mut safe) = (car, true);
            let end = sample + question.samples_per_step();
            for at in sample + 1..=end {
                moved = moved.advanced(command, question.limits, question.surroundings.dt);
                safe = safe && is_safe(question.surroundings, &moved, at);
            }
            if safe {
                count += survivors(question, moved, station, end);
            }
        }
    }
    count
}

#[test]
fn the_search_finds_a_motion_where_enumeration_does_and_only_there() {
    let mut stir = Stir(11);
    let (mut saved, mut lost) = (0, 0);
    for case in 0..200 {
        let scenario = random(&mut stir);
        let surroundings = surroundings(&scenario, 3.0);
        let (car, limits) = start(&scenario);
        let (exact, coarse) = (small(DISTINCT), small(Grid::default().cell));
        let ask = question(&surroundings, &limits, &exact, car);
        let all = survivors(&ask, car, 30.0, 0);
        for grid in [&exact, &coarse] {
            let ask = question(&surroundings, &limits, grid, car);
            match ask.answer() {
                Answer::Survives(witness) => {
                    assert!(all > 0, "case {case}: the search survives what nobody can");
                    assert_eq!(witness.check(&surroundings, &limits), Ok(()), "case {case}");
                }
                Answer::Dies => assert_eq!(all, 0, "case {case}: {all} motions survive"),
                Answer::Exhausted(_) => panic!("there was no budget"),
            }
        }
        saved += usize::from(all > 0);
        lost += usize::from(all == 0);
    }
    assert!(saved > 40 && lost > 40, "{saved} saved, {lost} lost");
}

#[test]
fn a_smaller_body_survives_wherever_the_car_does() {
    let mut stir = Stir(5);
    for case in 0..60 {
        let scenario = random(&mut stir);
        let surroundings = surroundings(&scenario, 3.0);
        let (car, limits) = start(&scenario);
        let grid = small(DISTINCT);
        let ask = question(&surroundings, &limits, &grid, car);
        let smaller = Question {
            body: ask.body.drawn_in(0.1),
            ..ask
        };
        if matches!(ask.answer(), Answer::Survives(_)) {
            assert!(matches!(smaller.answer(), Answer::Survives(_)), "case {case}");
        }
    }
}

#[test]
fn a_search_that_may_try_little_says_so() {
    let scenario = random(&mut Stir(3));
    let surroundings = surroundings(&scenario, 3.0);
    let (car, limits) = start(&scenario);
    let grid = small(DISTINCT);
    let ask = Question {
        budget: 3,
        ..question(&surroundings, &limits, &grid, car)
    };
    assert_eq!(ask.answer(), Answer::Exhausted(3));
}

/// The finer grid is the oracle: half the step, twice the commands, cells a third as large.
#[test]
fn what_is_called_unavoidable_is_not_survived_on_a_finer_grid_either() {
    let finer = Grid {
        step: 0.1,
        accelerations: vec![-1.0, 0.0, -0.75, -0.5, -0.25, 0.5, 1.0],
        steers: [1.0, -1.0, 0.6, -0.6, 0.3, -0.3, 0.1, -0.1, 0.0]
            .into_iter()
            .map(Steer::Share)
            .chain([Steer::Along])
            .collect(),
        cell: Grid::default().cell.map(|size| size / 3.0),
    };
    let usual = Grid::default();
    let mut stir = Stir(23);
    let mut unavoidable = 0;
    for case in 0..150 {
        let scenario = random(&mut stir);
        let surroundings = surroundings(&scenario, 3.0);
        let (car, limits) = start(&scenario);
        let ask = question(&surroundings, &limits, &usual, car);
        let ask = Question {
            samples: (0, 100),
            budget: 100_000,
            ..ask
        };
        let smaller = Question {
            body: ask.body.drawn_in(SLACK),
            ..ask
        };
        if ask.answer() != Answer::Dies || smaller.answer() != Answer::Dies {
            continue;
        }
        unavoidable += 1;
        let harder = Question { grid: &finer, ..ask };
        assert!(!matches!(harder.answer(), Answer::Survives(_)), "case {case}");
    }
    assert!(unavoidable > 20, "{unavoidable}");
}
