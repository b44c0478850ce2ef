//! Motion along a reference line and in the plane, each from the other (the original's `CartesianFrenetConverter`).
//!
//! `s` runs along the line, `l` to its left; derivatives of `l` are by station, those of `s` by time. With `q = 1 − κ l`
//! and the heading error Δ, `tan Δ = l'/q`: what stands at or beyond the centre of a bend, or across the line, has no
//! such motion, and the answer is `None`.

use super::{Pose, angle};

/// A motion belongs to a foot whose station differs by less, m (the original's).
const SAME_STATION: f64 = 1e-6;

/// Heading errors whose cosine is below this are across the line.
const LEAST_COSINE: f64 = 1e-9;

/// The point of a line that belongs to a station.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// Station, m.
    pub s: f64,
    /// Place and direction of the line.
    pub pose: Pose,
    /// Curvature of the line, 1/m.
    pub kappa: f64,
    /// Its change along the line, 1/m².
    pub dkappa: f64,
}

/// Motion in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneMotion {
    /// Place and heading.
    pub pose: Pose,
    /// Curvature, 1/m.
    pub kappa: f64,
    /// Speed, m/s.
    pub v: f64,
    /// Acceleration along the heading, m/s².
    pub a: f64,
}

/// Motion along a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrenetMotion {
    /// Station and its first and second derivative by time.
    pub s: [f64; 3],
    /// Offset and its first and second derivative by station.
    pub l: [f64; 3],
}

/// What an offset makes of the line's motion, without angles: all that is needed to check a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offset {
    /// Cosine and sine of the heading error.
    pub turn: (f64, f64),
    /// Path length per station.
    pub stretch: f64,
    /// Curvature of the path, 1/m.
    pub kappa: f64,
    /// What `l'Δ' − m` is: how the stretch changes, for accelerations.
    drift: f64,
}

impl Offset {
    /// At an offset with its derivatives; `None` at or beyond the centre of the bend.
    pub fn new(foot_kappa: f64, foot_dkappa: f64, l: [f64; 3]) -> Option<Self> {
        let (q, offset) = Self::unchecked(foot_kappa, foot_dkappa, l);
        (q > 0.0).then_some(offset)
    }

    /// The same after `q`, without a branch. At or beyond the centre of the bend, where that is not positive, it means
    /// nothing.
    #[inline]
    pub(crate) fn unchecked(foot_kappa: f64, foot_dkappa: f64, [l, dl, ddl]: [f64; 3]) -> (f64, Self) {
        let q = 1.0 - foot_kappa * l;
        let m = foot_dkappa * l + foot_kappa * dl;
        // The length of the tangent (q, l'): path length per station.
        let stretch = (q * q + dl * dl).sqrt();
        // One division for both reciprocals: hundreds of thousands of offsets are looked at in a second.
        let per_both = 1.0 / (q * stretch);
        let (per_stretch, per_q) = (per_both * q, per_both * stretch);
        let turn_rate = (ddl * q + m * dl) * per_stretch * per_stretch;
        let offset = Self {
            turn: (q * per_stretch, dl * per_stretch),
            stretch,
            kappa: (turn_rate + foot_kappa) * per_stretch,
            drift: (dl * turn_rate - m) * stretch * per_q,
        };
        (q, offset)
    }

    /// Speed and acceleration along the path of a motion along the line.
    #[inline]
    pub fn speed(&self, s_dot: f64, s_ddot: f64) -> (f64, f64) {
        (
            s_dot.abs() * self.stretch,
            s_ddot * self.stretch + s_dot * s_dot * self.drift,
        )
    }
}

impl Foot {
    /// The motion along the line of a motion in the plane whose foot this is; `None` at or beyond the centre of the
    /// bend and across the line.
    pub fn to_frenet(&self, motion: &PlaneMotion) -> Option<FrenetMotion> {
        let l = self.offset(motion.pose);
        let turn = angle::difference(motion.pose.theta, self.pose.theta);
        let (_, cos) = angle::sin_cos(turn);
        let q = 1.0 - self.kappa * l;
        if q.is_nan() || q <= 0.0 || cos < LEAST_COSINE {
            return None;
        }
        let [dl, ddl] = slopes(self, l, turn, motion.kappa);
        let m = self.dkappa * l + self.kappa * dl;
        let s_dot = motion.v * cos / q;
        let turn_rate = q / cos * motion.kappa - self.kappa;
        let s_ddot = (motion.a * cos - s_dot * s_dot * (dl * turn_rate - m)) / q;
        Some(FrenetMotion {
            s: [self.s, s_dot, s_ddot],
            l: [l, dl, ddl],
        })
    }

    /// Distance from the line, left positive.
    pub fn offset(&self, pose: Pose) -> f64 {
        let (dx, dy) = (pose.x - self.pose.x, pose.y - self.pose.y);
        let (sin, cos) = angle::sin_cos(self.pose.theta);
        (dx * dx + dy * dy).sqrt().copysign(cos * dy - sin * dx)
    }

    /// The motion in the plane of a motion along the line at this foot; `None` at or beyond the centre of the bend, and
    /// for a motion at another station.
    pub fn to_plane(&self, motion: &FrenetMotion) -> Option<PlaneMotion> {
        if (self.s - motion.s[0]).abs() >= SAME_STATION {
            return None;
        }
        let offset = Offset::new(self.kappa, self.dkappa, motion.l)?;
        let (v, a) = offset.speed(motion.s[1], motion.s[2]);
        let (sin, cos) = angle::sin_cos(self.pose.theta);
        let [l, ..] = motion.l;
        let theta = angle::wrap(self.pose.theta + libm::atan2(offset.turn.1, offset.turn.0));
        Some(PlaneMotion {
            pose: Pose::new(self.pose.x - l * sin, self.pose.y + l * cos, theta),
            kappa: offset.kappa,
            v,
            a,
        })
    }
}

/// First and second derivative by station of the offset `l` of a path of curvature `kappa` that turns away from the line
/// by `turn`, less than a right angle.
pub fn slopes(foot: &Foot, l: f64, turn: f64, kappa: f64) -> [f64; 2] {
    let (sin, cos) = angle::sin_cos(turn);
    let tan = sin / cos;
    let q = 1.0 - foot.kappa * l;
    let dl = q * tan;
    let m = foot.dkappa * l + foot.kappa * dl;
    [dl, -m * tan + q / (cos * cos) * (kappa * q / cos - foot.kappa)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn foot() -> Foot {
        Foot {
            s: 12.0,
            pose: Pose::new(100.0, 50.0, 0.3),
            kappa: 0.01,
            dkappa: 0.001,
        }
    }

    /// Worked numbers of the specification.
    #[test]
    fn agrees_with_the_worked_numbers() {
        let (sin, cos) = angle::sin_cos(0.3);
        let ego = PlaneMotion {
            pose: Pose::new(100.0 - 0.8 * sin, 50.0 + 0.8 * cos, 0.35),
            kappa: 0.012,
            v: 8.0,
            a: 0.6,
        };
        let found = foot().to_frenet(&ego).unwrap();
        let wanted = [8.054_437_6, 0.682_635_1, 0.8, 0.049_641_4, 0.001_843_4];
        let got = [found.s[1], found.s[2], found.l[0], found.l[1], found.l[2]];
        for (got, wanted) in got.iter().zip(wanted) {
            assert!((got - wanted).abs() < 1e-7, "{got} is not {wanted}");
        }
    }

    #[test]
    fn there_is_no_motion_along_a_line_beyond_its_centre_or_across_it() {
        let beyond = FrenetMotion {
            s: [12.0, 5.0, 0.0],
            l: [100.0, 0.0, 0.0],
        };
        assert!(foot().to_plane(&beyond).is_none());
        for turn in [2.0, -2.0, std::f64::consts::FRAC_PI_2] {
            let across = PlaneMotion {
                pose: Pose::new(100.0, 50.0, 0.3 + turn),
                kappa: 0.0,
                v: 5.0,
                a: 0.0,
            };
            assert!(foot().to_frenet(&across).is_none());
        }
    }

    proptest! {
        #[test]
        fn there_and_back_is_the_same(kappa in -0.1..0.1, dkappa in -0.02..0.02, l in -3.0..3.0, dl in -0.8..0.8,
                                      ddl in -0.1..0.1, v in 0.0..30.0, a in -6.0..4.0, theta in -3.1..3.1) {
            let foot = Foot { s: 7.0, pose: Pose::new(3.0, -8.0, theta), kappa, dkappa };
            let motion = FrenetMotion { s: [7.0, v, a], l: [l, dl, ddl] };
            let plane = foot.to_plane(&motion).unwrap();
            let again = foot.to_frenet(&plane).unwrap();
            for (got, wanted) in again.s.iter().chain(&again.l).zip(motion.s.iter().chain(&motion.l)) {
                prop_assert!((got - wanted).abs() < 1e-9 * wanted.abs().max(1.0), "{:?} {:?}", again, motion);
            }
        }
    }
}
