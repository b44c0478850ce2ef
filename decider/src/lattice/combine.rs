//! A pair of curves as a trajectory in the plane (the original's `TrajectoryCombiner`).
//!
//! The line's point at each time belongs to the longitudinal curve alone and is found once for all its pairs. A point is
//! checked without angles; these are found for the trajectory that is driven.

use super::cost::Sampled;
use super::curve::Curve;
use super::grid::{SAMPLES, TIMES};
use super::line_table::LineTable;
use crate::decision::{PathPoint, TrajectoryPoint};
use crate::geometry::frenet::{Foot, Offset};
use crate::geometry::{Pose, Vec2, angle};

/// A car that stands still moves at this speed, m/s, so that it has a direction.
const LEAST_SPEED: f64 = 1e-6;

/// One point of a longitudinal curve on its line.
#[derive(Clone, Copy, Debug, PartialEq)]
struct OnLine {
    t: f64,
    foot: Foot,
    forward: Vec2,
    /// Speed and acceleration along the line.
    speed: (f64, f64),
}

/// A longitudinal curve on its line, as far as the line leads.
#[derive(Clone, Debug, PartialEq)]
pub struct LongitudinalTrack {
    points: Vec<OnLine>,
    /// Ways along the line since the start, m.
    ways: [f64; SAMPLES],
}

impl Default for LongitudinalTrack {
    fn default() -> Self {
        Self {
            points: Vec::with_capacity(SAMPLES),
            ways: [0.0; SAMPLES],
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
        self.points.clear();
        let start = curve.at[0][0];
        let (mut before, mut place) = (f64::NEG_INFINITY, 0);
        for (k, [s, v, a, _]) in curve.at.iter().enumerate() {
            let s = s.max(before);
            if s > line.end() {
                break;
            }
            before = s;
            let (foot, forward) = line.at_next(s, &mut place);
            self.ways[k] = s - start;
            self.points.push(OnLine {
                t: TIMES[k],
                foot,
                forward,
                speed: (v.max(LEAST_SPEED), *a),
            });
        }
    }

    /// The line's points under it.
    pub(super) fn positions(&self) -> impl Iterator<Item = Vec2> + '_ {
        self.points.iter().map(|point| point.foot.pose.position())
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
    points.clear();
    let [offsets, slopes, bends] = lateral.along(&track.ways);
    for (k, on) in track.points.iter().enumerate() {
        let [l, dl, ddl] = [offsets[k], slopes[k], bends[k]];
        let Some(offset) = Offset::new(on.foot.kappa, on.foot.dkappa, [l, dl, ddl]) else {
            points.clear();
            return;
        };
        let (cos, sin) = offset.turn;
        let along = on.forward;
        let (v, a) = offset.speed(on.speed.0, on.speed.1);
        points.push(Point {
            t: on.t,
            position: Vec2::new(on.foot.pose.x - l * along.y, on.foot.pose.y + l * along.x),
            forward: Vec2::new(along.x * cos - along.y * sin, along.y * cos + along.x * sin),
            kappa: offset.kappa,
            v,
            a,
            s: on.foot.s,
            l,
        });
    }
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
        let (foot, forward) = line.at_next(s, &mut place);
        let [l, dl, ddl, _] = lateral.at(s - from);
        let Some(offset) = Offset::new(foot.kappa, foot.dkappa, [l, dl, ddl]) else {
            break;
        };
        let theta = angle::wrap(foot.pose.theta + libm::atan2(offset.turn.1, offset.turn.0));
        let pose = Pose::new(foot.pose.x - l * forward.y, foot.pose.y + l * forward.x, theta);
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
