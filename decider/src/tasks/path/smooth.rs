//! The smoothest offset profile inside a corridor.
//!
//! Minimises `Σ w (l − l_wanted)² + λ² l'² + λ⁴ (l'' + κ)² + λ⁶ (l''' + κ')²` over offsets a metre apart, derivatives by
//! forward differences that begin two metres behind the ego, where the start state says it came from. Limits enter as stiff springs at
//! the stations that press against them; which ones do is found by Newton's method for the semismooth problem
//! (an active-set iteration). Each step is one banded Cholesky factorisation, linear in the number of stations.

use super::corridor::Corridor;
use super::profile::Profile;
use super::table::STEP;
use crate::banded::{BAND, Row, cholesky_solve};
use crate::decision::Rejection;

/// Stiffness of a limit relative to the weight of the offset: leaves overshoots of about a millimetre.
const STIFFNESS: f64 = 1e6;

/// How far inside a limit its spring rests, m, so that the overshoot stays inside.
const INSET: f64 = 0.01;

/// Newton steps in which stations may let go of a limit again. Fewer than ten are usual; a set that still
/// changes then is cycling, and from there on only grows.
const FREE_STEPS: usize = 15;

/// All Newton steps: a growing set ends by itself, this is only a bound on the time.
const MAX_STEPS: usize = 60;

/// Which limit a station presses against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Press {
    None,
    Right,
    Left,
}

pub(super) fn solve(corridor: &Corridor) -> Result<Profile, Rejection> {
    let past = past_offsets(corridor.start);
    let (matrix, rhs) = normal_equations(corridor, past);
    let mut press = vec![Press::None; rhs.len()];
    let (mut stiffened, mut pulled) = (matrix.clone(), rhs.clone());
    for step in 0..MAX_STEPS {
        stiffened.copy_from_slice(&matrix);
        pulled.copy_from_slice(&rhs);
        for (k, press) in press.iter().enumerate() {
            if let Some(edge) = rest(corridor.limits[k + 1], *press) {
                stiffened[k][BAND] += STIFFNESS;
                pulled[k] += STIFFNESS * edge;
            }
        }
        cholesky_solve(&mut stiffened, &mut pulled);
        let next: Vec<Press> = pulled
            .iter()
            .zip(&corridor.limits[1..])
            .zip(&press)
            .map(|((l, limits), before)| match pressed(*l, *limits) {
                Press::None if step >= FREE_STEPS => *before,
                now => now,
            })
            .collect();
        if next == press {
            pulled.insert(0, corridor.start[0]);
            return Ok(Profile::from_offsets(&pulled, corridor.start));
        }
        press = next;
    }
    Err(Rejection::LeavesBound)
}

/// Offsets two metres and one metre behind the start and at it, on the parabola of the start state.
fn past_offsets([l, dl, ddl]: [f64; 3]) -> [f64; 3] {
    [-2.0 * STEP, -STEP, 0.0].map(|s| l + dl * s + ddl * s * s / 2.0)
}

/// Where the spring of a limit rests: a little inside, but in the middle of a gap narrower than that.
fn rest((l_min, l_max): (f64, f64), press: Press) -> Option<f64> {
    let inset = INSET.min((l_max - l_min) / 2.0);
    match press {
        Press::None => None,
        Press::Right => Some(l_min + inset),
        Press::Left => Some(l_max - inset),
    }
}

fn pressed(l: f64, limits: (f64, f64)) -> Press {
    let beyond = |press| rest(limits, press);
    if beyond(Press::Right).is_some_and(|edge| l < edge) {
        Press::Right
    } else if beyond(Press::Left).is_some_and(|edge| l > edge) {
        Press::Left
    } else {
        Press::None
    }
}

/// Matrix and right-hand side of the unlimited problem for the offsets after the start.
fn normal_equations(corridor: &Corridor, past: [f64; 3]) -> (Vec<Row>, Vec<f64>) {
    let free = corridor.len() - 1;
    let square = corridor.smoothing_length * corridor.smoothing_length / (STEP * STEP);
    // Minus what the stencil that ends at a station should give: nothing, the curvature to even out, its change.
    let bend = |k: usize| corridor.bends[k] * STEP * STEP;
    let targets: [&dyn Fn(usize) -> f64; 3] = [&|_| 0.0, &|last| bend(last.saturating_sub(1)), &|last| {
        bend(last.saturating_sub(1)) - bend(last.saturating_sub(2))
    }];
    let differences: [(&[f64], f64); 3] = [
        (&[-1.0, 1.0], square),
        (&[1.0, -2.0, 1.0], square * square),
        (&[-1.0, 3.0, -3.0, 1.0], square * square * square),
    ];
    let pulls = &corridor.pulls[1..];
    let mut matrix: Vec<Row> = pulls.iter().map(|pull| [0.0, 0.0, 0.0, pull.weight]).collect();
    let mut rhs: Vec<f64> = pulls.iter().map(|pull| pull.weight * pull.l).collect();
    for ((stencil, weight), target) in differences.into_iter().zip(targets) {
        for first in past.len() + 1 - stencil.len()..=past.len() + free - stencil.len() {
            // The last of the past offsets is that of station 0.
            let excess = target(first + stencil.len() - past.len());
            for (a, ca) in stencil.iter().enumerate() {
                let Some(row) = (first + a).checked_sub(past.len()) else {
                    continue;
                };
                rhs[row] -= weight * ca * excess;
                for (b, cb) in stencil[..=a].iter().enumerate() {
                    match (first + b).checked_sub(past.len()) {
                        Some(column) => matrix[row][BAND + column - row] += weight * ca * cb,
                        None => rhs[row] -= weight * ca * cb * past[first + b],
                    }
                }
            }
        }
    }
    (matrix, rhs)
}

#[cfg(test)]
mod tests {
    use super::super::corridor::Pull;
    use super::*;
    use nalgebra::{DMatrix, DVector};

    fn corridor(limits: Vec<(f64, f64)>, start: [f64; 3]) -> Corridor {
        Corridor {
            pulls: vec![Pull { l: 0.0, weight: 1.0 }; limits.len()],
            tolerance: vec![0.03; limits.len()],
            start,
            smoothing_length: 6.0,
            bends: vec![0.0; limits.len()],
            last: None,
            limits,
        }
    }

    #[test]
    fn the_banded_solve_agrees_with_a_dense_one() {
        let corridor = corridor(vec![(-2.0, 2.0); 40], [0.7, 0.05, -0.01]);
        let (matrix, rhs) = normal_equations(&corridor, past_offsets(corridor.start));
        let n = rhs.len();
        let dense = DMatrix::from_fn(n, n, |i, j| {
            let (i, j) = (i.max(j), i.min(j));
            if i - j > BAND {
                0.0
            } else {
                matrix[i][BAND + j - i]
            }
        });
        let expected = dense.lu().solve(&DVector::from_vec(rhs.clone())).unwrap();
        let (mut matrix, mut solved) = (matrix, rhs);
        cholesky_solve(&mut matrix, &mut solved);
        for (have, want) in solved.iter().zip(expected.iter()) {
            assert!((have - want).abs() < 1e-9, "{have} {want}");
        }
    }

    #[test]
    fn a_narrow_gap_is_passed_inside_and_the_way_back_is_smooth() {
        let mut limits = vec![(-0.7, 3.0); 80];
        limits[30..45].fill((1.5, 3.0));
        let corridor = corridor(limits.clone(), [0.0; 3]);
        let profile = solve(&corridor).unwrap();
        for ([l, ..], (lo, hi)) in profile.l.iter().zip(&limits) {
            assert!(*l >= lo - 1e-9 && *l <= hi + 1e-9, "{l} is outside [{lo}, {hi}]");
        }
        assert!(profile.l.last().unwrap()[0].abs() < 0.1);
        assert!(profile.l.iter().all(|l| l[2].abs() < 0.05), "no sharp bends");
    }

    #[test]
    fn mirrored_corridors_have_mirrored_paths() {
        let mut limits = vec![(-2.0, 2.5); 60];
        limits[20..30].fill((0.4, 2.5));
        let mirrored = limits.iter().map(|(lo, hi)| (-hi, -lo)).collect();
        let one = solve(&corridor(limits, [0.3, 0.02, 0.0])).unwrap();
        let other = solve(&corridor(mirrored, [-0.3, -0.02, 0.0])).unwrap();
        for (a, b) in one.l.iter().zip(&other.l) {
            assert!((a[0] + b[0]).abs() < 1e-12);
        }
    }
}
