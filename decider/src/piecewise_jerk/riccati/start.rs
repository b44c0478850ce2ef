//! Where the interior point starts from.
//!
//! The optimum without limits, where it lies near them; else that of the cost plus a pull to the middle between
//! limits, as weak a one as keeps the curve near them. Each trial is one factorisation, a quarter of an iteration.

use super::stages::{Lanes, Stages};
use super::sweep::Sweep;

/// How far outside its limits a value may start, as a share of half the room between them.
const NEAR: f64 = 0.5;

/// The first pull, relative to what it costs to go from the middle to the limits of the cheapest kind of value.
const WEAKEST: f64 = 3e-3;

/// How much stronger the next one is.
const STRONGER: f64 = 30.0;

/// Trials after which the limits ask for the impossible: the interior point is to find that out.
const TRIALS: usize = 7;

/// Least half room, in units of stages: limits may coincide.
const LEAST_ROOM: f64 = 1e-9;

/// A first guess, and the space it needs.
#[derive(Clone, Debug, Default)]
pub(super) struct Start {
    /// The guess.
    pub values: Vec<Lanes>,
    /// What slack times multiplier should be there.
    pub mu: f64,
    base: Vec<Lanes>,
    weights: Vec<Lanes>,
    linear: Vec<Lanes>,
}

impl Start {
    /// Finds the guess; how many factorisations it took.
    pub(super) fn find(&mut self, stages: &Stages, sweep: &mut Sweep) -> usize {
        let n = stages.len();
        for list in [
            &mut self.values,
            &mut self.base,
            &mut self.weights,
            &mut self.linear,
        ] {
            list.clear();
            list.resize(n, [0.0; 4]);
        }
        stages.roll_out(&mut self.base);
        let weakest = WEAKEST * cost_of_limits(stages);
        self.mu = weakest;
        let mut pull = 0.0;
        for trial in 1..=TRIALS {
            self.minimise(stages, sweep, pull);
            let outside = self.outside(stages);
            if trial == TRIALS || outside <= NEAR {
                self.mu = pull.max(weakest);
                return trial;
            }
            pull = (STRONGER * pull).max(weakest);
        }
        TRIALS
    }

    fn minimise(&mut self, stages: &Stages, sweep: &mut Sweep, pull: f64) {
        for (i, base) in self.base.iter().enumerate() {
            for k in 0..4 {
                let curvature = stages.hessian[i][k];
                self.weights[i][k] = curvature;
                self.linear[i][k] = curvature * base[k] + stages.linear[i][k];
                let room = 0.5 * (stages.high[i][k] - stages.low[i][k]).max(LEAST_ROOM);
                if pull > 0.0 && room.is_finite() {
                    let weight = pull / (room * room);
                    self.weights[i][k] += weight;
                    self.linear[i][k] += weight * (base[k] - 0.5 * (stages.high[i][k] + stages.low[i][k]));
                }
            }
        }
        sweep.factorise(&self.weights);
        sweep.solve(&self.linear, &mut self.values);
        for (values, base) in self.values.iter_mut().zip(&self.base) {
            for k in 0..4 {
                values[k] += base[k];
            }
        }
    }

    /// How far the worst value lies outside its limits, as a share of half the room between them.
    fn outside(&self, stages: &Stages) -> f64 {
        let mut worst: f64 = 0.0;
        for (i, values) in self.values.iter().enumerate() {
            for k in 0..4 {
                let (low, high) = (stages.low[i][k], stages.high[i][k]);
                let room = 0.5 * (high - low).max(LEAST_ROOM);
                let outside = (low - values[k]).max(values[k] - high);
                if room.is_finite() {
                    worst = worst.max(outside / room);
                }
            }
        }
        worst
    }
}

/// What half the room between limits costs a stage, for the kind of value where that is cheapest but not free.
fn cost_of_limits(stages: &Stages) -> f64 {
    let mut sums = [0.0; 4];
    for i in 0..stages.len() {
        for (k, sum) in sums.iter_mut().enumerate() {
            let room = 0.5 * (stages.high[i][k] - stages.low[i][k]);
            if room.is_finite() {
                *sum += stages.hessian[i][k] * room * room;
            }
        }
    }
    let least = sums
        .into_iter()
        .filter(|sum| *sum > 0.0)
        .fold(f64::INFINITY, f64::min);
    if least.is_finite() {
        least / stages.len() as f64
    } else {
        1.0
    }
}
