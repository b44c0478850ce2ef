//! A pair of curves as a trajectory in the plane (the original's `TrajectoryCombiner`).
//!
//! The line's point at each time belongs to the longitudinal curve alone and is found once for all its pairs. A point is
//! checked without angles; these are found for the trajectory that is driven.

use super::constraints::{Violation, keeps_limits, violation};
use super::cost::Sampled;
use super::curve::Curve;
use super::grid::{SAMPLES, Series, TIMES};
use super::line_table::LineTable;
use crate::decision::{PathPoint, TrajectoryPoint};
use crate::geometry::frenet::Offset;
use crate::geometry::{Pose, Vec2, angle};

/// A car that stands still moves at this speed, m/s, so that it has a direction.
const LEAST_SPEED: f64 = 1e-6;

/// A longitudinal curve on its line, as far as the line leads. What its series hold beyond that means nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct LongitudinalTrack {
    /// How many times of the grid come before the end of the line.
    len: usize,
    /// Stations under the curve.
    s: Series,
    /// Ways since the start, m, beyond the end of the line, too.
    ways: Series,
    /// The line's points, and its direction there.
    x: Series,
    y: Series,
    forward: [Vec2; SAMPLES],
    /// Curvature of the line and its change along it.
    kappa: Series,
    dkappa: Series,
    /// Speed and acceleration along the line.
    v: Series,
    a: Series,
}

impl Default for LongitudinalTrack {
    fn default() -> Self {
        let [s, ways, x, y, kappa, dkappa, v, a] = [[0.0; SAMPLES]; 8];
        let forward = [Vec2::x(); SAMPLES];
        Self {
            len: 0,
            s,
            ways,
            x,
            y,
            forward,
            kappa,
            dkappa,
            v,
            a,
        }
    }
}

impl LongitudinalTrack {
    /// Lays a curve on a line. Where the curve goes back the car stands.
    pub fn new(curve: &Sampled, line: &LineTable) -> Self {
        let mut track = Self::default();
        track.lay(curve, line);
        track
    }

    /// The same in place of what was laid before.
    pub fn lay(&mut self, curve: &Sampled, line: &LineTable) {
        let mut place = 0;
        self.len = 0;
        self.ways = curve.ways;
        for (k, way) in curve.ways.iter().enumerate() {
            let s = curve.s[0] + way;
            if s > line.end() {
                break;
            }
            let at = line.at_next(s, &mut place);
            self.s[k] = s;
            (self.x[k], self.y[k]) = (at.position.x, at.position.y);
            self.forward[k] = at.forward;
            (self.kappa[k], self.dkappa[k]) = (at.kappa, at.dkappa);
            (self.v[k], self.a[k]) = (curve.v[k].max(LEAST_SPEED), curve.a[k]);
            self.len = k + 1;
        }
        // So that no bend is left over there whose centre could be passed.
        self.kappa[self.len..].fill(0.0);
    }

    /// How far it leads in all, m.
    pub(super) fn way(&self) -> f64 {
        self.ways[SAMPLES - 1]
    }

    /// The line's points under it, as far as it leads: `x`, then `y`.
    pub(super) fn positions(&self) -> (&[f64], &[f64]) {
        (&self.x[..self.len], &self.y[..self.len])
    }
}

/// What a pair of curves asks of the car at each time of the grid, as far as the line leads. Where the car is then, only
/// those are told who ask.
#[derive(Clone, Debug)]
pub(super) struct Motions {
    len: usize,
    /// Offset from the line, its first and second derivative by station.
    pub(super) lateral: [Series; 3],
    /// Cosine and sine of the heading error.
    cos: Series,
    sin: Series,
    kappa: Series,
    v: Series,
    a: Series,
}

impl Default for Motions {
    fn default() -> Self {
        let [cos, sin, kappa, v, a] = [[0.0; SAMPLES]; 5];
        Self {
            len: 0,
            lateral: [[0.0; SAMPLES]; 3],
            cos,
            sin,
            kappa,
            v,
            a,
        }
    }
}

impl Motions {
    /// The motions of a pair, in place of what was found before. Where the offset leads beyond the centre of a bend
    /// there are none.
    pub(super) fn find(&mut self, track: &LongitudinalTrack, lateral: &Curve) {
        lateral.sample(&track.ways, &mut self.lateral);
        let mut is_before_centre = true;
        // Without branches, so that several times are worked out at once.
        for k in 0..SAMPLES {
            let l = [self.lateral[0][k], self.lateral[1][k], self.lateral[2][k]];
            let (q, offset) = Offset::unchecked(track.kappa[k], track.dkappa[k], l);
            is_before_centre &= q > 0.0;
            self.kappa[k] = offset.kappa;
            (self.cos[k], self.sin[k]) = offset.turn;
            (self.v[k], self.a[k]) = offset.speed(track.v[k], track.a[k]);
        }
        self.len = if is_before_centre { track.len } else { 0 };
    }

    /// Number of times.
    pub(super) fn len(&self) -> usize {
        self.len
    }

    /// What the motion does that it may not, where the line leads on to its end.
    pub(super) fn violation(&self) -> Option<Violation> {
        let is_whole = self.len == SAMPLES;
        if is_whole && keeps_limits(&self.v, &self.a, &self.kappa) {
            return None;
        }
        violation(self.dynamics())
    }

    /// Time, speed, acceleration and curvature.
    fn dynamics(&self) -> impl Iterator<Item = [f64; 4]> + '_ {
        (0..self.len).map(|k| [TIMES[k], self.v[k], self.a[k], self.kappa[k]])
    }

    /// Place of the rear axle and heading at a time.
    #[inline]
    pub(super) fn place(&self, track: &LongitudinalTrack, k: usize) -> (Vec2, Vec2) {
        let along = track.forward[k];
        let (l, cos, sin) = (self.lateral[0][k], self.cos[k], self.sin[k]);
        (
            Vec2::new(track.x[k] - l * along.y, track.y[k] + l * along.x),
            Vec2::new(along.x * cos - along.y * sin, along.y * cos + along.x * sin),
        )
    }

    /// All of it as points.
    pub(super) fn points<'a>(&'a self, track: &'a LongitudinalTrack) -> impl Iterator<Item = Point> + 'a {
        (0..self.len).map(|k| {
            let (position, forward) = self.place(track, k);
            Point {
                t: TIMES[k],
                position,
                forward,
                kappa: self.kappa[k],
                v: self.v[k],
                a: self.a[k],
                s: track.s[k],
                l: self.lateral[0][k],
            }
        })
    }
}

/// One point of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Time, s.
    pub t: f64,
    /// Rear axle.
    pub position: Vec2,
    /// Heading, as a unit vector.
    pub forward: Vec2,
    /// Curvature, 1/m.
    pub kappa: f64,
    /// Speed, m/s.
    pub v: f64,
    /// Acceleration, m/s².
    pub a: f64,
    /// Station on the line.
    pub s: f64,
    /// Offset from the line.
    pub l: f64,
}

/// The points of a pair, in place of what `points` holds. Where the offset leads beyond the centre of a bend there are
/// none.
pub fn combine(track: &LongitudinalTrack, lateral: &Curve, points: &mut Vec<Point>) {
    let mut motions = Motions::default();
    motions.find(track, lateral);
    points.clear();
    points.extend(motions.points(track));
}

impl Point {
    /// Place and heading.
    pub fn pose(&self) -> Pose {
        let theta = angle::wrap(libm::atan2(self.forward.y, self.forward.x));
        Pose::new(self.position.x, self.position.y, theta)
    }

    /// What its motion asks of the car.
    pub fn dynamics(&self) -> [f64; 4] {
        [self.t, self.v, self.a, self.kappa]
    }
}

/// The trajectory of combined points.
pub fn trajectory(points: &[Point]) -> Vec<TrajectoryPoint> {
    let mut driven: Vec<TrajectoryPoint> = Vec::with_capacity(points.len());
    for point in points {
        let moved = |last: &TrajectoryPoint| last.distance + (point.position - last.pose.position()).norm();
        driven.push(TrajectoryPoint {
            t: point.t,
            distance: driven.last().map_or(0.0, moved),
            pose: point.pose(),
            kappa: point.kappa,
            v: point.v,
            a: point.a,
        });
    }
    driven
}

/// Distance between the points of a path, m.
const PATH_STEP: f64 = 1.0;

/// The way of a lateral curve along a line from one station to another.
pub fn path(line: &LineTable, lateral: &Curve, from: f64, to: f64) -> Vec<PathPoint> {
    let mut points: Vec<PathPoint> = Vec::new();
    let (mut s, mut place) = (from, 0);
    while s <= to.min(line.end()) {
        let at = line.at_next(s, &mut place);
        let [l, dl, ddl, _] = lateral.at(s - from);
        let Some(offset) = Offset::new(at.kappa, at.dkappa, [l, dl, ddl]) else {
            break;
        };
        let theta = angle::wrap(at.theta + libm::atan2(offset.turn.1, offset.turn.0));
        let pose = Pose::new(
            at.position.x - l * at.forward.y,
            at.position.y + l * at.forward.x,
            theta,
        );
        let moved = |last: &PathPoint| last.distance + (pose.position() - last.pose.position()).norm();
        points.push(PathPoint {
            distance: points.last().map_or(0.0, moved),
            s,
            l,
            pose,
            kappa: offset.kappa,
        });
        s += PATH_STEP;
    }
    points
}
