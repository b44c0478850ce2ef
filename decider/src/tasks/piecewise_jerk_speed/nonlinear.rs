//! Speed with the bends where the car will be.
//!
//! How much a path bends, and how fast it may be driven, depends on where the car is at a time, which is what is sought.
//! The linear optimiser reads both where its guide is; here they are read again where its solution is, a few times, and
//! centripetal acceleration `v² κ` is minimised as what it is: its square is replaced by that of its tangent (the
//! Gauss-Newton method; the original hands the whole to an interior-point solver).

use super::guide::STEP;
use crate::piecewise_jerk::{Problem, Riccati, Solution, Term};
use crate::planner::{LinePlan, TaskError};

/// Weight of the squared centripetal acceleration, beside 10 for that of the squared difference of speeds.
const WEIGHT: f64 = 10.0;

/// How often it is solved; the fourth time changes places by millimetres.
const ROUNDS: usize = 4;

/// Above this a limit of the road gives way, m/s.
const ABOVE: f64 = 0.1;

pub(super) fn solve(plan: &LinePlan, problem: &Problem, solver: &mut Riccati) -> Result<Solution, TaskError> {
    let mut solution = super::solve(problem, solver)?;
    for _ in 1..ROUNDS {
        match super::solve(&around(plan, problem, &solution), solver) {
            Ok(better) => solution = better,
            // The limits at the places of a good profile may leave no other; that one is kept.
            Err(_) => break,
        }
    }
    Ok(solution)
}

/// The problem with limits and bends at the places of a solution.
fn around(plan: &LinePlan, problem: &Problem, solution: &Solution) -> Problem {
    let mut problem = problem.clone();
    let Some(path) = plan.path() else { return problem };
    let mut slowest = solution.dx[0];
    for k in 1..solution.x.len() {
        let (s, v) = (solution.x[k], solution.dx[k].max(0.0));
        let kappa = crate::trajectory::at(&path.points, s).1;
        let slope = 2.0 * v * kappa;
        let bend = Term::new(WEIGHT * slope * slope, v / 2.0);
        let (term, constant) = problem.cost.dx[k].joined(bend);
        problem.cost.dx[k] = term;
        problem.cost.constant += constant;
        // The car cannot brake harder than it can: a limit that it meets too fast is met as slowly as possible.
        slowest = (slowest + plan.scene.vehicle.max_deceleration * STEP).max(0.0);
        let limit = plan
            .envelope
            .as_ref()
            .map_or(f64::INFINITY, |envelope| envelope.at(s))
            + ABOVE;
        let (low, high) = problem.dx[k];
        problem.dx[k] = (low, high.min(limit.max(v).max(slowest)).max(low));
    }
    problem
}
