//! Feet of perpendiculars on a curve: the nearest chord, found over circles around stretches of chords or downhill
//! from a hint, then Newton's method on the curve itself. Metres, world frame.

use super::curve::{Curve, Knot};
use crate::geometry::{Vec2, cross};

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

/// A place on the curve from which a point is seen at a right angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Foot {
    /// The chord it lies on, by its first knot.
    pub(super) k: usize,
    /// The fraction along it, beyond `[0, 1]` only at the curve's ends.
    pub(super) t: f64,
    /// Distance of the point to the left, m; seen from the end where the foot lies beyond it.
    pub(super) l: f64,
}

/// A point as it is seen from a place on the curve.
#[derive(Clone, Copy)]
struct View {
    /// How far ahead along the tangent, m.
    ahead: f64,
    /// How far to the left, m.
    left: f64,
}

impl View {
    fn distance_squared(self) -> f64 {
        self.ahead * self.ahead + self.left * self.left
    }
}

/// The straight way between two neighbouring knots.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Chord {
    from: Vec2,
    along: Vec2,
    /// One over its squared length, 1/m².
    per_length_squared: f64,
}

impl Chord {
    /// Where the foot of `point` lies, from 0 to 1.
    #[inline]
    fn fraction(&self, point: Vec2) -> f64 {
        ((point - self.from).dot(&self.along) * self.per_length_squared).clamp(0.0, 1.0)
    }

    /// The same on the arc over the chord that turns by `turn`, for a point nearer than the arc's centre.
    fn fraction_of_arc(&self, turn: f64, point: Vec2) -> f64 {
        let to = (point - self.from) * self.per_length_squared;
        let (ahead, left) = (self.along.dot(&to), cross(self.along, to));
        (0.5 + (ahead - 0.5) / (1.0 - turn * left).max(LEAST_STRETCH)).clamp(0.0, 1.0)
    }

    #[inline]
    fn distance_squared(&self, point: Vec2) -> f64 {
        (point - self.from - self.along * self.fraction(point)).norm_squared()
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

/// The chords of a curve, with circles around stretches of [`BLOCK`] of them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chords {
    chords: Vec<Chord>,
    blocks: Vec<Circle>,
}

impl Chords {
    /// From one knot to the next.
    #[inline]
    pub(super) fn along(&self, k: usize) -> Vec2 {
        self.chords[k].along
    }

    pub(super) fn between(knots: &[Knot]) -> Self {
        let chord = |pair: &[Knot]| {
            let along = pair[1].position() - pair[0].position();
            Chord {
                from: pair[0].position(),
                along,
                per_length_squared: 1.0 / along.norm_squared(),
            }
        };
        let last = knots.len().saturating_sub(1);
        let block = |start: usize| Circle::around(&knots[start..=(start + BLOCK).min(last)]);
        Self {
            chords: knots.windows(2).map(chord).collect(),
            blocks: (0..last).step_by(BLOCK).map(block).collect(),
        }
    }

    /// Index of the chord nearest to `point`; the first of equals.
    fn nearest(&self, point: Vec2) -> usize {
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
        let last = (first + BLOCK).min(self.chords.len());
        let mut best = (f64::MAX, first);
        for k in first..last {
            let distance = self.chords[k].distance_squared(point);
            if distance < best.0 {
                best = (distance, k);
            }
        }
        best
    }
}

impl Curve {
    /// Foot of the perpendicular from `point`: by Newton's method from the foot on the nearest chord.
    pub(super) fn foot(&self, point: Vec2) -> Foot {
        self.foot_from(self.chords.nearest(point), point)
    }

    /// The foot that one comes to downhill from the station `hint`, as [`Curve::foot`] gives it; `None` where that
    /// leads more than [`WINDOW`] away from the hint.
    pub(super) fn foot_near(&self, point: Vec2, hint: f64) -> Option<Foot> {
        let k = self.downhill(self.piece_at(hint), point, hint);
        let foot = self.foot_from(k, point);
        let s = self.station(foot.k, foot.t);
        ((s - hint).abs() <= WINDOW).then_some(foot)
    }

    /// The chord to which one comes from chord `k` by going on to a nearer one as long as there is one in the window;
    /// the first of equals.
    fn downhill(&self, mut k: usize, point: Vec2, hint: f64) -> usize {
        let chords = &self.chords.chords;
        let last = chords.len() - 1;
        let start = k;
        let mut here = chords[k].distance_squared(point);
        while k < last && self.knots[k + 1].s - hint <= WINDOW {
            let there = chords[k + 1].distance_squared(point);
            if there >= here || there.is_nan() {
                break;
            }
            (k, here) = (k + 1, there);
        }
        while k <= start && k > 0 && hint - self.knots[k].s <= WINDOW {
            let there = chords[k - 1].distance_squared(point);
            if there > here || there.is_nan() {
                break;
            }
            (k, here) = (k - 1, there);
        }
        k
    }

    /// The foot by Newton's method on (point − curve) · tangent = 0, from where it is if the piece at chord `k` is an
    /// arc.
    fn foot_from(&self, mut k: usize, point: Vec2) -> Foot {
        let chord = &self.chords.chords[k];
        let mut t = chord.fraction_of_arc(self.knots[k].turn, point);
        let (last, on_chord) = (self.chords.chords.len() - 1, k);
        let mut view = self.view((k, t), point);
        for _ in 0..FOOT_STEPS {
            let Knot { length, turn, .. } = self.knots[k];
            // The heading's own rate of turn: where the road bends suddenly it is not the mean of the curvatures.
            let step = view.ahead / (length - turn * view.left).max(LEAST_STRETCH * length);
            t += step;
            if (step * length).abs() < ARRIVED && (0.0..=1.0).contains(&t) {
                break;
            }
            if t > 1.0 && k < last {
                (k, t) = (k + 1, 0.0);
            } else if t < 0.0 && k > 0 {
                (k, t) = (k - 1, 1.0);
            }
            view = self.view((k, t.clamp(0.0, 1.0)), point);
            if !(0.0..=1.0).contains(&t) {
                break;
            }
        }
        // Beyond the centre of a bend Newton's method runs away from the nearest point: then the chord's foot stays.
        let (found, known) = (view.distance_squared(), chord.distance_squared(point));
        let sagitta = self.knots[on_chord].length * self.knots[on_chord].turn.abs() / 8.0;
        if found > known && found.sqrt() > known.sqrt() + sagitta + RUN_AWAY {
            (k, t) = (on_chord, chord.fraction(point));
            view = self.view((k, t), point);
        }
        Foot { k, t, l: view.left }
    }

    #[inline]
    fn view(&self, (k, t): (usize, f64), point: Vec2) -> View {
        let d = point - self.position(k, t);
        let tangent = self.tangent(k, t);
        View {
            ahead: tangent.dot(&d),
            left: tangent.x * d.y - tangent.y * d.x,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::angle;
    use crate::reference_line::{LineQuery, testing};

    #[test]
    fn searching_by_blocks_finds_the_first_of_the_nearest_chords() {
        let curve = Curve::through(testing::s_curve().samples());
        for k in 0..500 {
            let (sin, cos) = angle::sin_cos(f64::from(k) * 0.7);
            let point = Vec2::new(60.0 + cos * f64::from(k), sin * f64::from(k) * 0.4);
            let all =
                (0..curve.chords.chords.len()).map(|k| (curve.chords.chords[k].distance_squared(point), k));
            let nearest = all.fold((f64::MAX, 0), |best, next| if next < best { next } else { best });
            assert_eq!(curve.chords.nearest(point), nearest.1);
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
