//! The problem as a chain of stages with small numbers.
//!
//! Stage `i` is the interval after knot `i`: its jerk, and the knot it ends at. Its four values, its *lanes*, are `x`,
//! `D x'`, `D² x''` at that knot and `D³ x'''` on the interval; in these units the dynamics are the same for any
//! spacing `D`. Knot 0 cannot be changed and is no part of it.

use crate::piecewise_jerk::{JerkCoupling, Problem, Solution, Term};

/// One number per value of a stage: `x`, `x'`, `x''` at its end and `x'''` in it.
pub(super) type Lanes = [f64; 4];

/// The lane of the jerk, the input; those before it are the state.
pub(super) const JERK: usize = 3;

/// A state: `x`, `D x'`, `D² x''`.
pub(super) type State = [f64; 3];

/// The chain: `½ cᵀ H c + gᵀ c` over the values `c`, `H` diagonal.
#[derive(Clone, Debug, Default)]
pub(super) struct Stages {
    /// The state at knot 0.
    pub start: State,
    /// `1, D, D², D³`.
    pub scale: Lanes,
    /// `H`.
    pub hessian: Vec<Lanes>,
    /// `g`.
    pub linear: Vec<Lanes>,
    /// Lowest values.
    pub low: Vec<Lanes>,
    /// Highest values.
    pub high: Vec<Lanes>,
}

/// The state at the end of an interval.
pub(super) fn advance([x, y, w]: State, jerk: f64) -> State {
    [x + y + 0.5 * w + jerk * (1.0 / 6.0), y + w + 0.5 * jerk, w + jerk]
}

impl Stages {
    /// Reads a valid problem into the space of the last one.
    pub(super) fn read(&mut self, problem: &Problem) {
        let delta = problem.delta;
        let square = delta * delta;
        self.scale = [1.0, delta, square, square * delta];
        let initial = problem.initial;
        self.start = [initial.x, initial.dx * delta, initial.ddx * square];
        for list in [&mut self.hessian, &mut self.linear, &mut self.low, &mut self.high] {
            list.clear();
            list.resize(problem.knots() - 1, [0.0; 4]);
        }
        self.read_limits(problem);
        self.read_cost(problem);
    }

    /// Number of stages.
    pub(super) fn len(&self) -> usize {
        self.hessian.len()
    }

    fn read_limits(&mut self, problem: &Problem) {
        let [_, s1, s2, s3] = self.scale;
        let states = problem.x[1..].iter().zip(&problem.dx[1..]).zip(&problem.ddx[1..]);
        let all = states.zip(&problem.dddx);
        let stages = self.low.iter_mut().zip(&mut self.high);
        for ((low, high), (((x, dx), ddx), dddx)) in stages.zip(all) {
            *low = [x.0, dx.0 * s1, ddx.0 * s2, dddx.0 * s3];
            *high = [x.1, dx.1 * s1, ddx.1 * s2, dddx.1 * s3];
        }
    }

    fn read_cost(&mut self, problem: &Problem) {
        let cost = &problem.cost;
        let terms = cost.x[1..].iter().zip(&cost.dx[1..]).zip(&cost.ddx[1..]);
        for (i, ((x, dx), ddx)) in terms.enumerate() {
            for (lane, term) in [x, dx, ddx].into_iter().enumerate() {
                self.add(i, lane, *term);
            }
        }
        let last = self.len() - 1;
        for (lane, term) in cost.end.into_iter().enumerate() {
            self.add(last, lane, term);
        }
        for i in 0..=last {
            match cost.coupling {
                JerkCoupling::Symmetric => self.add(i, JERK, Term::new(cost.dddx, 0.0)),
                JerkCoupling::Diagonal => {
                    let neighbours = if i == last { 1.0 } else { 2.0 };
                    let weight = neighbours * cost.dddx / self.scale[2];
                    self.add(i, 2, Term::new(weight, 0.0));
                }
            }
        }
    }

    fn add(&mut self, stage: usize, lane: usize, term: Term) {
        let curvature = 2.0 * term.weight / (self.scale[lane] * self.scale[lane]);
        self.hessian[stage][lane] += curvature;
        self.linear[stage][lane] -= curvature * term.reference * self.scale[lane];
    }

    /// All values that follow from the jerks in them.
    pub(super) fn roll_out(&self, values: &mut [Lanes]) {
        let mut state = self.start;
        for lanes in values {
            state = advance(state, lanes[JERK]);
            lanes[..JERK].copy_from_slice(&state);
        }
    }

    /// The curve in the problem's own units.
    pub(super) fn solution(&self, problem: &Problem, values: &[Lanes]) -> Solution {
        let [_, s1, s2, s3] = self.scale;
        let initial = problem.initial;
        let list = |lane: usize, scale: f64, first: Option<f64>| -> Vec<f64> {
            let rest = values.iter().map(|lanes| lanes[lane] / scale);
            first.into_iter().chain(rest).collect()
        };
        let x = list(0, 1.0, Some(initial.x));
        let dx = list(1, s1, Some(initial.dx));
        let ddx = list(2, s2, Some(initial.ddx));
        let dddx = list(JERK, s3, None);
        Solution {
            cost: problem.cost_of([&x, &dx, &ddx], &dddx),
            x,
            dx,
            ddx,
            dddx,
            iterations: 0,
            factorisations: 0,
        }
    }
}
