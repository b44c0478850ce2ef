//! From a guess of the limits that are touched to the exact solution.
//!
//! With those limits taken as equations the solution is one linear system. What then lies outside a limit is put on it,
//! what is pulled off one is let go, until nothing changes: the primal-dual active-set method (Hintermüller, Ito,
//! Kunisch 2003). A jerk on its limit is simply held. A state on its limit is drawn there by a heavy weight, and the
//! multiplier makes up for what is missing: the method of multipliers, one sweep for each decimal or two, with the one
//! factorisation. So limits that say the same thing twice do no harm.

use super::stages::{JERK, Lanes, Stages};
use super::sweep::{Sweep, jerk_gradient};
use crate::steps;

/// The weight on a touched limit of the state, relative to the greatest curvature of the cost. Much more loses in
/// rounding what it gains in speed.
const PENALTY: f64 = 1e4;

/// `x` that changes sign at every knot takes a jerk of 24 times its size: the sharpest a curve can bend.
const SHARPEST: f64 = 24.0 * 24.0;

/// What counts as on a limit, in the problem's own units.
const ON_LIMIT: f64 = 1e-10;

/// What counts as outside a limit, in the problem's own units.
const OUTSIDE: f64 = 1e-9;

/// What counts as pulled off a limit, relative to the greatest multiplier of its kind.
const PULLED: f64 = 1e-9;

/// Sweeps while the set of limits still changes: enough to tell signs.
const ROUGH_SWEEPS: usize = 2;

/// Sweeps after which equations that are still not met contradict each other.
const MOST_SWEEPS: usize = 12;

/// Which limit a value touches: -1 low, 0 none, 1 high.
pub(super) type Touched = [i8; 4];

/// The set, and the solution with it.
#[derive(Clone, Debug, Default)]
pub(super) struct ActiveSet {
    /// The guess, and in the end the truth.
    pub touched: Vec<Touched>,
    /// Positive at a high limit, negative at a low one.
    pub multipliers: Vec<Lanes>,
    /// The solution.
    pub values: Vec<Lanes>,
    weights: Vec<Lanes>,
    linear: Vec<Lanes>,
    changes: Vec<Lanes>,
    by_jerk: Vec<f64>,
    penalty: f64,
}

impl ActiveSet {
    /// Looks for the solution from the present guess with at most so many factorisations; how many it took, and
    /// whether it was found.
    pub(super) fn settle(&mut self, stages: &Stages, sweep: &mut Sweep, most: usize) -> (usize, bool) {
        self.prepare(stages);
        for count in 1..=most {
            self.factorise(stages, sweep);
            let mut off = f64::INFINITY;
            for _ in 0..ROUGH_SWEEPS {
                off = self.refine(stages, sweep);
            }
            if self.update(stages) {
                continue;
            }
            let mut sweeps = ROUGH_SWEEPS;
            while off > ON_LIMIT && sweeps < MOST_SWEEPS {
                off = self.refine(stages, sweep);
                sweeps += 1;
            }
            if off > ON_LIMIT {
                return (count, false);
            }
            if !self.update(stages) {
                return (count, true);
            }
        }
        (most, false)
    }

    /// Moves all by some stages to the start; nothing is touched behind them.
    pub(super) fn shift(&mut self, stages: usize) {
        let n = self.touched.len();
        self.touched.drain(..stages.min(n));
        self.touched.resize(n, [0; 4]);
        self.multipliers.drain(..stages.min(self.multipliers.len()));
        self.values.drain(..stages.min(self.values.len()));
    }

    fn prepare(&mut self, stages: &Stages) {
        let n = stages.len();
        self.touched.resize(n, [0; 4]);
        self.values.resize(n, [0.0; 4]);
        self.multipliers.resize(n, [0.0; 4]);
        self.weights.resize(n, [0.0; 4]);
        self.linear.resize(n, [0.0; 4]);
        self.changes.resize(n, [0.0; 4]);
        self.by_jerk.resize(n, 0.0);
        let sharpest = |h: &Lanes| SHARPEST * (h[JERK] + 0.25 * h[2]) + h[1] + h[0];
        self.penalty = PENALTY * stages.hessian.iter().map(sharpest).fold(0.0, f64::max);
        for (i, touched) in self.touched.iter_mut().enumerate() {
            for (k, touched) in touched.iter_mut().enumerate() {
                if stages.low[i][k] >= stages.high[i][k] && *touched == 0 {
                    *touched = 1;
                }
            }
        }
    }

    /// Puts touching jerks on their limits, forgets multipliers of what does not touch, and factorises.
    fn factorise(&mut self, stages: &Stages, sweep: &mut Sweep) {
        for (i, touched) in self.touched.iter().enumerate() {
            self.weights[i] = stages.hessian[i];
            for k in 0..JERK {
                if touched[k] == 0 {
                    self.multipliers[i][k] = 0.0;
                } else {
                    self.weights[i][k] += self.penalty;
                }
            }
            if touched[JERK] != 0 {
                self.weights[i][JERK] = f64::INFINITY;
                self.values[i][JERK] = limit(stages, i, JERK, touched[JERK]);
            }
        }
        stages.roll_out(&mut self.values);
        sweep.factorise(&self.weights);
    }

    /// One step of the method of multipliers; how far the worst touching state is off its limit.
    fn refine(&mut self, stages: &Stages, sweep: &mut Sweep) -> f64 {
        steps::count();
        for (i, touched) in self.touched.iter().enumerate() {
            let values = &self.values[i];
            for k in 0..4 {
                let mut linear = stages.hessian[i][k] * values[k] + stages.linear[i][k];
                if k < JERK && touched[k] != 0 {
                    let off = values[k] - limit(stages, i, k, touched[k]);
                    linear += self.multipliers[i][k] + self.penalty * off;
                }
                self.linear[i][k] = linear;
            }
        }
        sweep.solve(&self.linear, &mut self.changes);
        let mut worst: f64 = 0.0;
        for (i, touched) in self.touched.iter().enumerate() {
            for k in 0..4 {
                self.values[i][k] += self.changes[i][k];
                if k < JERK && touched[k] != 0 {
                    let off = self.values[i][k] - limit(stages, i, k, touched[k]);
                    self.multipliers[i][k] += self.penalty * off;
                    worst = worst.max(off.abs() / stages.scale[k]);
                }
            }
        }
        worst
    }

    /// Multipliers of touching jerks: what the rest of the cost pulls at them.
    fn pull_at_jerks(&mut self, stages: &Stages) {
        for (i, values) in self.values.iter().enumerate() {
            for k in 0..4 {
                let multiplier = if k < JERK { self.multipliers[i][k] } else { 0.0 };
                self.linear[i][k] = stages.hessian[i][k] * values[k] + stages.linear[i][k] + multiplier;
            }
        }
        jerk_gradient(&self.linear, &mut self.by_jerk);
        for (i, touched) in self.touched.iter().enumerate() {
            self.multipliers[i][JERK] = if touched[JERK] == 0 { 0.0 } else { -self.by_jerk[i] };
        }
    }

    /// Puts on limits what lies outside, and lets go what is pulled off; whether anything changed.
    fn update(&mut self, stages: &Stages) -> bool {
        self.pull_at_jerks(stages);
        let mut greatest = [0.0_f64; 4];
        for multipliers in &self.multipliers {
            for k in 0..4 {
                greatest[k] = greatest[k].max(multipliers[k].abs());
            }
        }
        let mut changed = false;
        for (i, touched) in self.touched.iter_mut().enumerate() {
            for (k, touched) in touched.iter_mut().enumerate() {
                let (low, high, value) = (stages.low[i][k], stages.high[i][k], self.values[i][k]);
                let is_fixed = low >= high;
                let pull = f64::from(*touched) * self.multipliers[i][k];
                let tolerance = OUTSIDE * stages.scale[k];
                let next = if *touched != 0 {
                    if pull < -PULLED * greatest[k] && !is_fixed {
                        0
                    } else {
                        *touched
                    }
                } else {
                    i8::from(value > high + tolerance) - i8::from(value < low - tolerance)
                };
                changed |= next != *touched;
                *touched = next;
            }
        }
        changed
    }
}

fn limit(stages: &Stages, stage: usize, lane: usize, side: i8) -> f64 {
    if side < 0 {
        stages.low[stage][lane]
    } else {
        stages.high[stage][lane]
    }
}
