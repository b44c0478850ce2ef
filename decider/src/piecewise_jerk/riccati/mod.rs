//! Our own solver: every step is a sweep along the chain and back, linear in the number of knots.
//!
//! Cold, it goes from a first guess by an interior-point method to the neighbourhood of the solution, reads off which
//! limits are touched, and solves exactly for those. Warm, it starts from the limits that the last solution touched,
//! which usually takes one or two factorisations. Either way the answer is that of the last linear system, so it does
//! not tell which way was gone.

#![allow(
    clippy::needless_range_loop,
    reason = "formulas take the same stage and lane of several lists"
)]

mod active_set;
mod certificate;
mod interior_point;
mod stages;
mod start;
mod sweep;

use super::{Problem, Solution, SolveError, Solver, State};
use crate::steps;
use active_set::ActiveSet;
use interior_point::InteriorPoint;
use stages::{Lanes, Stages};
use start::Start;
use sweep::Sweep;

/// Factorisations that a warm start may take: as many as a third of a cold one.
const WARM_FACTORISATIONS: usize = 6;

/// Factorisations for settling on the limits that an interior point is near to.
const POLISH_FACTORISATIONS: usize = 3;

/// Decrease of the products of slack and multiplier after which the touched limits may show.
const NEAR_ENOUGH: f64 = 1e-3;

/// Further decrease before the next look at them.
const NEARER: f64 = 1e-2;

/// Decrease after which an interior point is a solution, should the touched limits be too many to be told.
const CONVERGED: f64 = 1e-13;

/// Iterations of the interior point: twice what the hardest problems known take.
const MOST_ITERATIONS: usize = 60;

/// A step as short as this leads nowhere.
const STALLED: f64 = 1e-10;

/// How far outside a limit an initial state is taken for rounding, and an answer for none.
const ADMITTED: f64 = 1e-8;

/// The solver, with the space it needs and the limits that the last solution touched: keep one per kind of problem.
///
/// It allocates only when a problem is larger than all before. The jerk needs finite limits for infeasibility to be
/// proved; without them it ends as [`SolveError::NotSolved`].
#[derive(Clone, Debug, Default)]
pub struct Riccati {
    stages: Stages,
    sweep: Sweep,
    start: Start,
    interior: InteriorPoint,
    active: ActiveSet,
    /// Whether `active` holds what a solution touched.
    remembers: bool,
    by_jerk: Vec<f64>,
}

impl Solver for Riccati {
    fn solve(&mut self, problem: &Problem) -> Result<Solution, SolveError> {
        problem.validate()?;
        if !admits_initial_state(problem) {
            return Err(SolveError::Infeasible);
        }
        self.stages.read(problem);
        let mut factorisations = 0;
        if std::mem::take(&mut self.remembers) && self.settle(WARM_FACTORISATIONS, &mut factorisations) {
            return self.answer(problem, 0, factorisations);
        }
        let iterations = self.solve_cold(&mut factorisations)?;
        self.answer(problem, iterations, factorisations)
    }
}

impl Riccati {
    /// A solver that remembers nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The next problem has nothing to do with the last.
    pub fn forget(&mut self) {
        self.remembers = false;
    }

    /// The next problem starts this many knots further on than the last.
    pub fn shift(&mut self, knots: usize) {
        self.active.shift(knots);
    }

    /// Solves for the limits that are taken to be touched, corrected where that shows; whether that came to an end.
    fn settle(&mut self, most: usize, factorisations: &mut usize) -> bool {
        let (count, settled) = self.active.settle(&self.stages, &mut self.sweep, most);
        *factorisations += count;
        settled
    }

    /// Solves from nothing; how many iterations it took.
    fn solve_cold(&mut self, factorisations: &mut usize) -> Result<usize, SolveError> {
        *factorisations += self.start.find(&self.stages, &mut self.sweep);
        let first = self.start.mu;
        self.interior.start(&self.stages, &self.start.values, first);
        let mut look = NEAR_ENOUGH * first;
        for iteration in 1..=MOST_ITERATIONS {
            steps::count();
            let length = self.interior.step(&self.stages, &mut self.sweep);
            *factorisations += 1;
            self.interior.multipliers(&mut self.active.multipliers);
            if self.interior.is_feasible() {
                if self.interior.mu() < look {
                    look = NEARER * self.interior.mu();
                    self.interior.touched(&mut self.active.touched);
                    self.active.values.clone_from(self.interior.values());
                    if self.settle(POLISH_FACTORISATIONS, factorisations) {
                        return Ok(iteration);
                    }
                }
            } else if self.proves_infeasible() {
                return Err(SolveError::Infeasible);
            }
            if length < STALLED {
                break;
            }
        }
        if self.interior.is_feasible() && self.interior.mu() < CONVERGED * first {
            self.active.values.clone_from(self.interior.values());
            return Ok(MOST_ITERATIONS);
        }
        Err(not_solved("the interior point got stuck"))
    }

    fn proves_infeasible(&mut self) -> bool {
        let multipliers = &mut self.active.multipliers;
        certificate::proves_infeasible(
            &self.stages,
            self.interior.values(),
            multipliers,
            &mut self.by_jerk,
        )
    }

    /// The present values as the answer, if they are one.
    fn answer(
        &mut self,
        problem: &Problem,
        iterations: usize,
        factorisations: usize,
    ) -> Result<Solution, SolveError> {
        let is_finite = |lanes: &Lanes| lanes.iter().all(|value| value.is_finite());
        let values = &self.active.values;
        let solution = self.stages.solution(problem, values);
        if !values.iter().all(is_finite) || problem.violation(&solution) > ADMITTED {
            return Err(not_solved("rounding ate the answer"));
        }
        self.remembers = true;
        Ok(Solution {
            iterations,
            factorisations,
            ..solution
        })
    }
}

fn not_solved(reason: &str) -> SolveError {
    SolveError::NotSolved {
        reason: reason.to_owned(),
    }
}

fn admits_initial_state(problem: &Problem) -> bool {
    let State { x, dx, ddx } = problem.initial;
    let pairs = [(x, problem.x[0]), (dx, problem.dx[0]), (ddx, problem.ddx[0])];
    pairs
        .into_iter()
        .all(|(value, (low, high))| value >= low - ADMITTED && value <= high + ADMITTED)
}
