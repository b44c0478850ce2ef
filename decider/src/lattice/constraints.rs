//! What a motion may not do (the original's `ConstraintChecker1d` and `ConstraintChecker`).

use super::curve::Curve;
use super::grid::{HORIZON, SAMPLES, Series, TIMES};

/// Speeds, m/s.
const SPEED: (f64, f64) = (-0.1, 40.0);

/// Longitudinal accelerations, m/s², and jerks, m/s³.
const ACCELERATION: (f64, f64) = (-6.0, 4.0);
const JERK: (f64, f64) = (-4.0, 2.0);

/// Lateral acceleration, m/s², and jerk, m/s³, to either side.
const LATERAL_ACCELERATION: f64 = 4.0;
const LATERAL_JERK: f64 = 4.0;

/// Curvature to either side, 1/m (`kappa_bound`).
const KAPPA: f64 = 0.1979;

/// How far a one-dimensional motion may be beyond a limit.
const TOLERANCE: f64 = 1e-4;

/// What a trajectory does that it may not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Violation {
    /// Too fast, or backwards.
    Speed,
    /// Speeds up or brakes too hard.
    Acceleration,
    /// Bends more than the steering can.
    Curvature,
    /// Acceleration changes too fast.
    Jerk,
    /// Too fast for its bend.
    LateralAcceleration,
}

/// Time, speed, acceleration and curvature of a trajectory's point.
type Dynamics = [f64; 4];

/// Whether a longitudinal curve keeps speed, acceleration and jerk at all times of the grid before its end.
pub fn keeps_longitudinal_limits(curve: &Curve) -> bool {
    let inside = |value: f64, (low, high): (f64, f64)| value > low - TOLERANCE && value < high + TOLERANCE;
    TIMES.iter().take_while(|t| **t < curve.length()).all(|t| {
        let [_, v, a, jerk] = curve.at(*t);
        inside(v, SPEED) && inside(a, ACCELERATION) && inside(jerk, JERK)
    })
}

/// Whether a lateral curve, driven as a longitudinal one says, keeps lateral acceleration and jerk. The planner leaves
/// that to the check of the whole trajectory.
pub fn keeps_lateral_limits(lateral: &Curve, longitudinal: &Curve) -> bool {
    let start = longitudinal.at(0.0)[0];
    TIMES.iter().take_while(|t| **t < longitudinal.length()).all(|t| {
        let [s, v, a, jerk] = longitudinal.at(*t);
        let [_, dl, ddl, dddl] = lateral.at(s - start);
        (ddl * v * v + dl * a).abs() <= LATERAL_ACCELERATION && (dddl * jerk).abs() <= LATERAL_JERK
    })
}

/// The first thing that a trajectory does within the horizon that it may not: first among its points, then among its
/// pairs of points. A point is time, speed, acceleration and curvature.
pub fn violation(points: impl Iterator<Item = [f64; 4]>) -> Option<Violation> {
    let points = points.take_while(|[t, ..]| *t <= HORIZON);
    let inside = |value: f64, (low, high): (f64, f64)| value >= low && value <= high;
    let of_point = |[_, v, a, kappa]: Dynamics| {
        if !inside(v, SPEED) {
            Some(Violation::Speed)
        } else if !inside(a, ACCELERATION) {
            Some(Violation::Acceleration)
        } else if !inside(kappa, (-KAPPA, KAPPA)) {
            Some(Violation::Curvature)
        } else {
            None
        }
    };
    let of_pair = |([t0, _, a0, _], [t1, v, a1, kappa]): (Dynamics, Dynamics)| {
        if !inside((a1 - a0) / (t1 - t0), JERK) {
            Some(Violation::Jerk)
        } else if !inside(v * v * kappa, (-LATERAL_ACCELERATION, LATERAL_ACCELERATION)) {
            Some(Violation::LateralAcceleration)
        } else {
            None
        }
    };
    let (mut last, mut between) = (None, None);
    for point in points {
        let violates = of_point(point);
        if violates.is_some() {
            return violates;
        }
        if let (Some(last), None) = (last, between) {
            between = of_pair((last, point));
        }
        last = Some(point);
    }
    between
}

/// Whether [`violation`] finds nothing in a trajectory of speed, acceleration and curvature at all times of the grid. Most
/// trajectories are fine, and this looks at several times at once.
#[expect(
    clippy::needless_bitwise_bool,
    reason = "a branch per limit would be one time after the other"
)]
pub(super) fn keeps_limits(v: &Series, a: &Series, kappa: &Series) -> bool {
    let inside = |value: f64, (low, high): (f64, f64)| (value >= low) & (value <= high);
    let mut keeps = true;
    for k in 0..SAMPLES {
        keeps &= inside(v[k], SPEED) & inside(a[k], ACCELERATION) & inside(kappa[k], (-KAPPA, KAPPA));
    }
    for k in 1..SAMPLES {
        let jerk = (a[k] - a[k - 1]) / (TIMES[k] - TIMES[k - 1]);
        let across = v[k] * v[k] * kappa[k];
        keeps &= inside(jerk, JERK) & inside(across, (-LATERAL_ACCELERATION, LATERAL_ACCELERATION));
    }
    keeps
}

/// Whether a curvature is one that the car can drive.
pub(super) fn is_steerable(kappa: f64) -> bool {
    kappa.abs() <= KAPPA
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_look_at_all_times_finds_what_a_look_at_each_finds(
            v in 0.0..39.9, a in -5.9..3.9, kappa in -0.19..0.19, k in 0..SAMPLES, which in 0..3_usize, by in -8.0..8.0,
        ) {
            let mut of = [[v; SAMPLES], [a; SAMPLES], [f64::clamp(kappa, -3.9 / (v * v), 3.9 / (v * v)); SAMPLES]];
            of[which][k] += [by, 0.2 * by, 0.05 * by][which];
            let points = (0..SAMPLES).map(|k| [TIMES[k], of[0][k], of[1][k], of[2][k]]);
            prop_assert_eq!(keeps_limits(&of[0], &of[1], &of[2]), violation(points).is_none());
        }
    }
}
