//! A smooth curve through the points of a bound. World frame, metres.
//!
//! Bounds are drawn with points up to tens of metres apart. Between two of them runs a cubic whose end tangents are
//! those of the circle through three points in a row: points of a circle give that circle. It leaves the chord by at
//! most [`BULGE`], and where the bound has a corner it keeps to the chord.

use super::polyline::Polyline;
use corridor_decider::geometry::{Vec2, angle};

/// Points closer than this say nothing about direction, m: files are drawn to a few centimetres.
const LEAST_CHORD: f64 = 0.5;

/// A bound that turns by more at a point has a corner there, rad.
const CORNER: f64 = std::f64::consts::FRAC_PI_4;

/// Farthest that the curve leaves the chord, m: the rise of a 10 m chord in a bend of 50 m.
const BULGE: f64 = 0.25;

/// How much longer than its neighbour a chord may be to take part in their circle fully. A short last piece says
/// little about the bend of a long one.
const EVEN: f64 = 3.0;

/// A cubic over a chord, by the angles at which it leaves it.
#[derive(Clone, Copy, Debug)]
struct Piece {
    start: Vec2,
    chord: Vec2,
    leaves: f64,
    arrives: f64,
}

impl Piece {
    fn at(&self, t: f64) -> Vec2 {
        let (h10, h11) = (t * (1.0 - t) * (1.0 - t), t * t * (t - 1.0));
        let shift = turned(self.chord, self.leaves) * h10 + turned(self.chord, self.arrives) * h11;
        // The chord's own share of both tangents makes the sum exact for a straight piece.
        let along = t * t * (3.0 - 2.0 * t);
        self.start + self.chord * along + shift
    }
}

/// A curve by the share of the bound's length.
#[derive(Debug)]
pub(super) struct BoundCurve {
    pieces: Vec<Piece>,
    /// Station of each piece's start, and the length last.
    stations: Vec<f64>,
    first: Vec2,
}

impl BoundCurve {
    pub(super) fn through(bound: &Polyline) -> Self {
        let knots = thinned(bound.points());
        let chords: Vec<Vec2> = knots.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mut pieces: Vec<Piece> = knots
            .iter()
            .zip(&chords)
            .map(|(start, chord)| Piece {
                start: *start,
                chord: *chord,
                leaves: 0.0,
                arrives: 0.0,
            })
            .collect();
        for k in 1..pieces.len() {
            let (arrives, leaves) = knot_angles(chords[k - 1], chords[k]);
            pieces[k - 1].arrives = arrives;
            pieces[k].leaves = leaves;
        }
        close_ends(&mut pieces);
        let mut stations = vec![0.0];
        for piece in &mut pieces {
            let length = piece.chord.norm();
            let limit = 4.0 * BULGE / length;
            piece.leaves = piece.leaves.clamp(-limit, limit);
            piece.arrives = piece.arrives.clamp(-limit, limit);
            stations.push(stations[stations.len() - 1] + length);
        }
        Self {
            pieces,
            stations,
            first: bound.first(),
        }
    }

    /// The curve as a polyline of `steps` even steps.
    pub(super) fn drawn(&self, steps: usize) -> Vec<Vec2> {
        (0..=steps).map(|k| self.at(k as f64 / steps as f64)).collect()
    }

    /// The point at a share of the length, from 0 to 1.
    fn at(&self, share: f64) -> Vec2 {
        if self.pieces.is_empty() {
            return self.first;
        }
        let s = share * self.stations[self.stations.len() - 1];
        let above = self
            .stations
            .partition_point(|station| *station <= s)
            .clamp(1, self.pieces.len());
        let (a, b) = (self.stations[above - 1], self.stations[above]);
        self.pieces[above - 1].at(((s - a) / (b - a)).clamp(0.0, 1.0))
    }
}

/// The points that are far enough from each other; the first and the last one always.
fn thinned(points: &[Vec2]) -> Vec<Vec2> {
    let mut kept = vec![points[0]];
    for point in &points[1..] {
        if (point - kept[kept.len() - 1]).norm() >= LEAST_CHORD {
            kept.push(*point);
        }
    }
    let last = points[points.len() - 1];
    if kept[kept.len() - 1] != last {
        if kept.len() > 1 {
            kept.pop();
        }
        kept.push(last);
    }
    kept.dedup();
    kept
}

/// The angles of the common tangent against the chord that ends at a knot and the one that begins there.
fn knot_angles(before: Vec2, after: Vec2) -> (f64, f64) {
    let turn = angle::difference(heading(after), heading(before));
    if turn.abs() > CORNER {
        return (0.0, 0.0);
    }
    // On a circle a tangent leaves a chord by an angle in proportion to the chord's length.
    let (a, b) = (before.norm(), after.norm());
    let part = |own: f64, other: f64| turn * own / (own + other) * (EVEN * other / own).min(1.0);
    (part(a, b), -part(b, a))
}

/// The first and the last piece go on bending as their inner ends do.
fn close_ends(pieces: &mut [Piece]) {
    let count = pieces.len();
    if count >= 2 {
        pieces[0].leaves = -pieces[0].arrives;
        pieces[count - 1].arrives = -pieces[count - 1].leaves;
    }
}

fn heading(v: Vec2) -> f64 {
    libm::atan2(v.y, v.x)
}

fn turned(v: Vec2, by: f64) -> Vec2 {
    let (sin, cos) = angle::sin_cos(by);
    Vec2::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(points: &[Vec2]) -> BoundCurve {
        BoundCurve::through(&Polyline::new(points).unwrap())
    }

    fn on_circle(radius: f64, turn: f64) -> Vec2 {
        let (sin, cos) = angle::sin_cos(turn);
        Vec2::new(radius * sin, radius * (1.0 - cos))
    }

    #[test]
    fn uneven_points_of_a_circle_give_the_circle() {
        let turns = [0.0, 0.1, 0.25, 0.3, 0.45, 0.6];
        let points: Vec<Vec2> = turns.iter().map(|turn| on_circle(60.0, *turn)).collect();
        let curve = curve(&points);
        for k in 0..=100 {
            let off = (curve.at(f64::from(k) / 100.0) - Vec2::new(0.0, 60.0)).norm() - 60.0;
            assert!(off.abs() < 2e-3, "{off} m off at {k} %");
        }
    }

    #[test]
    fn corners_and_long_chords_are_not_rounded_outwards() {
        let corner = curve(&[Vec2::new(0.0, 0.0), Vec2::new(30.0, 0.0), Vec2::new(30.0, 30.0)]);
        let bend = curve(&[Vec2::new(0.0, 0.0), Vec2::new(60.0, 0.0), Vec2::new(110.0, 30.0)]);
        for k in 0..=50 {
            let share = f64::from(k) / 100.0;
            assert!(corner.at(share).y.abs() < 1e-9);
            assert!(bend.at(share).y.abs() < BULGE);
        }
    }

    #[test]
    fn a_single_point_is_a_curve_too() {
        assert_eq!(curve(&[Vec2::new(3.0, 4.0)]).at(0.7), Vec2::new(3.0, 4.0));
    }
}
