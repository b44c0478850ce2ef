//! The station over the time: near a rough profile and a cruise speed, between stop and follow bounds, and gentle.
//!
//! Source: Apollo's `PiecewiseJerkSpeedOptimizer`. Metres and seconds.

use super::problem::{Cost, JerkCoupling, Limits, Problem, State, Term};
use serde::{Deserialize, Serialize};

/// What departing from the references, accelerating and its change cost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpeedWeights {
    /// Of the squared acceleration.
    pub acc: f64,
    /// Of the squared jerk.
    pub jerk: f64,
    /// Of the squared speed, per curvature of the path.
    pub kappa_penalty: f64,
    /// Of the squared distance from the rough profile.
    pub ref_s: f64,
    /// Of the squared distance from the cruise speed.
    pub ref_v: f64,
}

impl Default for SpeedWeights {
    fn default() -> Self {
        Self {
            acc: 1.0,
            jerk: 3.0,
            kappa_penalty: 2000.0,
            ref_s: 10.0,
            ref_v: 10.0,
        }
    }
}

/// A speed profile to be found.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedProblem {
    /// Distance of the knots, s.
    pub delta_t: f64,
    /// Station, speed and acceleration now.
    pub initial: State,
    /// Lowest and highest station per knot, m.
    pub s: Vec<Limits>,
    /// Lowest and highest speed per knot, m/s.
    pub v: Vec<Limits>,
    /// Hardest braking and acceleration, m/s².
    pub a: Limits,
    /// Fastest change of acceleration down and up, m/s³.
    pub jerk: Limits,
    /// What is wanted.
    pub weights: SpeedWeights,
    /// Stations of the rough profile per knot, m.
    pub s_ref: Vec<f64>,
    /// Cruise speed, m/s.
    pub v_ref: f64,
    /// Curvature of the path at those stations, 1/m.
    pub kappa: Vec<f64>,
    /// How the jerk enters the cost.
    pub coupling: JerkCoupling,
}

impl SpeedProblem {
    /// The problem as solvers know it.
    pub fn to_problem(&self) -> Problem {
        let n = self.s.len();
        let weights = &self.weights;
        let near = |s: &f64| Term::new(weights.ref_s, *s);
        let (dx, constant) = self.speed_terms();
        Problem {
            delta: self.delta_t,
            initial: self.initial,
            x: self.s.clone(),
            dx: self.v.clone(),
            ddx: vec![self.a; n],
            dddx: vec![self.jerk; n.saturating_sub(1)],
            cost: Cost {
                x: self.s_ref.iter().map(near).collect(),
                dx,
                ddx: vec![Term::new(weights.acc, 0.0); n],
                dddx: weights.jerk,
                coupling: self.coupling,
                end: [Term::default(); 3],
                constant,
            },
        }
    }

    /// The pull to the cruise speed and that to standstill in bends as one, and by how much they differ from it.
    fn speed_terms(&self) -> (Vec<Term>, f64) {
        let cruise = Term::new(self.weights.ref_v, self.v_ref);
        let mut constant = 0.0;
        let join = |kappa: &f64| {
            let slow = Term::new(self.weights.kappa_penalty * kappa.abs(), 0.0);
            let (term, rest) = cruise.joined(slow);
            constant += rest;
            term
        };
        (self.kappa.iter().map(join).collect(), constant)
    }
}
