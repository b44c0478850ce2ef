//! From nowhere to the neighbourhood of the solution: Mehrotra's predictor-corrector method.
//!
//! Each limit has a slack `s > 0` (its distance, once feasible) and a multiplier `m > 0`; their products are driven to
//! zero together. The dynamics hold throughout, since every step is a sweep. Source: Nocedal and Wright, Numerical
//! Optimization, 2nd edition, algorithm 16.4.

use super::active_set::Touched;
use super::stages::{Lanes, Stages};
use super::sweep::Sweep;

/// How much of the way to the nearest boundary a step goes.
const STEP_SHARE: f64 = 0.995;

/// Slacks at the start, as a share of what the first guess violates or of the room between limits.
const FIRST_SLACK: f64 = 0.1;

/// How far apart limits that coincide are taken to be, in the problem's own units: a method that goes through the inside
/// needs one. The touched limits that are read off in the end are exact again.
const LEAST_ROOM: f64 = 1e-6;

/// The least first slack, in the units of stages, where neither is of any size.
const LEAST_FIRST_SLACK: f64 = 1e-6;

/// One side of all limits: `sign · (value − limit)` is to be positive.
#[derive(Clone, Debug, Default)]
struct Side {
    /// 1 where there is a limit, else 0.
    exists: Vec<Lanes>,
    slack: Vec<Lanes>,
    multiplier: Vec<Lanes>,
    /// `exists / slack`, for the present iteration.
    inverse: Vec<Lanes>,
    /// By how much distance and slack differ, for the present iteration.
    residual: Vec<Lanes>,
    /// Product of the predicted changes of slack and multiplier.
    correction: Vec<Lanes>,
    /// Change of the slack by the last step found.
    slack_step: Vec<Lanes>,
    multiplier_step: Vec<Lanes>,
}

/// The iterates, and the space they need.
#[derive(Clone, Debug, Default)]
pub(super) struct InteriorPoint {
    /// Present values.
    values: Vec<Lanes>,
    low: Side,
    high: Side,
    gradient: Vec<Lanes>,
    weights: Vec<Lanes>,
    linear: Vec<Lanes>,
    changes: Vec<Lanes>,
    limits: f64,
    /// Mean product of slack and multiplier.
    mu: f64,
    /// Whether the values lie between all limits but for rounding.
    feasible: bool,
}

impl Side {
    fn resize(&mut self, n: usize) {
        for list in [
            &mut self.exists,
            &mut self.slack,
            &mut self.multiplier,
            &mut self.inverse,
            &mut self.residual,
            &mut self.correction,
            &mut self.slack_step,
            &mut self.multiplier_step,
        ] {
            list.resize(n, [0.0; 4]);
        }
    }

    /// Slacks and multipliers for a first guess: `distance` of the value from the limit, `room` to the other limit.
    fn start(&mut self, distance: impl Fn(usize, usize) -> f64, floor: Lanes, mu: f64) -> f64 {
        let mut count = 0.0;
        for i in 0..self.slack.len() {
            for k in 0..4 {
                let distance = distance(i, k);
                let exists = distance.is_finite();
                let slack = if exists { distance.max(floor[k]) } else { 1.0 };
                self.exists[i][k] = f64::from(u8::from(exists));
                self.slack[i][k] = slack;
                self.multiplier[i][k] = if exists { mu / slack } else { 0.0 };
                count += self.exists[i][k];
            }
        }
        count
    }

    fn products(&self) -> f64 {
        let mut sums = [0.0; 4];
        for (slack, multiplier) in self.slack.iter().zip(&self.multiplier) {
            for k in 0..4 {
                sums[k] += slack[k] * multiplier[k];
            }
        }
        sums.iter().sum()
    }

    /// Products after a step of this length.
    fn products_after(&self, length: f64) -> f64 {
        let mut sums = [0.0; 4];
        for i in 0..self.slack.len() {
            for k in 0..4 {
                let slack = self.slack[i][k] + length * self.slack_step[i][k];
                let multiplier = self.multiplier[i][k] + length * self.multiplier_step[i][k];
                sums[k] += slack * multiplier;
            }
        }
        sums.iter().sum()
    }

    /// Residuals and inverse slacks; the largest residual.
    fn prepare(&mut self, distance: impl Fn(usize, usize) -> f64) -> Lanes {
        let mut worst = [0.0; 4];
        for i in 0..self.slack.len() {
            for k in 0..4 {
                let exists = self.exists[i][k];
                self.inverse[i][k] = exists / self.slack[i][k];
                let residual = if exists > 0.0 {
                    distance(i, k) - self.slack[i][k]
                } else {
                    0.0
                };
                self.residual[i][k] = residual;
                worst[k] = f64::max(worst[k], residual.abs());
            }
        }
        worst
    }

    /// Steps of slack and multiplier that belong to changes of the values, and the greatest share of them one may go.
    fn steps(&mut self, changes: &[Lanes], sign: f64, target: f64) -> f64 {
        let mut fastest: Lanes = [0.0; 4];
        for i in 0..self.slack.len() {
            for k in 0..4 {
                let (multiplier, inverse) = (self.multiplier[i][k], self.inverse[i][k]);
                let slack_step = self.exists[i][k] * (sign * changes[i][k] + self.residual[i][k]);
                let multiplier_step =
                    (target - self.correction[i][k] - multiplier * slack_step) * inverse - multiplier;
                let by_slack = -slack_step * inverse;
                let by_multiplier = if multiplier > 0.0 {
                    -multiplier_step / multiplier
                } else {
                    0.0
                };
                let faster = if by_slack > by_multiplier {
                    by_slack
                } else {
                    by_multiplier
                };
                fastest[k] = if faster > fastest[k] { faster } else { fastest[k] };
                self.slack_step[i][k] = slack_step;
                self.multiplier_step[i][k] = multiplier_step;
            }
        }
        let fastest = fastest.iter().fold(0.0, |a: f64, b| a.max(*b));
        1.0 / fastest.max(1.0)
    }

    fn is_closing(&self, i: usize, k: usize) -> bool {
        self.multiplier[i][k] * self.slack_step[i][k] < self.slack[i][k] * self.multiplier_step[i][k]
    }

    fn correct(&mut self) {
        for i in 0..self.slack.len() {
            for k in 0..4 {
                self.correction[i][k] = self.slack_step[i][k] * self.multiplier_step[i][k];
            }
        }
    }

    fn advance(&mut self, length: f64) {
        for i in 0..self.slack.len() {
            for k in 0..4 {
                self.slack[i][k] += length * self.slack_step[i][k];
                self.multiplier[i][k] += length * self.multiplier_step[i][k];
            }
        }
    }
}

impl InteriorPoint {
    /// Starts at these values, with products of slack and multiplier at `mu`.
    pub(super) fn start(&mut self, stages: &Stages, values: &[Lanes], mu: f64) {
        let n = stages.len();
        self.values.clear();
        self.values.extend_from_slice(values);
        for list in [
            &mut self.gradient,
            &mut self.weights,
            &mut self.linear,
            &mut self.changes,
        ] {
            list.resize(n, [0.0; 4]);
        }
        self.low.resize(n);
        self.high.resize(n);
        let floor = first_slacks(stages, values);
        let count = self.low.start(|i, k| values[i][k] - stages.low[i][k], floor, mu)
            + self
                .high
                .start(|i, k| stages.high[i][k] - values[i][k], floor, mu);
        self.limits = count.max(1.0);
        self.mu = (self.low.products() + self.high.products()) / self.limits;
        self.feasible = false;
    }

    /// Present values.
    pub(super) fn values(&self) -> &Vec<Lanes> {
        &self.values
    }

    /// Mean product of slack and multiplier.
    pub(super) fn mu(&self) -> f64 {
        self.mu
    }

    /// Whether the values before the last step lay between all limits but for rounding: then they do so ever after.
    pub(super) fn is_feasible(&self) -> bool {
        self.feasible
    }

    /// One iteration: predictor, corrector, step. What share of the step could be gone.
    pub(super) fn step(&mut self, stages: &Stages, sweep: &mut Sweep) -> f64 {
        self.prepare(stages);
        sweep.factorise(&self.weights);
        let length = self.predict(sweep);
        let predicted = (self.low.products_after(length) + self.high.products_after(length)) / self.limits;
        let share = predicted / self.mu;
        let target = share * share * share * self.mu;
        let length = self.correct(sweep, target);
        self.low.advance(length);
        self.high.advance(length);
        for (values, changes) in self.values.iter_mut().zip(&self.changes) {
            for k in 0..4 {
                values[k] += length * changes[k];
            }
        }
        self.mu = (self.low.products() + self.high.products()) / self.limits;
        length
    }

    /// Residuals, gradient of the cost, and the matrix.
    fn prepare(&mut self, stages: &Stages) {
        let values = &self.values;
        let low = self.low.prepare(|i, k| above_low(stages, values, i, k));
        let high = self.high.prepare(|i, k| below_high(stages, values, i, k));
        self.feasible = (0..4).all(|k| low[k].max(high[k]) <= 1e-10 * stages.scale[k]);
        for i in 0..self.values.len() {
            for k in 0..4 {
                let low = self.low.multiplier[i][k] * self.low.inverse[i][k];
                let high = self.high.multiplier[i][k] * self.high.inverse[i][k];
                let gradient = stages.hessian[i][k] * values[i][k] + stages.linear[i][k];
                self.gradient[i][k] =
                    gradient + low * self.low.residual[i][k] - high * self.high.residual[i][k];
                self.weights[i][k] = stages.hessian[i][k] + low + high;
            }
        }
    }

    /// The step that would bring all products to zero at once, and how much of it one may go.
    fn predict(&mut self, sweep: &mut Sweep) -> f64 {
        sweep.solve(&self.gradient, &mut self.changes);
        for side in [&mut self.low, &mut self.high] {
            side.correction.fill([0.0; 4]);
        }
        self.low
            .steps(&self.changes, 1.0, 0.0)
            .min(self.high.steps(&self.changes, -1.0, 0.0))
    }

    /// The step towards products of `target`, with what the prediction neglected.
    fn correct(&mut self, sweep: &mut Sweep, target: f64) -> f64 {
        self.low.correct();
        self.high.correct();
        for i in 0..self.values.len() {
            for k in 0..4 {
                let low = (target - self.low.correction[i][k]) * self.low.inverse[i][k];
                let high = (target - self.high.correction[i][k]) * self.high.inverse[i][k];
                self.linear[i][k] = self.gradient[i][k] - low + high;
            }
        }
        sweep.solve(&self.linear, &mut self.changes);
        let low = self.low.steps(&self.changes, 1.0, target);
        let high = self.high.steps(&self.changes, -1.0, target);
        (STEP_SHARE * low.min(high)).min(1.0)
    }

    /// The difference of the multipliers of high and low limit.
    pub(super) fn multipliers(&self, multipliers: &mut Vec<Lanes>) {
        multipliers.clear();
        let sides = self.low.multiplier.iter().zip(&self.high.multiplier);
        multipliers.extend(sides.map(|(low, high)| std::array::from_fn(|k| high[k] - low[k])));
    }

    /// -1, 0, 1: which limit the values are about to touch: where the last step shrank the slack more than the
    /// multiplier (El-Bakry, Tapia and Zhang 1994).
    pub(super) fn touched(&self, touched: &mut Vec<Touched>) {
        touched.clear();
        let at = |i, k| i8::from(self.high.is_closing(i, k)) - i8::from(self.low.is_closing(i, k));
        touched.extend((0..self.values.len()).map(|i| std::array::from_fn(|k| at(i, k))));
    }
}

/// How much limits of this stage and lane are moved apart.
fn widening(stages: &Stages, i: usize, k: usize) -> f64 {
    let room = stages.high[i][k] - stages.low[i][k];
    (0.5 * (LEAST_ROOM * stages.scale[k] - room)).max(0.0)
}

fn above_low(stages: &Stages, values: &[Lanes], i: usize, k: usize) -> f64 {
    values[i][k] - stages.low[i][k] + widening(stages, i, k)
}

fn below_high(stages: &Stages, values: &[Lanes], i: usize, k: usize) -> f64 {
    stages.high[i][k] - values[i][k] + widening(stages, i, k)
}

/// The least slack per lane to start with.
fn first_slacks(stages: &Stages, values: &[Lanes]) -> Lanes {
    let mut floor = [LEAST_FIRST_SLACK; 4];
    for (i, values) in values.iter().enumerate() {
        for k in 0..4 {
            let violation = (stages.low[i][k] - values[k]).max(values[k] - stages.high[i][k]);
            floor[k] = f64::max(floor[k], FIRST_SLACK * violation);
        }
    }
    floor
}
