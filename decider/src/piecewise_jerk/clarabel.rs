//! Solves with Clarabel, a general interior-point solver: slower, and a check of our own.
//!
//! Variables are `x`, `D x'`, `D² x''` at all knots, so that the dynamics have the same small numbers for any spacing.

use super::{JerkCoupling, Limits, Problem, Solution, SolveError, Solver, Term};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT, SupportedConeT::NonnegativeConeT,
    SupportedConeT::ZeroConeT,
};

/// How exactly optimality is asked for unless somebody says otherwise: two digits beyond the solver's own default, so
/// that curves agree to micrometres.
const TOLERANCE: f64 = 1e-10;

/// How far a value may lie outside its limits before the answer counts as none, relative to the value.
const ACCEPTED_VIOLATION: f64 = 1e-6;

/// The general solver. It remembers nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clarabel {
    /// Of the duality gap and of all limits, absolute and relative.
    pub tolerance: f64,
}

impl Default for Clarabel {
    fn default() -> Self {
        Self { tolerance: TOLERANCE }
    }
}

impl Solver for Clarabel {
    fn solve(&mut self, problem: &Problem) -> Result<Solution, SolveError> {
        problem.validate()?;
        let model = Model::new(problem);
        let not_solved = |reason: String| SolveError::NotSolved { reason };
        let mut solver = model
            .solver(self.tolerance)
            .map_err(|error| not_solved(error.to_string()))?;
        solver.solve();
        match solver.solution.status {
            SolverStatus::Solved | SolverStatus::AlmostSolved => {}
            SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
                return Err(SolveError::Infeasible);
            }
            other => return Err(not_solved(other.to_string())),
        }
        let iterations = usize::try_from(solver.solution.iterations).unwrap_or(usize::MAX);
        let solution = read(problem, &solver.solution.x, iterations);
        let largest = solution.x.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
        if problem.violation(&solution) > ACCEPTED_VIOLATION * largest {
            return Err(not_solved("the answer leaves its limits".to_owned()));
        }
        Ok(solution)
    }
}

/// Unscales the solver's variables.
fn read(problem: &Problem, y: &[f64], iterations: usize) -> Solution {
    let (n, delta) = (problem.knots(), problem.delta);
    let block =
        |k: usize, scale: f64| -> Vec<f64> { y[k * n..(k + 1) * n].iter().map(|v| v / scale).collect() };
    let (x, dx, ddx) = (block(0, 1.0), block(1, delta), block(2, delta * delta));
    let dddx: Vec<f64> = ddx.windows(2).map(|pair| (pair[1] - pair[0]) / delta).collect();
    Solution {
        cost: problem.cost_of([&x, &dx, &ddx], &dddx),
        x,
        dx,
        ddx,
        dddx,
        iterations,
        factorisations: iterations,
    }
}

/// A matrix as it is filled: row, column, value.
#[derive(Default)]
struct Triplets {
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
}

impl Triplets {
    fn add(&mut self, row: usize, column: usize, value: f64) {
        self.rows.push(row);
        self.columns.push(column);
        self.values.push(value);
    }

    fn matrix(self, rows: usize, columns: usize) -> CscMatrix<f64> {
        CscMatrix::new_from_triplets(rows, columns, self.rows, self.columns, self.values)
    }
}

/// `½ yᵀ P y + qᵀ y` with `A y = b` in the first rows and `A y ≤ b` in the others.
struct Model {
    knots: usize,
    quadratic: Triplets,
    linear: Vec<f64>,
    constraints: Triplets,
    bounds: Vec<f64>,
    equalities: usize,
}

impl Model {
    fn new(problem: &Problem) -> Self {
        let knots = problem.knots();
        let mut model = Self {
            knots,
            quadratic: Triplets::default(),
            linear: vec![0.0; 3 * knots],
            constraints: Triplets::default(),
            bounds: Vec::new(),
            equalities: 0,
        };
        model.add_cost(problem);
        model.add_dynamics(problem);
        model.equalities = model.bounds.len();
        model.add_limits(problem);
        model
    }

    fn solver(self, tolerance: f64) -> Result<DefaultSolver<f64>, clarabel::solver::SolverError> {
        let (columns, rows) = (3 * self.knots, self.bounds.len());
        let cones: [SupportedConeT<f64>; 2] = [
            ZeroConeT(self.equalities),
            NonnegativeConeT(rows - self.equalities),
        ];
        let settings = DefaultSettings {
            verbose: false,
            tol_gap_abs: tolerance,
            tol_gap_rel: tolerance,
            tol_feas: tolerance,
            ..DefaultSettings::default()
        };
        DefaultSolver::new(
            &self.quadratic.matrix(columns, columns),
            &self.linear,
            &self.constraints.matrix(rows, columns),
            &self.bounds,
            &cones,
            settings,
        )
    }

    fn add_cost(&mut self, problem: &Problem) {
        let (n, delta, cost) = (self.knots, problem.delta, &problem.cost);
        let scales = [1.0, delta, delta * delta];
        for (k, terms) in [&cost.x, &cost.dx, &cost.ddx].into_iter().enumerate() {
            for (i, term) in terms.iter().enumerate() {
                self.add_term(k * n + i, *term, scales[k]);
            }
            self.add_term(k * n + n - 1, cost.end[k], scales[k]);
        }
        let weight = Term::new(cost.dddx / (delta * delta), 0.0);
        for i in 2 * n..3 * n - 1 {
            self.add_term(i, weight, scales[2]);
            self.add_term(i + 1, weight, scales[2]);
            if cost.coupling == JerkCoupling::Symmetric {
                let product = -2.0 * weight.weight / (scales[2] * scales[2]);
                self.quadratic.add(i, i + 1, product);
            }
        }
    }

    fn add_term(&mut self, variable: usize, term: Term, scale: f64) {
        let curvature = 2.0 * term.weight / (scale * scale);
        if curvature > 0.0 {
            self.quadratic.add(variable, variable, curvature);
            self.linear[variable] -= curvature * term.reference * scale;
        }
    }

    fn row(&mut self, entries: &[(usize, f64)], bound: f64) {
        for (column, value) in entries {
            self.constraints.add(self.bounds.len(), *column, *value);
        }
        self.bounds.push(bound);
    }

    fn add_dynamics(&mut self, problem: &Problem) {
        let (n, delta, initial) = (self.knots, problem.delta, problem.initial);
        let (x, dx, ddx) = (0, n, 2 * n);
        self.row(&[(x, 1.0)], initial.x);
        self.row(&[(dx, 1.0)], initial.dx * delta);
        self.row(&[(ddx, 1.0)], initial.ddx * delta * delta);
        for i in 0..n - 1 {
            let (now, next) = (i, i + 1);
            self.row(
                &[
                    (dx + next, 1.0),
                    (dx + now, -1.0),
                    (ddx + now, -0.5),
                    (ddx + next, -0.5),
                ],
                0.0,
            );
            self.row(
                &[
                    (x + next, 1.0),
                    (x + now, -1.0),
                    (dx + now, -1.0),
                    (ddx + now, -1.0 / 3.0),
                    (ddx + next, -1.0 / 6.0),
                ],
                0.0,
            );
        }
    }

    fn add_limits(&mut self, problem: &Problem) {
        let (n, delta) = (self.knots, problem.delta);
        let scales = [1.0, delta, delta * delta];
        for (k, limits) in [&problem.x, &problem.dx, &problem.ddx].into_iter().enumerate() {
            for (i, limits) in limits.iter().enumerate() {
                self.range(&[(k * n + i, 1.0)], *limits, scales[k]);
            }
        }
        for (i, limits) in problem.dddx.iter().enumerate() {
            let rise = [(2 * n + i + 1, 1.0), (2 * n + i, -1.0)];
            self.range(&rise, *limits, delta * delta * delta);
        }
    }

    /// Low and high limit of a sum, where there are any.
    fn range(&mut self, entries: &[(usize, f64)], (low, high): Limits, scale: f64) {
        if high.is_finite() {
            self.row(entries, high * scale);
        }
        if low.is_finite() {
            let negative: Vec<(usize, f64)> = entries.iter().map(|(k, v)| (*k, -v)).collect();
            self.row(&negative, -low * scale);
        }
    }
}
