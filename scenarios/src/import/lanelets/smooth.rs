//! Smoothing of a centre line: the points that are near the given ones and whose curvature changes least.
//!
//! Minimises `sum |p_k - q_k|^2 + mu sum |third difference of p|^2` over evenly spaced points `q` (a Whittaker smoother
//! of third order; E. T. Whittaker, "On a New Method of Graduation", 1923). With `mu = (LENGTH / step)^6` waves shorter
//! than `2 pi LENGTH` go and longer ones stay. Ends are held: the line passes through the first and the last
//! point with a given heading and curvature, by means of two points beyond each end.

use corridor_decider::geometry::{Vec2, angle};

/// What is finer than this is the drawing's, not the road's, m. A kink of a polyline becomes a bend of about four times
/// this length.
const LENGTH: f64 = 2.0;

/// Steps are not taken for shorter than this, m: real ones are a quarter of a metre at least.
const LEAST_STEP: f64 = 0.05;

/// How much more a held point weighs than a given one: against `mu`, which is 2.6e5 at most, it is as good as fixed.
const HELD: f64 = 1e12;

/// Points beyond each end.
const BEYOND: usize = 2;

/// Coefficients of a third difference.
const THIRD: [f64; 4] = [-1.0, 3.0, -3.0, 1.0];

/// A point of a smooth line with its direction there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CurvePoint {
    /// World position, m.
    pub(super) position: Vec2,
    /// Heading, rad.
    pub(super) theta: f64,
    /// Curvature, 1/m.
    pub(super) kappa: f64,
}

/// The smooth line near `given` from one pose to the other: at least two points at even distances between a quarter and
/// half a metre (two points: any distance).
pub(super) fn smooth(given: &[Vec2], start: CurvePoint, end: CurvePoint) -> Vec<CurvePoint> {
    let last = given.len() - 1;
    let step = length(given) / last as f64;
    // Far from the origin differences would lose digits.
    let origin = given[0];
    let local = |pose: CurvePoint, s: f64| on_circle(pose, s) - origin;
    let mut points: Vec<Vec2> = Vec::with_capacity(given.len() + 2 * BEYOND);
    points.extend([-2.0, -1.0, 0.0].map(|k| local(start, k * step)));
    points.extend(given[1..last].iter().map(|point| point - origin));
    points.extend([0.0, 1.0, 2.0].map(|k| local(end, k * step)));
    if last > 1 {
        let count = points.len();
        let is_held = |k: usize| k <= BEYOND || k + BEYOND + 1 >= count;
        solve(
            &mut points,
            |k| if is_held(k) { HELD } else { 1.0 },
            stiffness(step),
        );
    }
    let mut line: Vec<CurvePoint> = points[1..points.len() - 1]
        .windows(3)
        .map(|three| curve_point(three, origin))
        .collect();
    // The points beyond the ends hold these up to rounding; joints need them exactly.
    (line[0], line[last]) = (start, end);
    line
}

/// The smooth line near `given`, at even distances, with free ends.
pub(super) fn graduated(given: &[Vec2]) -> Vec<Vec2> {
    let origin = given[0];
    if given.len() < THIRD.len() {
        return given.to_vec();
    }
    let mut points: Vec<Vec2> = given.iter().map(|point| point - origin).collect();
    solve(
        &mut points,
        |_| 1.0,
        stiffness(length(given) / (given.len() - 1) as f64),
    );
    points.iter().map(|point| point + origin).collect()
}

fn length(points: &[Vec2]) -> f64 {
    points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// `mu` for points that are `step` apart.
fn stiffness(step: f64) -> f64 {
    let ratio = LENGTH / step.max(LEAST_STEP);
    let cubed = ratio * ratio * ratio;
    cubed * cubed
}

/// The point `s` along the circle of a pose.
fn on_circle(pose: CurvePoint, s: f64) -> Vec2 {
    let half = pose.kappa * s / 2.0;
    let chord = if half == 0.0 {
        s
    } else {
        s * libm::sin(half) / half
    };
    let (sin, cos) = angle::sin_cos(pose.theta + half);
    pose.position + Vec2::new(cos, sin) * chord
}

/// Direction and curvature of the circle through three points, at the middle one.
pub(super) fn curve_point(three: &[Vec2], origin: Vec2) -> CurvePoint {
    let (before, after) = (three[1] - three[0], three[2] - three[1]);
    let (a, b) = (before.norm(), after.norm());
    let (from, to) = (libm::atan2(before.y, before.x), libm::atan2(after.y, after.x));
    let turn = angle::difference(to, from);
    let both = (a + b).max(f64::MIN_POSITIVE);
    CurvePoint {
        position: three[1] + origin,
        theta: angle::wrap(from + turn * a / both),
        kappa: 2.0 * turn / both,
    }
}

/// Solves `(W + mu D'D) p = W q` in place, `W` the weights and `D` the third differences: a symmetric band matrix of
/// seven diagonals, decomposed as `L diag(d) L'`.
fn solve(points: &mut [Vec2], weight: impl Fn(usize) -> f64, mu: f64) {
    let count = points.len();
    // Row k: the diagonal and three entries to its left, which elimination turns into `d` and `L`.
    let mut rows = vec![[0.0; 4]; count];
    for (k, row) in rows.iter_mut().enumerate() {
        row[0] = weight(k);
        points[k] *= weight(k);
    }
    for first in 0..count - 3 {
        for (i, a) in THIRD.iter().enumerate() {
            for (j, b) in THIRD.iter().enumerate().take(i + 1) {
                rows[first + i][i - j] += mu * a * b;
            }
        }
    }
    for k in 0..count {
        for back in (1..=3.min(k)).rev() {
            let column = k - back;
            // Entries left of both, times the pivots of their columns.
            let shared: f64 = (back + 1..=3.min(k))
                .map(|m| rows[k][m] * rows[column][m - back] * rows[k - m][0])
                .sum();
            rows[k][back] = (rows[k][back] - shared) / rows[column][0];
        }
        for back in 1..=3.min(k) {
            rows[k][0] -= rows[k][back] * rows[k][back] * rows[k - back][0];
            let earlier = points[k - back] * rows[k][back];
            points[k] -= earlier;
        }
    }
    for k in (0..count).rev() {
        points[k] /= rows[k][0];
        for ahead in 1..=3.min(count - 1 - k) {
            // L' is applied after the pivots.
            let later = points[k + ahead] * rows[k + ahead][ahead];
            points[k] -= later;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn the_band_solver_agrees_with_a_full_one() {
        let count = 14;
        let given: Vec<Vec2> = (0u32..14)
            .map(|k| Vec2::new(f64::from(k), f64::from(k * k % 7)))
            .collect();
        let mut solved = given.clone();
        let mu = 40.0;
        let weight = |k: usize| if (3..11).contains(&k) { 1.0 } else { HELD };
        solve(&mut solved, weight, mu);
        let weights = DVector::from_fn(count, |k, _| weight(k));
        let third = DMatrix::from_fn(count - 3, count, |r, c| {
            if (r..r + 4).contains(&c) {
                THIRD[c - r]
            } else {
                0.0
            }
        });
        let matrix = DMatrix::from_diagonal(&weights) + third.transpose() * &third * mu;
        let right = DVector::from_fn(count, |k, _| weights[k] * given[k].y);
        let full = matrix.cholesky().unwrap().solve(&right);
        for k in 0..count {
            assert!(
                (solved[k].y - full[k]).abs() < 1e-6,
                "{k}: {} {}",
                solved[k].y,
                full[k]
            );
        }
    }

    fn pose(x: f64, y: f64, theta: f64, kappa: f64) -> CurvePoint {
        CurvePoint {
            position: Vec2::new(x, y),
            theta,
            kappa,
        }
    }

    #[test]
    fn a_circle_stays_a_circle() {
        let start = pose(1e6, 2e6, 0.3, 0.05);
        let given: Vec<Vec2> = (0..=60).map(|k| on_circle(start, 0.5 * f64::from(k))).collect();
        let end = pose(given[60].x, given[60].y, 0.3 + 0.05 * 30.0, 0.05);
        for (k, point) in smooth(&given, start, end).iter().enumerate() {
            assert!((point.position - given[k]).norm() < 1e-3);
            assert!((point.kappa - 0.05).abs() < 1e-3, "{k}: {}", point.kappa);
        }
        for (point, given) in graduated(&given).iter().zip(&given) {
            // Free ends straighten a little.
            let off = (point - given).norm();
            assert!(off < 0.02, "{off}");
        }
    }

    #[test]
    fn a_kink_becomes_a_bend_and_the_ends_keep_their_pose() {
        let given: Vec<Vec2> = (0..=80)
            .map(|k| Vec2::new(0.5 * f64::from(k), 0.1 * f64::from((k - 40).max(0)) * 0.5))
            .collect();
        let end = pose(40.0, 2.0, libm::atan(0.1), 0.0);
        let line = smooth(&given, pose(0.0, 0.0, 0.0, 0.0), end);
        for pair in line.windows(2) {
            assert!(angle::difference(pair[1].theta, pair[0].theta).abs() < 0.01);
            assert!((pair[1].kappa - pair[0].kappa).abs() < 0.01);
        }
        let off = line.iter().zip(&given).map(|(p, q)| (p.position - q).norm());
        assert!(off.fold(0.0, f64::max) < 0.1);
        assert_eq!(line[80], end);
    }
}
