//! A proof that no curve lies within the limits.
//!
//! Multipliers of the limits are a weighted sum of them that every curve within the limits satisfies; where even the
//! jerks that suit that sum best leave it violated, there is no curve (Farkas). On an infeasible problem the
//! multipliers of an interior point grow without bound, and soon point to such a sum.

use super::stages::{JERK, Lanes, Stages};
use super::sweep::jerk_gradient;

/// How much of the weighted sum rounding may be.
const ROUNDING: f64 = 1e-11;

/// Least violation, per unit of weight and in the problem's own units, that counts: what solutions are held to.
const LEAST_VIOLATION: f64 = 1e-9;

/// Whether these multipliers (positive for a high limit, negative for a low one) prove that there is no curve;
/// `values` is any curve that obeys the dynamics. Needs finite limits of the jerk.
pub(super) fn proves_infeasible(
    stages: &Stages,
    values: &[Lanes],
    multipliers: &mut [Lanes],
    by_jerk: &mut Vec<f64>,
) -> bool {
    // What the jerks' own limits say is said best below.
    for lanes in multipliers.iter_mut() {
        lanes[JERK] = 0.0;
    }
    by_jerk.resize(values.len(), 0.0);
    jerk_gradient(multipliers, by_jerk);
    let (mut sum, mut size, mut weight) = (0.0, 0.0, 0.0);
    for (i, (values, multipliers)) in values.iter().zip(multipliers).enumerate() {
        let (low, high) = (&stages.low[i], &stages.high[i]);
        for k in 0..JERK {
            let y = multipliers[k];
            if y != 0.0 {
                let limit = if y > 0.0 { high[k] } else { low[k] };
                sum += y * (values[k] - limit);
                size += y.abs() * (values[k].abs() + limit.abs());
                weight += y.abs() * stages.scale[k];
            }
        }
        let slope = by_jerk[i];
        let best = if slope > 0.0 { low[JERK] } else { high[JERK] };
        let change = slope * (best - values[JERK]);
        sum += change;
        size += change.abs();
    }
    sum > ROUNDING * size && sum > LEAST_VIOLATION * weight
}
