//! How long does the cheapest path of 200 knots, or speed profile of 81, take: cold, warm, and with Clarabel at its
//! own tolerances? A regression guard, not a marketing number.
//!
//! The path runs past parked cars on both sides of its lane. The speed profile follows a slower car. Warm is the
//! problem of the next tick, one metre or a tenth of a second later, with the last solution remembered.

use corridor_decider::piecewise_jerk::{
    Clarabel, JerkCoupling, Limits, PathProblem, PathWeights, Problem, Riccati, Solver, SpeedProblem,
    SpeedWeights, State,
};
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use std::hint::black_box;

/// Clarabel's own tolerance.
const CLARABEL_TOLERANCE: f64 = 1e-8;

/// Right and left bound at a station: a lane 3.5 m wide for a car 2.1 m wide, and two rows of parked cars.
fn bound(s: f64) -> Limits {
    if (25.0..40.0).contains(&s) {
        (0.3, 0.7)
    } else if (60.0..72.0).contains(&s) {
        (-0.7, -0.1)
    } else {
        (-0.7, 0.7)
    }
}

/// The path `s` metres further on, from this state.
fn path(s: f64, initial: State) -> Problem {
    let n = 200;
    let speed = 10.0;
    let station = |i: usize| s + 0.5 * i as f64;
    let kappa = |i: usize| 0.01 * station(i) / 100.0;
    let path = PathProblem {
        delta_s: 0.5,
        initial,
        l: (0..n).map(|i| bound(station(i))).collect(),
        dl: (-2.0, 2.0),
        ddl: (0..n).map(|i| (-0.1979 - kappa(i), 0.1979 - kappa(i))).collect(),
        dddl: 0.093_94 / speed,
        weights: PathWeights {
            dl: 20.0 * speed * speed,
            ..PathWeights::default()
        },
        l_reference: Vec::new(),
        end_reference: State::default(),
        coupling: JerkCoupling::Symmetric,
    };
    path.to_problem()
}

/// The profile `t` seconds later, from this state.
fn speed(t: f64, initial: State) -> Problem {
    let n = 81;
    let time = |i: usize| t + 0.1 * i as f64;
    let lead = |i: usize| 14.0 + 5.0 * time(i);
    let speed = SpeedProblem {
        delta_t: 0.1,
        initial,
        s: (0..n).map(|i| (0.0, lead(i))).collect(),
        v: vec![(0.0, 13.0); n],
        a: (-6.0, 2.0),
        jerk: (-4.0, 2.0),
        weights: SpeedWeights::default(),
        s_ref: (0..n).map(|i| (10.0 * time(i)).min(lead(i))).collect(),
        v_ref: 11.0,
        kappa: (0..n).map(|i| 0.002 * (i % 30) as f64 / 30.0).collect(),
        coupling: JerkCoupling::Symmetric,
    };
    speed.to_problem()
}

/// Cold and warm, ours and Clarabel's; `knots` is how much further on the next problem is.
fn compare(c: &mut Criterion, name: &str, problem: &Problem, next: impl Fn(State) -> Problem, knots: usize) {
    let mut solver = Riccati::new();
    let first = solver.solve(problem).expect("the road is open");
    let initial = State {
        x: first.x[knots],
        dx: first.dx[knots],
        ddx: first.ddx[knots],
    };
    let next = next(initial);
    solver.shift(knots);
    let known = solver.clone();
    let warm = solver.solve(&next).expect("the road is open");
    assert!(
        warm.iterations == 0 && warm.factorisations <= 3,
        "{} factorisations",
        warm.factorisations
    );
    let mut clarabel = Clarabel {
        tolerance: CLARABEL_TOLERANCE,
    };
    clarabel.solve(&next).expect("the road is open");
    let mut group = c.benchmark_group(name);
    group.bench_function("clarabel", |b| b.iter(|| clarabel.solve(black_box(&next))));
    group.bench_function("cold", |b| {
        b.iter(|| {
            solver.forget();
            solver.solve(black_box(&next))
        });
    });
    group.bench_function("warm", |b| {
        b.iter_batched_ref(
            || known.clone(),
            |solver| solver.solve(black_box(&next)),
            BatchSize::SmallInput,
        );
    });
    group.finish();
}

fn piecewise_jerk(c: &mut Criterion) {
    let at = |x, dx, ddx| State { x, dx, ddx };
    compare(
        c,
        "path of 200 knots",
        &path(0.0, at(0.1, 0.01, 0.0)),
        |state| path(1.0, state),
        2,
    );
    compare(
        c,
        "speed of 81 knots",
        &speed(0.0, at(0.0, 9.0, 0.2)),
        |state| speed(0.1, state),
        1,
    );
}

criterion_group!(benches, piecewise_jerk);
criterion_main!(benches);
