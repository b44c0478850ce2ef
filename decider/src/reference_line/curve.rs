//! The bare curve of a reference line: cubic Hermite pieces between knots, evaluated at stations and projected
//! onto. Metres and radians, world frame.
//!
//! Half of all time of a simulated second once went into projections; so the knots lie close together in memory,
//! carry their tangents, and circles around stretches of them keep a search short.

use super::line::{LinePoint, LineSample};
use crate::geometry::{Vec2, angle};

/// Newton steps to a foot. Two reach rounding; the rest is for steps over a knot.
const FOOT_STEPS: usize = 5;

/// A Newton step shorter than this has arrived, m: far below what any file keeps, far above rounding.
const ARRIVED: f64 = 1e-9;

/// A foot farther away than that on the chord by this much is not the nearest point, m.
const RUN_AWAY: f64 = 1e-3;

/// How far from a hint a foot may lie, m: what a car at 80 m/s drives in a planning period.
const WINDOW: f64 = 8.0;

/// Least factor `1 − κ l` that is divided by: nearer to the centre of curvature there is no single foot.
const LEAST_STRETCH: f64 = 0.1;

/// Chords per block: near the square root of the usual number of chords, where the search is shortest.
const BLOCK: usize = 32;

/// How many knots a station may lie away from its place among evenly spaced ones before it is searched for. Lanes
/// begin and end between two steps of their sampling, so a few are usual.
const REACH: usize = 16;

/// A point of the curve with its tangent.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Knot {
    s: f64,
    point: LinePoint,
    tangent: Vec2,
}

impl Knot {
    fn position(&self) -> Vec2 {
        Vec2::new(self.point.x, self.point.y)
    }
}

/// A circle that holds a stretch of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Circle {
    center: Vec2,
    radius: f64,
}

impl Circle {
    fn around(knots: &[Knot]) -> Self {
        let (low, high) = knots.iter().map(Knot::position).fold(
            (Vec2::repeat(f64::MAX), Vec2::repeat(-f64::MAX)),
            |(low, high), p| (low.inf(&p), high.sup(&p)),
        );
        let center = (low + high) / 2.0;
        let reach = |knot: &Knot| (knot.position() - center).norm();
        Self {
            center,
            radius: knots.iter().map(reach).fold(0.0, f64::max),
        }
    }
}

/// A curve through knots by ascending station.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curve {
    knots: Vec<Knot>,
    knots_per_metre: f64,
    /// Circles around stretches of [`BLOCK`] chords.
    blocks: Vec<Circle>,
}

impl Curve {
    pub(super) fn through(samples: &[LineSample]) -> Self {
        let knot = |sample: &LineSample| {
            let (sin, cos) = angle::sin_cos(sample.point.theta);
            Knot {
                s: sample.s,
                point: sample.point,
                tangent: Vec2::new(cos, sin),
            }
        };
        let knots: Vec<Knot> = samples.iter().map(knot).collect();
        let last = knots.len().saturating_sub(1);
        let block = |start: usize| Circle::around(&knots[start..=(start + BLOCK).min(last)]);
        let blocks = (0..last).step_by(BLOCK).map(block).collect();
        let length = match &knots[..] {
            [first, .., last] => last.s - first.s,
            _ => 0.0,
        };
        Self {
            knots_per_metre: knots.len() as f64 / length,
            knots,
            blocks,
        }
    }

    /// The last knot at or before `s` that has a successor, and the fraction of the way to that one.
    pub(super) fn locate(&self, s: f64) -> (usize, f64) {
        let above = self.knots_until(s).clamp(1, self.knots.len() - 1);
        let (a, b) = (self.knots[above - 1].s, self.knots[above].s);
        (above - 1, ((s - a) / (b - a)).clamp(0.0, 1.0))
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
        let length = b.s - a.s;
        let (h00, h10) = ((1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t), t * (1.0 - t) * (1.0 - t));
        let (h01, h11) = (t * t * (3.0 - 2.0 * t), t * t * (t - 1.0));
        let turn = angle::difference(b.point.theta, a.point.theta);
        LinePoint {
            x: h00 * a.point.x + h01 * b.point.x + length * (h10 * a.tangent.x + h11 * b.tangent.x),
            y: h00 * a.point.y + h01 * b.point.y + length * (h10 * a.tangent.y + h11 * b.tangent.y),
            theta: angle::wrap(a.point.theta + turn * t),
            kappa: a.point.kappa + (b.point.kappa - a.point.kappa) * t,
        }
    }

    /// Foot of the perpendicular from `point`: the chord it lies on and the fraction along it, beyond `[0, 1]` only
    /// at the curve's ends. Newton on (point − curve) · tangent = 0 from the foot on the nearest chord.
    pub(super) fn foot(&self, point: Vec2) -> (usize, f64) {
        self.foot_from(self.nearest_chord(point), point)
    }

    /// The foot that one comes to downhill from the station `hint`, as [`Curve::foot`] gives it; `None` where that
    /// leads more than [`WINDOW`] away from the hint.
    pub(super) fn foot_near(&self, point: Vec2, hint: f64) -> Option<(usize, f64)> {
        let k = self.downhill(self.locate(hint).0, point, hint);
        let (k, t) = self.foot_from(k, point);
        let s = self.knots[k].s + t * (self.knots[k + 1].s - self.knots[k].s);
        ((s - hint).abs() <= WINDOW).then_some((k, t))
    }

    /// The chord to which one comes from chord `k` by going on to a nearer one as long as there is one in the window;
    /// the first of equals.
    fn downhill(&self, mut k: usize, point: Vec2, hint: f64) -> usize {
        let last = self.knots.len() - 2;
        let start = k;
        let mut here = self.chord_distance_squared(k, point);
        while k < last && self.knots[k + 1].s - hint <= WINDOW {
            let there = self.chord_distance_squared(k + 1, point);
            if there >= here || there.is_nan() {
                break;
            }
            (k, here) = (k + 1, there);
        }
        while k <= start && k > 0 && hint - self.knots[k].s <= WINDOW {
            let there = self.chord_distance_squared(k - 1, point);
            if there > here || there.is_nan() {
                break;
            }
            (k, here) = (k - 1, there);
        }
        k
    }

    /// The foot by Newton's method from the foot on chord `k`.
    fn foot_from(&self, mut k: usize, point: Vec2) -> (usize, f64) {
        let last = self.knots.len() - 2;
        let mut t = self.chord_fraction(k, point);
        let on_chord = (k, t);
        for _ in 0..FOOT_STEPS {
            let length = self.knots[k + 1].s - self.knots[k].s;
            let at = self.between(k, t);
            let (sin, cos) = angle::sin_cos(at.theta);
            let d = Vec2::new(point.x - at.x, point.y - at.y);
            // The heading's own rate of turn: where the road bends suddenly it is not the mean of the curvatures.
            let turn = angle::difference(self.knots[k + 1].point.theta, self.knots[k].point.theta);
            let stretch = 1.0 - turn / length * (cos * d.y - sin * d.x);
            let step = (cos * d.x + sin * d.y) / stretch.max(LEAST_STRETCH);
            t += step / length;
            if t > 1.0 && k < last {
                (k, t) = (k + 1, 0.0);
            } else if t < 0.0 && k > 0 {
                (k, t) = (k - 1, 1.0);
            } else if step.abs() < ARRIVED || !(0.0..=1.0).contains(&t) {
                break;
            }
        }
        // Beyond the centre of a bend Newton's method runs away from the nearest point: then the chord's foot stays.
        let distance = |(k, t): (usize, f64)| {
            let at = self.between(k, t.clamp(0.0, 1.0));
            Vec2::new(point.x - at.x, point.y - at.y).norm()
        };
        if distance((k, t)) <= distance(on_chord) + RUN_AWAY {
            (k, t)
        } else {
            on_chord
        }
    }

    /// Index of the chord nearest to `point`; the first of equals.
    fn nearest_chord(&self, point: Vec2) -> usize {
        let from_center = |circle: &Circle| (point - circle.center).norm_squared();
        // The block that is probably nearest tells which others need to be looked at.
        let mut likely = (f64::MAX, 0);
        for (block, circle) in self.blocks.iter().enumerate() {
            let distance = from_center(circle);
            if distance < likely.0 {
                likely = (distance, block);
            }
        }
        let mut best = self.nearest_in_block(likely.1, point);
        let mut reach = best.0.sqrt();
        for (block, circle) in self.blocks.iter().enumerate() {
            let limit = circle.radius + reach;
            if block == likely.1 || from_center(circle) > limit * limit {
                continue;
            }
            let found = self.nearest_in_block(block, point);
            if found < best {
                best = found;
                reach = best.0.sqrt();
            }
        }
        best.1
    }

    /// The nearest chord of a block, after its squared distance; the first of equals.
    fn nearest_in_block(&self, block: usize, point: Vec2) -> (f64, usize) {
        let first = block * BLOCK;
        let last = (first + BLOCK).min(self.knots.len() - 1);
        let mut best = (f64::MAX, first);
        for k in first..last {
            let distance = self.chord_distance_squared(k, point);
            if distance < best.0 {
                best = (distance, k);
            }
        }
        best
    }

    fn chord_distance_squared(&self, k: usize, point: Vec2) -> f64 {
        let from = self.knots[k].position();
        let chord = self.knots[k + 1].position() - from;
        (point - from - chord * self.chord_fraction(k, point)).norm_squared()
    }

    /// Where on chord `k` the foot of `point` lies, from 0 to 1.
    fn chord_fraction(&self, k: usize, point: Vec2) -> f64 {
        let from = self.knots[k].position();
        let chord = self.knots[k + 1].position() - from;
        ((point - from).dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference_line::{LineQuery, testing};

    #[test]
    fn searching_by_blocks_finds_the_first_of_the_nearest_chords() {
        let curve = Curve::through(testing::s_curve().samples());
        for k in 0..500 {
            let (sin, cos) = angle::sin_cos(f64::from(k) * 0.7);
            let point = Vec2::new(60.0 + cos * f64::from(k), sin * f64::from(k) * 0.4);
            let all = (0..curve.knots.len() - 1).map(|k| (curve.chord_distance_squared(k, point), k));
            let nearest = all.fold((f64::MAX, 0), |best, next| if next < best { next } else { best });
            assert_eq!(curve.nearest_chord(point), nearest.1);
        }
    }

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

    #[test]
    fn the_way_from_the_foot_is_perpendicular() {
        let line = testing::s_curve();
        for k in 0..300 {
            let s = 1.03 + f64::from(k) * 0.86;
            let point = line.point(s);
            let l = f64::from(k % 41) - 20.0;
            let (sin, cos) = angle::sin_cos(point.theta);
            let found = line.to_frenet(Vec2::new(point.x - l * sin, point.y + l * cos));
            assert!(
                (found.s - s).abs() < 1e-8 && (found.l - l).abs() < 1e-8,
                "{s} {l}: {found:?}"
            );
        }
    }
}
