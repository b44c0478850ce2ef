//! The JSON of a case, and the problem it poses.

use corridor_decider::piecewise_jerk::{
    FallbackSpeedProblem, JerkCoupling, Limits, PathProblem, PathWeights, Problem, SpeedProblem,
    SpeedWeights, State, Term,
};
use serde::Deserialize;

/// One case.
#[derive(Deserialize)]
pub(crate) struct QpCase {
    pub(crate) name: String,
    #[serde(flatten)]
    question: Question,
    pub(super) expected: Expected,
}

/// The problem, by its function.
#[derive(Deserialize)]
#[serde(tag = "function", content = "input", rename_all = "snake_case")]
enum Question {
    PathQp(Path),
    PathQpDiagonal(Path),
    SpeedQp(Speed),
    SpeedQpDiagonal(Speed),
    FallbackSpeedQp(Fallback),
}

#[derive(Deserialize)]
struct Path {
    n: usize,
    delta: f64,
    init: [f64; 3],
    l_lower: Vec<f64>,
    l_upper: Vec<f64>,
    dl_bound: Limits,
    ddl_lower: Vec<f64>,
    ddl_upper: Vec<f64>,
    dddl_bound: f64,
    weights: PathWeightsJson,
    end_l: f64,
    l_ref: f64,
    l_ref_weight: f64,
}

#[derive(Deserialize)]
struct PathWeightsJson {
    l: f64,
    dl: f64,
    ddl: f64,
    dddl: f64,
    end_l: f64,
}

#[derive(Deserialize)]
struct Speed {
    n: usize,
    delta: f64,
    init: [f64; 3],
    s_lower: Vec<f64>,
    s_upper: Vec<f64>,
    v_lower: Vec<f64>,
    v_upper: Vec<f64>,
    a_bound: Limits,
    jerk_bound: Limits,
    s_ref: Vec<f64>,
    v_ref: f64,
    kappa_at_s_ref: Vec<f64>,
    weights: SpeedWeightsJson,
}

#[derive(Deserialize)]
struct SpeedWeightsJson {
    acc: f64,
    jerk: f64,
    ref_s: f64,
    ref_v: f64,
    kappa_penalty: f64,
}

#[derive(Deserialize)]
struct Fallback {
    n: usize,
    delta: f64,
    init: [f64; 3],
    stop_distance: f64,
    s_bound: Limits,
    v_bound: Limits,
    a_bound: Limits,
    jerk_bound: Limits,
}

/// What is right.
#[derive(Deserialize)]
#[serde(tag = "status", rename_all = "snake_case")]
pub(super) enum Expected {
    Solved(Optimum),
    Infeasible {},
}

/// The exact optimum.
#[derive(Deserialize)]
pub(super) struct Optimum {
    pub(super) cost: f64,
    pub(super) x: Vec<f64>,
    pub(super) dx: Vec<f64>,
    pub(super) ddx: Vec<f64>,
}

impl QpCase {
    /// Whether a function is one of these cases.
    pub(crate) fn knows(function: &str) -> bool {
        function.ends_with("_qp") || function.ends_with("_qp_diagonal")
    }

    pub(super) fn is_fallback(&self) -> bool {
        matches!(self.question, Question::FallbackSpeedQp(_))
    }

    pub(super) fn problem(&self) -> Result<Problem, String> {
        let (n, problem) = match &self.question {
            Question::PathQp(path) => (path.n, path.problem(JerkCoupling::Symmetric)),
            Question::PathQpDiagonal(path) => (path.n, path.problem(JerkCoupling::Diagonal)),
            Question::SpeedQp(speed) => (speed.n, speed.problem(JerkCoupling::Symmetric)),
            Question::SpeedQpDiagonal(speed) => (speed.n, speed.problem(JerkCoupling::Diagonal)),
            Question::FallbackSpeedQp(stop) => (stop.n, stop.problem()),
        };
        if problem.knots() == n {
            Ok(problem)
        } else {
            Err(format!("bounds for {} knots, not {n}", problem.knots()))
        }
    }
}

fn state([x, dx, ddx]: [f64; 3]) -> State {
    State { x, dx, ddx }
}

fn limits(low: &[f64], high: &[f64]) -> Vec<Limits> {
    low.iter().copied().zip(high.iter().copied()).collect()
}

impl Path {
    fn problem(&self, coupling: JerkCoupling) -> Problem {
        let weights = &self.weights;
        let path = PathProblem {
            delta_s: self.delta,
            initial: state(self.init),
            l: limits(&self.l_lower, &self.l_upper),
            dl: self.dl_bound,
            ddl: limits(&self.ddl_lower, &self.ddl_upper),
            dddl: self.dddl_bound,
            weights: PathWeights {
                l: weights.l,
                dl: weights.dl,
                ddl: weights.ddl,
                dddl: weights.dddl,
                end: [weights.end_l, 0.0, 0.0],
            },
            l_reference: vec![Term::new(self.l_ref_weight, self.l_ref); self.n],
            end_reference: state([self.end_l, 0.0, 0.0]),
            coupling,
        };
        path.to_problem()
    }
}

impl Speed {
    fn problem(&self, coupling: JerkCoupling) -> Problem {
        let weights = &self.weights;
        let speed = SpeedProblem {
            delta_t: self.delta,
            initial: state(self.init),
            s: limits(&self.s_lower, &self.s_upper),
            v: limits(&self.v_lower, &self.v_upper),
            a: self.a_bound,
            jerk: self.jerk_bound,
            weights: SpeedWeights {
                acc: weights.acc,
                jerk: weights.jerk,
                kappa_penalty: weights.kappa_penalty,
                ref_s: weights.ref_s,
                ref_v: weights.ref_v,
            },
            s_ref: self.s_ref.clone(),
            v_ref: self.v_ref,
            kappa: self.kappa_at_s_ref.clone(),
            coupling,
        };
        speed.to_problem()
    }
}

impl Fallback {
    fn problem(&self) -> Problem {
        let stop = FallbackSpeedProblem {
            knots: self.n,
            delta_t: self.delta,
            initial: state(self.init),
            stop_distance: self.stop_distance,
            s: self.s_bound,
            v: self.v_bound,
            a: self.a_bound,
            jerk: self.jerk_bound,
        };
        stop.to_problem()
    }
}
