//! The bare curve of a reference line: cubic Hermite pieces between knots, evaluated at stations. Metres and radians,
//! world frame. [`super::foot`] projects onto it.
//!
//! Half of all time of a simulated second once went into projections; so the knots lie close together in memory and
//! carry what an evaluation would otherwise work out anew: tangents, and the way to the next knot.

use super::foot::Chords;
use super::line::{LinePoint, LineSample};
use crate::geometry::angle::turned;
use crate::geometry::{Vec2, angle};

/// How many knots a station may lie away from its place among evenly spaced ones before it is searched for. Lanes
/// begin and end between two steps of their sampling, so a few are usual.
const REACH: usize = 16;

/// A point of the curve with its tangent, and the piece behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Knot {
    pub(super) s: f64,
    pub(super) point: LinePoint,
    pub(super) tangent: Vec2,
    /// Length of the piece to the next knot, m; of the last knot nothing.
    pub(super) length: f64,
    /// By how much the heading turns along it, rad.
    pub(super) turn: f64,
}

impl Knot {
    #[inline]
    pub(super) fn position(&self) -> Vec2 {
        Vec2::new(self.point.x, self.point.y)
    }
}

/// A curve through knots by ascending station.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curve {
    pub(super) knots: Vec<Knot>,
    knots_per_metre: f64,
    pub(super) chords: Chords,
}

impl Curve {
    pub(super) fn through(samples: &[LineSample]) -> Self {
        let knot = |(k, sample): (usize, &LineSample)| {
            let (sin, cos) = angle::sin_cos(sample.point.theta);
            let next = samples.get(k + 1);
            Knot {
                s: sample.s,
                point: sample.point,
                tangent: Vec2::new(cos, sin),
                length: next.map_or(0.0, |next| next.s - sample.s),
                turn: next.map_or(0.0, |next| {
                    angle::difference(next.point.theta, sample.point.theta)
                }),
            }
        };
        let knots: Vec<Knot> = samples.iter().enumerate().map(knot).collect();
        let length = match &knots[..] {
            [first, .., last] => last.s - first.s,
            _ => 0.0,
        };
        Self {
            knots_per_metre: knots.len() as f64 / length,
            chords: Chords::between(&knots),
            knots,
        }
    }

    /// The last knot at or before `s` that has a successor, and the fraction of the way to that one.
    pub(super) fn locate(&self, s: f64) -> (usize, f64) {
        let k = self.piece_at(s);
        let (a, b) = (self.knots[k].s, self.knots[k + 1].s);
        (k, ((s - a) / (b - a)).clamp(0.0, 1.0))
    }

    /// The last knot at or before `s` that has a successor.
    #[inline]
    pub(super) fn piece_at(&self, s: f64) -> usize {
        self.knots_until(s).clamp(1, self.knots.len() - 1) - 1
    }

    /// How many knots lie at or before `s`: counted from where `s` would lie among even ones.
    fn knots_until(&self, s: f64) -> usize {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "saturates, and is only a guess"
        )]
        let guess = ((s - self.knots[0].s) * self.knots_per_metre) as usize;
        let mut count = guess.min(self.knots.len());
        for _ in 0..REACH {
            if count > 0 && self.knots[count - 1].s > s {
                count -= 1;
            } else if count < self.knots.len() && self.knots[count].s <= s {
                count += 1;
            } else {
                return count;
            }
        }
        self.knots.partition_point(|knot| knot.s <= s)
    }

    /// The curve between knots `k` and `k + 1` at fraction `t`: a cubic with the knots' tangents.
    pub(super) fn between(&self, k: usize, t: f64) -> LinePoint {
        let (a, b) = (&self.knots[k], &self.knots[k + 1]);
        let position = self.position(k, t);
        LinePoint {
            x: position.x,
            y: position.y,
            theta: angle::wrap(a.point.theta + a.turn * t),
            kappa: a.point.kappa + (b.point.kappa - a.point.kappa) * t,
        }
    }

    /// The place of [`Curve::between`].
    #[inline]
    pub(super) fn position(&self, k: usize, t: f64) -> Vec2 {
        let a = &self.knots[k];
        let (rest, square) = (1.0 - t, t * t);
        let (to_b, from_a, into_b) = (square * (3.0 - 2.0 * t), t * rest * rest, -square * rest);
        let bend = a.tangent * from_a + self.knots[k + 1].tangent * into_b;
        a.position() + self.chords.along(k) * to_b + bend * a.length
    }

    /// The station at fraction `t` of the piece behind knot `k`.
    #[inline]
    pub(super) fn station(&self, k: usize, t: f64) -> f64 {
        self.knots[k].s + t * self.knots[k].length
    }

    /// Cosine and sine of the heading of [`Curve::between`]: the knot's tangent, turned.
    #[inline]
    pub(super) fn tangent(&self, k: usize, t: f64) -> Vec2 {
        let a = &self.knots[k];
        turned(a.tangent, a.turn * t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference_line::testing;

    #[test]
    fn a_station_is_found_among_uneven_knots() {
        let mut samples = testing::s_curve().samples().to_vec();
        // A gap, and a crowd behind it.
        samples.drain(30..200);
        samples.drain(250..251);
        let curve = Curve::through(&samples);
        for k in -20..2700 {
            let s = f64::from(k) * 0.1;
            let counted = samples.iter().filter(|sample| sample.s <= s).count();
            assert_eq!(curve.knots_until(s), counted, "at {s}");
        }
        for s in [f64::NAN, f64::INFINITY, -f64::INFINITY, 1e300] {
            assert!(curve.locate(s).0 + 1 < samples.len());
        }
    }
}
