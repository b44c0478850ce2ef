//! A smooth line along the points of a lane.
//!
//! Surveyed lanes have a point every 0.2 m, with millimetres of noise that would be bends of metres; drawn ones have a
//! point every 5 to 100 m. So points that lie close are averaged into *knots*, and through the knots goes a curve of
//! quintics that share position, heading and curvature. Where a long piece meets a short one, the rules for heading
//! and curvature favour the long one: it stays as straight as it was drawn.

use corridor_decider::geometry::{Quintic, Vec2, angle};

/// Points are averaged over this much of a lane, m: ten surveyed points, and a sharp bend of radius 5 m is cut by
/// 3 cm.
const AVERAGED: f64 = 2.0;

/// Knots are at least this far apart, m.
const LEAST_STEP: f64 = 0.1;

/// Sharpest curvature of a knot, 1/m. Sharper ones are kinks of the drawing.
const MAX_CURVATURE: f64 = 1.0;

/// Points to draw a curve through.
#[derive(Clone, Debug)]
pub(super) struct Knots {
    /// Where they are.
    positions: Vec<Vec2>,
    /// Their stations along the polyline, m.
    stations: Vec<f64>,
}

/// Sums over a group of points.
#[derive(Default)]
struct Mean {
    position: Vec2,
    station: f64,
    count: f64,
}

impl Mean {
    fn add(&mut self, position: Vec2, station: f64) {
        self.position += position;
        self.station += station;
        self.count += 1.0;
    }
}

impl Knots {
    /// The knots of a polyline: both ends as they are, averages between.
    pub(super) fn new(points: &[Vec2]) -> Self {
        let mut knots = Self {
            positions: vec![points[0]],
            stations: vec![0.0],
        };
        let length: f64 = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        // Equal groups, so that none is left over at the end with a point too few.
        let group = length / (length / AVERAGED).round().max(1.0);
        let (mut s, mut mean, mut end) = (0.0, Mean::default(), group);
        for pair in points[..points.len() - 1].windows(2) {
            s += (pair[1] - pair[0]).norm();
            if s > end {
                knots.close(&mut mean, points[0]);
                end = (s / group).ceil() * group;
            }
            mean.add(pair[1] - points[0], s);
        }
        knots.close(&mut mean, points[0]);
        knots.finish(points[points.len() - 1], length);
        knots
    }

    /// Makes a group of points a knot, unless it is empty.
    fn close(&mut self, mean: &mut Mean, origin: Vec2) {
        if mean.count > 0.0 {
            self.push(origin + mean.position / mean.count, mean.station / mean.count);
        }
        *mean = Mean::default();
    }

    fn push(&mut self, position: Vec2, station: f64) {
        let before = self.positions[self.positions.len() - 1];
        if (position - before).norm() >= LEAST_STEP {
            self.positions.push(position);
            self.stations.push(station);
        }
    }

    /// The last point stays, whatever lies too close before it.
    fn finish(&mut self, position: Vec2, station: f64) {
        while self.positions.len() > 1
            && (position - self.positions[self.positions.len() - 1]).norm() < LEAST_STEP
        {
            self.positions.pop();
            self.stations.pop();
        }
        self.positions.push(position);
        self.stations.push(station);
    }

    /// Directions of the chords.
    fn chords(&self) -> Vec<(f64, f64)> {
        let chord = |pair: &[Vec2]| {
            let along = pair[1] - pair[0];
            (along.norm(), libm::atan2(along.y, along.x))
        };
        self.positions.windows(2).map(chord).collect()
    }

    /// Headings at the first and the last knot as this line alone has them, and how far the line turns next to each.
    pub(super) fn ends(&self) -> [(f64, f64); 2] {
        let headings = self.headings([None, None]);
        let chords = self.chords();
        let (first, last) = (0, headings.len() - 1);
        [
            (
                headings[first],
                angle::difference(chords[first].1, headings[first]).abs(),
            ),
            (
                headings[last],
                angle::difference(headings[last], chords[last - 1].1).abs(),
            ),
        ]
    }

    /// Headings at the knots: of the chord from the knot before to the knot behind, and at the ends so that the piece
    /// there is an arc, unless the end's heading is known.
    fn headings(&self, known: [Option<f64>; 2]) -> Vec<f64> {
        let chords = self.chords();
        let last = self.positions.len() - 1;
        let mut headings: Vec<f64> = (0..=last)
            .map(|k| {
                let along = self.positions[(k + 1).min(last)] - self.positions[k.saturating_sub(1)];
                libm::atan2(along.y, along.x)
            })
            .collect();
        if last > 1 {
            let mirrored = |chord: f64, inner: f64| angle::wrap(chord + angle::difference(chord, inner));
            headings[0] = mirrored(chords[0].1, headings[1]);
            headings[last] = mirrored(chords[last - 1].1, headings[last - 1]);
        }
        headings[0] = known[0].unwrap_or(headings[0]);
        headings[last] = known[1].unwrap_or(headings[last]);
        headings
    }

    /// The curve through the knots; headings at the ends may be known from the lanes before and behind.
    pub(super) fn curve(&self, known: [Option<f64>; 2]) -> Curve {
        let headings = self.headings(known);
        let turns: Vec<f64> = headings
            .windows(2)
            .map(|pair| angle::difference(pair[1], pair[0]))
            .collect();
        let lengths: Vec<f64> = self
            .chords()
            .iter()
            .zip(&turns)
            .map(|((chord, _), turn)| arc_length(*chord, *turn))
            .collect();
        let bends: Vec<f64> = turns
            .iter()
            .zip(&lengths)
            .map(|(turn, length)| turn / length)
            .collect();
        let last = bends.len();
        let kappa = |k: usize| match k {
            0 => bends[0],
            k if k == last => bends[last - 1],
            k => between(bends[k - 1], bends[k]),
        };
        let pieces = (0..last).map(|k| {
            Piece::new(
                [self.positions[k], self.positions[k + 1]],
                [headings[k], headings[k + 1]],
                [kappa(k), kappa(k + 1)].map(|kappa| kappa.clamp(-MAX_CURVATURE, MAX_CURVATURE)),
                [self.stations[k], self.stations[k + 1]],
                lengths[k],
            )
        });
        Curve {
            pieces: pieces.collect(),
        }
    }
}

/// Length of the arc over a chord.
fn arc_length(chord: f64, turn: f64) -> f64 {
    /// Below this the quotient says nothing, rad.
    const STRAIGHT: f64 = 1e-6;
    let half = 0.5 * turn;
    if half.abs() < STRAIGHT {
        return chord;
    }
    chord * half / libm::sin(half)
}

/// Curvature of a knot between two bends: their harmonic mean, and none where they bend apart. It never exceeds twice
/// the smaller, so that a line nowhere bends more than it was drawn.
fn between(a: f64, b: f64) -> f64 {
    if a * b <= 0.0 { 0.0 } else { 2.0 * a * b / (a + b) }
}

/// A curve of pieces.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    pub(super) pieces: Vec<Piece>,
}

impl Curve {
    /// Length of the polyline that it follows, m.
    pub(super) fn drawn_length(&self) -> f64 {
        self.pieces.last().map_or(0.0, |piece| piece.end.station)
    }
}

/// A stretch of a curve between two knots.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    origin: Vec2,
    x: Quintic,
    y: Quintic,
    /// Range of its parameter, about its length, m.
    pub(super) length: f64,
    /// Station of the polyline at its start.
    station: f64,
    /// The knot at its end, as given: a quintic holds still there.
    end: CurvePoint,
    /// The sharper of the curvatures at its ends and between.
    pub(super) sharpest: f64,
}

/// A place on a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct CurvePoint {
    pub(super) position: Vec2,
    pub(super) theta: f64,
    pub(super) kappa: f64,
    /// Station of the polyline that the curve follows, m.
    pub(super) station: f64,
}

impl Piece {
    fn new(ends: [Vec2; 2], headings: [f64; 2], kappas: [f64; 2], stations: [f64; 2], length: f64) -> Self {
        let origin = ends[0];
        let state = |k: usize| {
            let (sin, cos) = angle::sin_cos(headings[k]);
            let at = ends[k] - origin;
            ([at.x, cos, -kappas[k] * sin], [at.y, sin, kappas[k] * cos])
        };
        let ((x0, y0), (x1, y1)) = (state(0), state(1));
        let mut piece = Self {
            origin,
            x: Quintic::between(x0, x1, length),
            y: Quintic::between(y0, y1, length),
            length,
            station: stations[0],
            end: CurvePoint {
                position: ends[1],
                theta: headings[1],
                kappa: kappas[1],
                station: stations[1],
            },
            sharpest: 0.0,
        };
        let bends = [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| piece.at(t).kappa.abs());
        piece.sharpest = bends.into_iter().fold(0.0, f64::max);
        piece
    }

    /// The place at a share of the piece, 0 to 1.
    pub(super) fn at(&self, share: f64) -> CurvePoint {
        if share >= 1.0 {
            return self.end;
        }
        let p = share * self.length;
        let ([x, dx, ddx, _], [y, dy, ddy, _]) = (self.x.evaluate(p), self.y.evaluate(p));
        let speed = libm::hypot(dx, dy);
        let kappa = if speed > 0.0 {
            (dx * ddy - dy * ddx) / (speed * speed * speed)
        } else {
            0.0
        };
        CurvePoint {
            position: self.origin + Vec2::new(x, y),
            theta: libm::atan2(dy, dx),
            kappa,
            station: self.station + share * (self.end.station - self.station),
        }
    }
}
