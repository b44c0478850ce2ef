//! The linear algebra: a Newton step over the chain is one sweep backward and one forward.
//!
//! Minimises `½ dᵀ W d + rᵀ d` over changes `d` of the values that obey the dynamics, `W` diagonal and positive
//! semidefinite, by the Riccati recursion: the cost to go from a knot is quadratic in the state there. An infinite
//! weight on a jerk holds it: its gain is zero.

use super::stages::{JERK, Lanes, State, advance};

/// What the backward sweep of a matrix leaves behind, per stage: the feedback on the state before it, and the inverse
/// of the curvature in the jerk.
#[derive(Clone, Debug, Default)]
pub(super) struct Sweep {
    gains: Vec<Lanes>,
    /// The part of the jerk that does not depend on the state.
    forward: Vec<f64>,
}

/// `Aᵀ v`: a costate one knot back.
fn back([x, y, w]: State) -> State {
    [x, x + y, 0.5 * x + y + w]
}

/// `Bᵀ v`: what a costate says about the jerk before it.
fn along_jerk([x, y, w]: State) -> f64 {
    x * (1.0 / 6.0) + 0.5 * y + w
}

impl Sweep {
    /// Factorises for these weights.
    pub(super) fn factorise(&mut self, weights: &[Lanes]) {
        self.gains.clear();
        self.gains.resize(weights.len(), [0.0; 4]);
        self.forward.resize(weights.len(), 0.0);
        // The cost to go, as columns of a symmetric matrix: upper triangle.
        let [mut xx, mut xy, mut xw, mut yy, mut yw, mut ww] = [0.0; 6];
        for (gains, weights) in self.gains.iter_mut().zip(weights).rev() {
            xx += weights[0];
            yy += weights[1];
            ww += weights[2];
            let column = [
                along_jerk([xx, xy, xw]),
                along_jerk([xy, yy, yw]),
                along_jerk([xw, yw, ww]),
            ];
            let curvature = weights[JERK] + along_jerk(column);
            let inverse = if curvature > 0.0 { 1.0 / curvature } else { 0.0 };
            let g = back(column);
            let k = [g[0] * inverse, g[1] * inverse, g[2] * inverse];
            *gains = [k[0], k[1], k[2], inverse];
            // Aᵀ P A, then less what the jerk can save.
            let first = [xx, xx + xy, 0.5 * xx + xy + xw];
            let second = [xy + yy, 0.5 * xy + yy + yw];
            let third = 0.5 * xw + yw + ww;
            xx = first[0] - g[0] * k[0];
            xy = first[1] - g[0] * k[1];
            xw = first[2] - g[0] * k[2];
            yy = first[1] + second[0] - g[1] * k[1];
            yw = first[2] + second[1] - g[1] * k[2];
            ww = 0.5 * first[2] + second[1] + third - g[2] * k[2];
        }
    }

    /// The changes that minimise with this linear part.
    pub(super) fn solve(&mut self, linear: &[Lanes], changes: &mut [Lanes]) {
        let mut costate: State = [0.0; 3];
        let stages = self.gains.iter().zip(linear).zip(&mut self.forward);
        for ((gains, linear), forward) in stages.rev() {
            for (costate, linear) in costate.iter_mut().zip(linear) {
                *costate += linear;
            }
            let pull = linear[JERK] + along_jerk(costate);
            *forward = pull * gains[3];
            costate = back(costate);
            for (costate, gain) in costate.iter_mut().zip(gains) {
                *costate -= gain * pull;
            }
        }
        let mut state: State = [0.0; 3];
        for ((gains, forward), changes) in self.gains.iter().zip(&self.forward).zip(changes) {
            let feedback = gains[0] * state[0] + gains[1] * state[1] + gains[2] * state[2];
            let jerk = -forward - feedback;
            state = advance(state, jerk);
            *changes = [state[0], state[1], state[2], jerk];
        }
    }
}

/// How a function of the values with this gradient changes with each jerk, the dynamics obeyed.
pub(super) fn jerk_gradient(gradient: &[Lanes], by_jerk: &mut [f64]) {
    let mut costate: State = [0.0; 3];
    for (gradient, by_jerk) in gradient.iter().zip(by_jerk).rev() {
        for (costate, gradient) in costate.iter_mut().zip(gradient) {
            *costate += gradient;
        }
        *by_jerk = gradient[JERK] + along_jerk(costate);
        costate = back(costate);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    /// Values by jerks, one column per jerk: the dynamics written out.
    fn responses(n: usize) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(4 * n, n);
        for column in 0..n {
            let mut state = [0.0; 3];
            for i in 0..n {
                let jerk = f64::from(u8::from(i == column));
                state = advance(state, jerk);
                for k in 0..JERK {
                    all[(4 * i + k, column)] = state[k];
                }
                all[(4 * i + JERK, column)] = jerk;
            }
        }
        all
    }

    #[test]
    fn a_sweep_is_the_dense_newton_step() {
        let n = 9;
        let number = |i: usize, k: usize| ((7 * i + 3 * k) % 11) as f64;
        let weights: Vec<Lanes> = (0..n)
            .map(|i| std::array::from_fn(|k| number(i, k) + 0.5))
            .collect();
        let linear: Vec<Lanes> = (0..n)
            .map(|i| std::array::from_fn(|k| number(k, i) - 5.0))
            .collect();
        let mut sweep = Sweep::default();
        let mut changes = vec![[0.0; 4]; n];
        sweep.factorise(&weights);
        sweep.solve(&linear, &mut changes);

        let response = responses(n);
        let flat = |lists: &[Lanes]| DVector::from_iterator(4 * n, lists.iter().flatten().copied());
        let matrix = response.transpose() * DMatrix::from_diagonal(&flat(&weights)) * &response;
        let gradient = response.transpose() * flat(&linear);
        let jerks = matrix.lu().solve(&-&gradient).expect("positive definite");
        let off = (&response * jerks - flat(&changes)).amax();
        assert!(off < 1e-9, "{off:e}");

        let mut by_jerk = vec![0.0; n];
        jerk_gradient(&linear, &mut by_jerk);
        assert!((DVector::from_vec(by_jerk) - gradient).amax() < 1e-9);
    }

    /// An infinite weight holds a jerk.
    #[test]
    fn a_held_jerk_stays() {
        let mut weights = vec![[1.0; 4]; 5];
        weights[2][JERK] = f64::INFINITY;
        let mut sweep = Sweep::default();
        let mut changes = vec![[0.0; 4]; 5];
        sweep.factorise(&weights);
        sweep.solve(&[[1.0; 4]; 5], &mut changes);
        let jerks: Vec<bool> = changes.iter().map(|lanes| lanes[JERK] == 0.0).collect();
        assert_eq!(jerks, [false, false, true, false, false]);
    }
}
