//! What a decider may ask of a reference line.

use crate::geometry::Vec2;
use crate::reference_line::LinePoint;
use crate::road::{BoundaryType, Neighbour};
use crate::tasks::path_bounds::{Station, station};
use serde::{Deserialize, Serialize};

/// A place in the Frenet frame of a reference line, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SlPoint {
    /// Station along the line, counted from where it began.
    pub s: f64,
    /// Lateral offset, left positive.
    pub l: f64,
}

/// The questions of a decider to its reference line. Names and signs are the original's.
///
/// A query that returns `Option` may fail where the map has a hole; callers say what they assume then.
pub trait LineQuery {
    /// First station, m. A line that has been cut off behind the car goes on counting from where it once began.
    fn start(&self) -> f64 {
        0.0
    }

    /// Last station, m: the line's length where it begins at 0.
    fn length(&self) -> f64;

    /// Distances from the line to the (left, right) edges of the lane it follows.
    /// Fails outside `[0, length]`.
    fn lane_width(&self, s: f64) -> Option<(f64, f64)>;

    /// Distances from the line to the (left, right) edges of the road surface. Fails outside `[0, length]`.
    fn road_width(&self, s: f64) -> Option<(f64, f64)>;

    /// Lateral position of the line in the frame of the lane's centre line, left positive:
    /// `l_lane = l_line + offset`.
    fn offset_to_map(&self, s: f64) -> Option<f64>;

    /// Types of the (left, right) lane lines; `None` where the line follows no lane.
    fn boundary_types(&self, s: f64) -> Option<(BoundaryType, BoundaryType)>;

    /// Whole width of the adjacent lane of one kind, if there is one.
    fn neighbour_width(&self, neighbour: Neighbour, s: f64) -> Option<f64>;

    /// Whether a junction lies within `radius` metres of the line's point at `s`.
    fn near_junction(&self, s: f64, radius: f64) -> bool;

    /// Heading of the map lane nearest to `point`, if one lies near and runs roughly along `theta`.
    fn lane_heading(&self, point: Vec2, theta: f64) -> Option<f64>;

    /// Position, heading and curvature at `s`, clamped to the line.
    fn point(&self, s: f64) -> LinePoint;

    /// Frenet coordinates of a point. Beyond an end the end tangent goes on: `s < 0` or `s > length`.
    fn to_frenet(&self, point: Vec2) -> SlPoint;

    /// Frenet coordinates of a point whose station was about `s_hint` before: where the line comes past twice, those of
    /// the pass near the hint. Lines that know no faster way search all of it.
    fn to_frenet_near(&self, point: Vec2, s_hint: f64) -> SlPoint {
        let _ = s_hint;
        self.to_frenet(point)
    }

    /// Cross-sections at `from`, `from + step`, … while below `end`; stations add up one by one.
    fn sample(&self, from: f64, step: f64, end: f64, stations: &mut Vec<Station>) {
        let mut s = from;
        while s < end {
            stations.push(station(self, s));
            s += step;
        }
    }

    /// The point at `(s, l)`; `s` is clamped to the line.
    fn to_cartesian(&self, at: SlPoint) -> Vec2 {
        let point = self.point(at.s);
        let (sin, cos) = crate::geometry::angle::sin_cos(point.theta);
        Vec2::new(point.x - at.l * sin, point.y + at.l * cos)
    }
}
