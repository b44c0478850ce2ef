//! Both solvers against each other, against the reference values, and our own against what must hold of any optimum.

mod agreement;
mod infeasible;
mod optimality;
mod random;
mod reference;
mod validation;
mod warm;

use super::{Clarabel, Problem, Riccati, Solution, SolveError, Solver};

fn cold(problem: &Problem) -> Result<Solution, SolveError> {
    Riccati::new().solve(problem)
}

fn by_clarabel(problem: &Problem) -> Result<Solution, SolveError> {
    Clarabel::default().solve(problem)
}

/// Greatest difference between two lists.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Greatest differences of value, first and second derivative.
fn differences(a: &Solution, b: &Solution) -> [f64; 3] {
    [apart(&a.x, &b.x), apart(&a.dx, &b.dx), apart(&a.ddx, &b.ddx)]
}
