//! Piecewise-jerk quadratic programs: the smoothest curve between limits, as the path over the station or as the
//! station over the time.
//!
//! A curve `x` has constant third derivative between `n` knots at equal spacing. Its values and first two derivatives
//! at the knots and its third derivative between them lie in boxes; a separable convex cost is minimised. [`Problem`]
//! is that and nothing more: pure mathematics, in whatever unit `x` and the spacing have. [`PathProblem`],
//! [`SpeedProblem`] and [`FallbackSpeedProblem`] say what the optimisers of a planner mean in its terms.
//!
//! Two solvers stand behind one trait: [`Clarabel`], a well-kept general one, and [`Riccati`], ours, which uses that
//! the problem is a chain.

mod clarabel;
mod fallback_speed;
mod path;
mod problem;
mod riccati;
mod speed;
#[cfg(test)]
mod tests;

pub use clarabel::Clarabel;
pub use fallback_speed::FallbackSpeedProblem;
pub use path::{PathProblem, PathWeights};
pub use problem::{Cost, JerkCoupling, Limits, Problem, ProblemError, State, Term};
pub use riccati::Riccati;
pub use speed::{SpeedProblem, SpeedWeights};

/// What finds the cheapest curve of a problem.
pub trait Solver {
    /// The cheapest curve between the limits.
    ///
    /// # Errors
    /// [`SolveError`]: there is none, it was not found, or the problem makes no sense. Never a curve that leaves its
    /// limits.
    fn solve(&mut self, problem: &Problem) -> Result<Solution, SolveError>;
}

/// The cheapest curve, and what it took to find it.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Values at the knots.
    pub x: Vec<f64>,
    /// First derivatives at the knots.
    pub dx: Vec<f64>,
    /// Second derivatives at the knots.
    pub ddx: Vec<f64>,
    /// Third derivatives between the knots: one less.
    pub dddx: Vec<f64>,
    /// The cost, constants included.
    pub cost: f64,
    /// Steps of the interior-point method; 0 where the set of touched limits was known or guessed at once.
    pub iterations: usize,
    /// How often a matrix was factorised: what the time goes with.
    pub factorisations: usize,
}

/// Why there is no curve.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The problem makes no sense.
    #[error(transparent)]
    Invalid(#[from] ProblemError),
    /// No curve lies within the limits.
    #[error("no curve lies within the limits")]
    Infeasible,
    /// The solver gave up, though there may be a solution.
    #[error("no solution found: {reason}")]
    NotSolved {
        /// What the solver says about it.
        reason: String,
    },
}

impl SolveError {
    /// Whether it is certain that no curve lies within the limits, be it that limits are the wrong way round.
    pub fn is_infeasible(&self) -> bool {
        match self {
            Self::Infeasible => true,
            Self::Invalid(ProblemError::Limits { low, high, .. }) => low > high,
            Self::Invalid(_) | Self::NotSolved { .. } => false,
        }
    }
}
