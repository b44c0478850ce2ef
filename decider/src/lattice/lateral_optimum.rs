//! The smoothest way inside the lateral bounds, as a lateral curve (the original's `LateralOSQPOptimizer`).
//!
//! Minimises `Σ l² + 500 l'² + 1000 l''²` over stations a metre apart with a limited third derivative, and ends parallel
//! to the line. Where there is no such way, or the solver gives up, there is no curve; the original drives what it got.

use super::curve::Curve;
use super::lateral_bounds::STEP;
use super::piecewise::Piecewise;
use crate::piecewise_jerk::{Cost, JerkCoupling, Problem, Riccati, Solver, State, Term};

/// Weights of slope and second derivative; that of the offset is 1.
const SLOPE_WEIGHT: f64 = 500.0;
const BEND_WEIGHT: f64 = 1000.0;

/// Largest slope and second derivative, 1/m (the original's `lateral_derivative_bound_default`).
const LARGEST: f64 = 2.0;

/// Largest third derivative, 1/m² (`lateral_third_order_derivative_max`).
const TWIST: f64 = 0.1;

/// The curve from offset, slope and second derivative `initial` inside the bounds; `None` where there is none.
pub fn lateral_optimum(initial: [f64; 3], bounds: &[(f64, f64)], solver: &mut Riccati) -> Option<Curve> {
    let n = bounds.len();
    let [x, dx, ddx] = initial;
    let mut problem = Problem {
        delta: STEP,
        initial: State { x, dx, ddx },
        x: bounds.to_vec(),
        dx: vec![(-LARGEST, LARGEST); n],
        ddx: vec![(-LARGEST, LARGEST); n],
        dddx: vec![(-TWIST, TWIST); n.saturating_sub(1)],
        cost: Cost {
            x: vec![Term::new(1.0, 0.0); n],
            dx: vec![Term::new(SLOPE_WEIGHT, 0.0); n],
            ddx: vec![Term::new(BEND_WEIGHT, 0.0); n],
            dddx: 0.0,
            coupling: JerkCoupling::Symmetric,
            end: [Term::default(); 3],
            constant: 0.0,
        },
    };
    if let (Some(dx), Some(ddx)) = (problem.dx.last_mut(), problem.ddx.last_mut()) {
        (*dx, *ddx) = ((0.0, 0.0), (0.0, 0.0));
    }
    problem.admit_initial_state();
    let solution = solver.solve(&problem).ok()?;
    let jerks: Vec<(f64, f64)> = solution.dddx.iter().map(|jerk| (*jerk, STEP)).collect();
    Piecewise::of_jerks(initial, &jerks).map(Curve::from)
}
