//! Least squares over a chain of unknowns that each lie between two limits, where an unknown is coupled to the three
//! before and behind it: linear in their number.
//!
//! Minimises `½ xᵀ A x − bᵀ x` with `lo ≤ x ≤ hi` by a primal-dual active-set method (Hintermüller, Ito, Kunisch
//! 2003): unknowns that press against a limit are put on it, those that are pulled off it are let go, until that is
//! settled; each step is one banded Cholesky factorisation. Where it cycles, a descent that lets go of one unknown at a
//! time ends it (Nocedal and Wright, algorithm 16.3).

/// How many unknowns on each side one is coupled to: a third difference couples four in a row.
pub(crate) const BAND: usize = 3;

/// One row of the lower triangle: the diagonal last.
pub(crate) type Row = [f64; BAND + 1];

/// Steps after which the set of unknowns on their limits is cycling; fewer than ten are usual.
const MAX_STEPS: usize = 20;

/// Steps per unknown of the descent that ends cycles. One or two are usual.
const DESCENT: usize = 20;

/// A symmetric positive definite band matrix with its right-hand side.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct System {
    pub rows: Vec<Row>,
    pub rhs: Vec<f64>,
}

/// Where an unknown is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Free,
    AtLow,
    AtHigh,
    Fixed,
}

impl System {
    /// A system of `n` unknowns that nothing acts on yet.
    pub(crate) fn zeros(n: usize) -> Self {
        Self {
            rows: vec![[0.0; BAND + 1]; n],
            rhs: vec![0.0; n],
        }
    }

    /// Adds `value` to the entry at `row` and `column`, which lies in the lower triangle's band.
    pub(crate) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.rows[row][BAND + column - row] += value;
    }

    /// The minimiser between the limits; a pair of equal limits fixes its unknown.
    pub(crate) fn minimise(&self, limits: &[(f64, f64)]) -> Vec<f64> {
        // What is fixed stays so: it would be let go and caught again in every step.
        let first = |(low, high): &(f64, f64)| if low < high { State::Free } else { State::Fixed };
        let mut states: Vec<State> = limits.iter().map(first).collect();
        for _ in 0..MAX_STEPS {
            let solution = self.solve_with(&states, limits);
            let next = self.next_states(&states, &solution, limits);
            if next == states {
                return solution;
            }
            states = next;
        }
        self.descend(states, limits)
    }

    fn next_states(&self, states: &[State], x: &[f64], limits: &[(f64, f64)]) -> Vec<State> {
        let pull = self.pull(x);
        let next = |k: usize| match states[k] {
            State::Free if x[k] < limits[k].0 => State::AtLow,
            State::Free if x[k] > limits[k].1 => State::AtHigh,
            state if is_let_go(state, pull[k]) => State::Free,
            now => now,
        };
        (0..x.len()).map(next).collect()
    }

    /// From a point between the limits downhill: towards the minimiser for the unknowns that are free, up to the first
    /// limit in the way; once there, one unknown is let go.
    fn descend(&self, mut states: Vec<State>, limits: &[(f64, f64)]) -> Vec<f64> {
        let clamped = |x: f64, k: usize| x.max(limits[k].0).min(limits[k].1);
        let start = self.solve_with(&states, limits);
        let mut x: Vec<f64> = start.iter().enumerate().map(|(k, x)| clamped(*x, k)).collect();
        for _ in 0..DESCENT * limits.len() {
            let target = self.solve_with(&states, limits);
            let (share, blocking) = longest_step(&x, &target, &states, limits);
            for (k, (x, target)) in x.iter_mut().zip(&target).enumerate() {
                *x = clamped(*x + (target - *x) * share, k);
            }
            if let Some((k, state)) = blocking {
                states[k] = state;
                continue;
            }
            let pull = self.pull(&x);
            let wrong = (0..x.len()).filter(|k| is_let_go(states[*k], pull[*k]));
            let Some(worst) = wrong.max_by(|a, b| pull[*a].abs().total_cmp(&pull[*b].abs())) else {
                break;
            };
            states[worst] = State::Free;
        }
        x
    }

    /// `b − A x`: where each unknown is drawn.
    fn pull(&self, x: &[f64]) -> Vec<f64> {
        let mut pull = self.rhs.clone();
        for (i, row) in self.rows.iter().enumerate() {
            for j in i.saturating_sub(BAND)..=i {
                let a = row[BAND + j - i];
                pull[i] -= a * x[j];
                if i != j {
                    pull[j] -= a * x[i];
                }
            }
        }
        pull
    }

    /// The minimiser with some unknowns on their limits.
    fn solve_with(&self, states: &[State], limits: &[(f64, f64)]) -> Vec<f64> {
        let fixed = |k: usize| match states[k] {
            State::Free => None,
            State::AtLow | State::Fixed => Some(limits[k].0),
            State::AtHigh => Some(limits[k].1),
        };
        let (mut rows, mut rhs) = (self.rows.clone(), self.rhs.clone());
        for i in 0..rows.len() {
            for j in i.saturating_sub(BAND)..=i {
                let a = std::mem::take(&mut rows[i][BAND + j - i]);
                match (fixed(i), fixed(j)) {
                    (Some(value), _) if i == j => {
                        rows[i][BAND] = 1.0;
                        rhs[i] = value;
                    }
                    (None, None) => rows[i][BAND + j - i] = a,
                    (Some(value), None) => rhs[j] -= a * value,
                    (None, Some(value)) => rhs[i] -= a * value,
                    (Some(_), Some(_)) => {}
                }
            }
        }
        cholesky_solve(&mut rows, &mut rhs);
        rhs
    }
}

/// Whether an unknown on a limit is drawn away from it.
fn is_let_go(state: State, pull: f64) -> bool {
    match state {
        State::Free | State::Fixed => false,
        State::AtLow => pull > 0.0,
        State::AtHigh => pull < 0.0,
    }
}

/// How far one may go from `x` to `target`, as a share, and the unknown that stops there.
fn longest_step(
    x: &[f64],
    target: &[f64],
    states: &[State],
    limits: &[(f64, f64)],
) -> (f64, Option<(usize, State)>) {
    let mut longest = (1.0, None);
    for k in (0..x.len()).filter(|k| states[*k] == State::Free) {
        let (limit, state) = if target[k] < limits[k].0 {
            (limits[k].0, State::AtLow)
        } else if target[k] > limits[k].1 {
            (limits[k].1, State::AtHigh)
        } else {
            continue;
        };
        let share = (limit - x[k]) / (target[k] - x[k]);
        if share < longest.0 {
            longest = (share, Some((k, state)));
        }
    }
    longest
}

/// Solves in place a system whose matrix is positive definite.
pub(crate) fn cholesky_solve(rows: &mut [Row], rhs: &mut [f64]) {
    let n = rhs.len();
    for i in 0..n {
        for j in i.saturating_sub(BAND)..=i {
            let mut sum = rows[i][BAND + j - i];
            for k in i.saturating_sub(BAND).max(j.saturating_sub(BAND))..j {
                sum -= rows[i][BAND + k - i] * rows[j][BAND + k - j];
            }
            rows[i][BAND + j - i] = if i == j { sum.sqrt() } else { sum / rows[j][BAND] };
        }
    }
    for i in 0..n {
        let mut sum = rhs[i];
        for k in i.saturating_sub(BAND)..i {
            sum -= rows[i][BAND + k - i] * rhs[k];
        }
        rhs[i] = sum / rows[i][BAND];
    }
    for i in (0..n).rev() {
        let mut sum = rhs[i];
        for k in i + 1..(i + 1 + BAND).min(n) {
            sum -= rows[k][BAND + i - k] * rhs[k];
        }
        rhs[i] = sum / rows[i][BAND];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    /// Third differences with a little weight on the unknowns themselves, which are drawn to `wanted`.
    fn chain(wanted: &[f64], stiffness: f64) -> System {
        let mut system = System::zeros(wanted.len());
        for (k, wanted) in wanted.iter().enumerate() {
            system.add(k, k, 1.0);
            system.rhs[k] += wanted;
        }
        for first in 0..wanted.len().saturating_sub(BAND) {
            for (a, ca) in [-1.0, 3.0, -3.0, 1.0].iter().enumerate() {
                for (b, cb) in [-1.0, 3.0, -3.0, 1.0][..=a].iter().enumerate() {
                    system.add(first + a, first + b, stiffness * ca * cb);
                }
            }
        }
        system
    }

    fn dense(system: &System) -> DMatrix<f64> {
        let n = system.rhs.len();
        DMatrix::from_fn(n, n, |i, j| {
            let (i, j) = (i.max(j), i.min(j));
            if i - j > BAND {
                0.0
            } else {
                system.rows[i][BAND + j - i]
            }
        })
    }

    proptest! {
        #[test]
        fn without_limits_it_is_the_dense_solution(wanted in prop::collection::vec(-2.0..2.0f64, 1..40)) {
            let system = chain(&wanted, 50.0);
            let expected = dense(&system).lu().solve(&DVector::from_vec(system.rhs.clone())).unwrap();
            for (have, want) in system.minimise(&vec![(-1e9, 1e9); wanted.len()]).iter().zip(expected.iter()) {
                prop_assert!((have - want).abs() < 1e-9, "{have} {want}");
            }
        }

        /// The conditions of Karush, Kuhn and Tucker: nothing is drawn except against its limit.
        #[test]
        fn between_limits_nothing_pulls_but_the_limits(
            wanted in prop::collection::vec(-2.0..2.0f64, 4..60),
            reach in prop::collection::vec(-0.2..1.0f64, 60),
            stiffness in 0.0..2000.0f64,
        ) {
            let system = chain(&wanted, stiffness);
            let limits: Vec<(f64, f64)> = reach[..wanted.len()].iter().map(|r| (-r.max(0.0), r.max(0.0))).collect();
            let x = system.minimise(&limits);
            for ((x, (low, high)), pull) in x.iter().zip(&limits).zip(system.pull(&x)) {
                prop_assert!(*low <= *x && *x <= *high);
                let fixed = high <= low;
                let right = fixed || pull.abs() < 1e-6 || (pull > 0.0 && x >= high) || (pull < 0.0 && x <= low);
                prop_assert!(right, "{x} in [{low}, {high}] is drawn by {pull}");
            }
        }
    }
}
