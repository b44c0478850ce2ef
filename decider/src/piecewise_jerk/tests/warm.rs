//! What is remembered makes a solution cheaper, and does not change it.

use super::{apart, cold, random};
use crate::piecewise_jerk::{Problem, Riccati, Solver, State};

/// Half a lane 1.4 m wide, with a parked car in it.
fn corridor(s: f64) -> (f64, f64) {
    if (25.0..40.0).contains(&s) {
        (0.3, 0.7)
    } else {
        (-0.7, 0.7)
    }
}

fn path(start: f64, initial: State) -> Problem {
    let mut path = random::path(&mut random::Draw(8));
    let station = |i: usize| start + 0.5 * i as f64;
    path.l = (0..200).map(|i| corridor(station(i))).collect();
    path.ddl = vec![(-0.19, 0.19); 200];
    path.l_reference.clear();
    path.end_reference = State::default();
    path.initial = initial;
    path.to_problem()
}

/// Fifty ticks of a car that follows its path, a metre each.
#[test]
fn a_drive_past_a_parked_car_costs_a_factorisation_or_two_a_tick() {
    let mut solver = Riccati::new();
    let mut state = State {
        x: 0.05,
        dx: 0.01,
        ddx: 0.0,
    };
    let mut counts = Vec::new();
    for tick in 0..50_u32 {
        let problem = path(f64::from(tick), state);
        let warm = solver.solve(&problem).unwrap();
        let apart = apart(&warm.x, &cold(&problem).unwrap().x);
        assert!(apart < 1e-9, "tick {tick}: {apart:e}");
        counts.push(warm.factorisations);
        state = State {
            x: warm.x[2],
            dx: warm.dx[2],
            ddx: warm.ddx[2],
        };
        solver.shift(2);
    }
    let usual = counts[1..].iter().filter(|count| **count <= 2).count();
    assert!(usual >= 45, "{counts:?}");
    assert!(counts[0] > 4, "{counts:?}");
}

/// A little nearer, a little slower, limits a little wider.
fn changed(problem: &Problem) -> Problem {
    let mut next = problem.clone();
    next.initial.x += 1e-3;
    next.initial.dx *= 0.999;
    for (_, high) in &mut next.x {
        *high += 3e-3;
    }
    next.admit_initial_state();
    next
}

#[test]
fn warm_is_as_cold() {
    let mut solver = Riccati::new();
    let mut few = [0; 3];
    let mut all = [0; 3];
    for seed in 0..600 {
        let problem = random::any(seed);
        solver.forget();
        if solver.solve(&problem).is_err() {
            continue;
        }
        let next = changed(&problem);
        match (solver.solve(&next), cold(&next)) {
            (Ok(warm), Ok(cold)) => {
                let kind = usize::try_from(seed % 3).unwrap();
                few[kind] += usize::from(warm.factorisations <= 3);
                all[kind] += 1;
                assert!(
                    apart(&warm.x, &cold.x) < 1e-7,
                    "{seed}: {:e}",
                    apart(&warm.x, &cold.x)
                );
            }
            (warm, cold) => assert_eq!(warm, cold, "{seed}"),
        }
    }
    // Paths and speed profiles nearly always; a stop that only counts metres ripples, and half of them.
    assert!(few[0] * 100 >= all[0] * 95, "{few:?} of {all:?}");
    assert!(few[1] * 100 >= all[1] * 90, "{few:?} of {all:?}");
    assert!(few[2] * 100 >= all[2] * 40, "{few:?} of {all:?}");
}

/// Whatever was solved before, of whatever length and kind, solvable or not.
#[test]
fn a_memory_that_is_wrong_does_no_harm() {
    let mut solver = Riccati::new();
    for seed in 0..400 {
        let problem = random::any(seed);
        solver.shift(usize::try_from(seed % 5).unwrap());
        match (solver.solve(&problem), cold(&problem)) {
            (Ok(warm), Ok(cold)) => assert!(apart(&warm.x, &cold.x) < 1e-7, "{seed}"),
            (warm, cold) => assert_eq!(warm, cold, "{seed}"),
        }
    }
}

#[test]
fn the_same_question_has_the_same_answer_to_the_bit() {
    for seed in 0..60 {
        let problem = random::any(seed);
        assert_eq!(cold(&problem), cold(&problem), "{seed}");
    }
}
