//! Cases of the piecewise-jerk problems: exact optima, and problems without a solution.
//!
//! Every case is put to Corridor's own solver twice, first cold and then warm, and both answers are held against the
//! optimum and the limits.

mod case;

pub(crate) use case::QpCase;

use case::{Expected, Optimum};
use corridor_decider::piecewise_jerk::{Problem, Riccati, Solution, SolveError, Solver};

/// Relative, and absolute below 1.
const COST: f64 = 1e-9;

/// Of values and first derivatives.
const VALUE: f64 = 1e-7;

/// Of second derivatives.
const SECOND: f64 = 1e-5;

/// How far a value may lie outside its limits.
const LIMITS: f64 = 1e-9;

/// Speed from which on the acceleration of a stop is compared: at standstill it ripples, and as well may not.
const MOVING: f64 = 0.05;

/// Solves the problem of a case and compares.
pub(crate) fn check(case: &QpCase) -> Result<(), String> {
    let problem = case.problem()?;
    let mut solver = Riccati::new();
    for start in ["cold", "warm"] {
        let answer = solver.solve(&problem);
        compare(case, &problem, answer).map_err(|mismatch| format!("{start}: {mismatch}"))?;
    }
    Ok(())
}

fn compare(case: &QpCase, problem: &Problem, answer: Result<Solution, SolveError>) -> Result<(), String> {
    match (&case.expected, answer) {
        (Expected::Infeasible {}, Err(error)) if error.is_infeasible() => Ok(()),
        (Expected::Infeasible {}, Ok(_)) => Err("solved, but there is no solution".to_owned()),
        (_, Err(error)) => Err(error.to_string()),
        (Expected::Solved(optimum), Ok(solution)) => same(case, problem, optimum, &solution),
    }
}

fn same(case: &QpCase, problem: &Problem, optimum: &Optimum, solution: &Solution) -> Result<(), String> {
    let violation = problem.violation(solution);
    if violation > LIMITS {
        return Err(format!("{violation:e} outside a limit"));
    }
    let off = solution.cost - optimum.cost;
    if off.abs() > COST * optimum.cost.abs().max(1.0) {
        return Err(format!("cost is {}, not {}", solution.cost, optimum.cost));
    }
    near("x", &solution.x, &optimum.x, |_| VALUE)?;
    near("dx", &solution.dx, &optimum.dx, |_| VALUE)?;
    let stands = |i: usize| case.is_fallback() && optimum.dx[i] <= MOVING;
    near("ddx", &solution.ddx, &optimum.ddx, |i| {
        if stands(i) { f64::INFINITY } else { SECOND }
    })
}

fn near(list: &str, got: &[f64], wanted: &[f64], tolerance: impl Fn(usize) -> f64) -> Result<(), String> {
    if got.len() != wanted.len() {
        return Err(format!("`{list}` has {} knots, not {}", got.len(), wanted.len()));
    }
    let is_off = |i: &usize| (got[*i] - wanted[*i]).abs() > tolerance(*i);
    match (0..got.len()).find(is_off) {
        None => Ok(()),
        Some(i) => Err(format!("`{list}` at knot {i} is {}, not {}", got[i], wanted[i])),
    }
}
