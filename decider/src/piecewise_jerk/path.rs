//! The lateral offset over the station: between the bounds of the path, near the line, and gentle.
//!
//! Source: Apollo's `PiecewiseJerkPathOptimizer`. Metres along the line and to its left.

use super::problem::{Cost, JerkCoupling, Limits, Problem, State, Term};

/// What departing from the line, slope, curvature and its change cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathWeights {
    /// Of the squared offset.
    pub l: f64,
    /// Of the squared slope.
    pub dl: f64,
    /// Of the squared second derivative.
    pub ddl: f64,
    /// Of the squared third derivative.
    pub dddl: f64,
    /// Of the squared distance from the end reference: offset, slope, second derivative.
    pub end: [f64; 3],
}

impl Default for PathWeights {
    /// Those for keeping a lane, before `dl` is multiplied by the squared speed.
    fn default() -> Self {
        Self {
            l: 1.0,
            dl: 20.0,
            ddl: 1000.0,
            dddl: 50_000.0,
            end: [1000.0, 0.0, 0.0],
        }
    }
}

/// A path to be found.
#[derive(Clone, Debug, PartialEq)]
pub struct PathProblem {
    /// Distance of the stations, m.
    pub delta_s: f64,
    /// Offset, slope and second derivative at the first station.
    pub initial: State,
    /// Right and left bound per station, m.
    pub l: Vec<Limits>,
    /// Least and greatest slope, everywhere.
    pub dl: Limits,
    /// Least and greatest second derivative per station, 1/m.
    pub ddl: Vec<Limits>,
    /// Greatest absolute third derivative, 1/m².
    pub dddl: f64,
    /// What is wanted.
    pub weights: PathWeights,
    /// Offset to be near to per station, with its own weight; empty where there is none.
    pub l_reference: Vec<Term>,
    /// Offset, slope and second derivative wanted at the last station.
    pub end_reference: State,
    /// How the third derivative enters the cost.
    pub coupling: JerkCoupling,
}

impl PathProblem {
    /// The problem as solvers know it.
    pub fn to_problem(&self) -> Problem {
        let n = self.l.len();
        let weights = &self.weights;
        let end = self.end_reference;
        let (x, constant) = self.offset_terms();
        Problem {
            delta: self.delta_s,
            initial: self.initial,
            x: self.l.clone(),
            dx: vec![self.dl; n],
            ddx: self.ddl.clone(),
            dddx: vec![(-self.dddl, self.dddl); n.saturating_sub(1)],
            cost: Cost {
                x,
                dx: vec![Term::new(weights.dl, 0.0); n],
                ddx: vec![Term::new(weights.ddl, 0.0); n],
                dddx: weights.dddl,
                coupling: self.coupling,
                end: [
                    Term::new(weights.end[0], end.x),
                    Term::new(weights.end[1], end.dx),
                    Term::new(weights.end[2], end.ddx),
                ],
                constant,
            },
        }
    }

    /// The pull to the line and that to the reference as one, and by how much they differ from it.
    fn offset_terms(&self) -> (Vec<Term>, f64) {
        let to_line = Term::new(self.weights.l, 0.0);
        if self.l_reference.is_empty() {
            return (vec![to_line; self.l.len()], 0.0);
        }
        let mut constant = 0.0;
        let join = |reference: &Term| {
            let (term, rest) = to_line.joined(*reference);
            constant += rest;
            term
        };
        (self.l_reference.iter().map(join).collect(), constant)
    }
}
