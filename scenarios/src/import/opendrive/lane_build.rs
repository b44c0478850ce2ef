//! From cross-sections to lanes: centre lines with heading and curvature, half widths, road edges, speeds.
//!
//! A lane centre at lateral position `t(s)` beside a curve of curvature `kappa` has, in the curve's frame and per
//! metre of station, the tangent `(1 - kappa t, t')`; its curvature follows from the derivative of that.

use super::budget::Budget;
use super::cross_section::CrossSection;
use super::geometry::CurvePoint;
use super::limits::Limits;
use super::record::{Direction, LaneRecord, Road};
use crate::import::ImportError;
use corridor_decider::geometry::angle;
use corridor_decider::road::LanePoint;
use std::f64::consts::PI;

/// Points of a centre line are at least this far apart, m; nearer ones have no direction between them.
const LEAST_STEP: f64 = 1e-5;

/// Share of the reference line's length below which a lane counts as folded: it lies at or beyond the centre of
/// the bend, where its own tangent says nothing.
const FOLDED: f64 = 1e-3;

/// Curvature is cut off here, 1/m: a kink of a real file, not a bend.
const MAX_CURVATURE: f64 = 100.0;

/// How far before a station the speed limit is looked up on lanes that run against it, m.
const BEFORE: f64 = 1e-6;

/// A centre line in driving direction, and the road station of each of its points.
#[derive(Debug)]
pub(super) struct CentreLine {
    pub(super) points: Vec<LanePoint>,
    pub(super) road_s: Vec<f64>,
    /// Whether part of it lies beyond the centre of a bend.
    pub(super) folded: bool,
}

/// The centre line of the `lane`-th lane from the left, along the road's station or against it. `surface` are the road
/// edges per cross-section and lane.
pub(super) fn centre_line(
    road: &Road,
    (record, forward): (&LaneRecord, bool),
    lane: usize,
    cuts: &[CrossSection],
    surface: &[Vec<(f64, f64)>],
    budget: &mut Budget<'_>,
) -> Result<CentreLine, ImportError> {
    let limits = Limits::new(road, record, forward);
    let mut line = CentreLine {
        points: Vec::new(),
        road_s: Vec::new(),
        folded: false,
    };
    for step in 0..cuts.len() {
        let k = if forward { step } else { cuts.len() - 1 - step };
        let (cut, road_edges) = (&cuts[k], surface[k][lane]);
        let (mut point, folded) = lane_point(cut, lane, road_edges);
        line.folded |= folded;
        point.speed_limit = limits.at(if forward { cut.s } else { cut.s - BEFORE });
        if !forward {
            point = turned_round(point);
        }
        let reach = append(&mut line, point, cut.s, step + 1 == cuts.len());
        budget.stretch(reach, road)?;
    }
    Ok(line)
}

/// Whether traffic on a lane runs with the road's station; of a lane for both directions, the one of its side.
pub(super) fn runs_forward(road: &Road, lane: &LaneRecord) -> bool {
    ((lane.id < 0) != road.left_hand) != (lane.direction == Direction::Reversed)
}

/// The cross-section of one lane, along the road's station.
fn lane_point(cut: &CrossSection, lane: usize, road_edges: (f64, f64)) -> (LanePoint, bool) {
    let (left, right) = (cut.edges[lane], cut.edges[lane + 1]);
    let centre = [0, 1, 2].map(|k| 0.5 * (left[k] + right[k]));
    let half = 0.5 * (left[0] - right[0]);
    let (turn, kappa, folded) = tangent(&cut.base, centre);
    let (sin, cos) = angle::sin_cos(cut.base.theta);
    let point = LanePoint {
        s: 0.0,
        x: cut.base.x - centre[0] * sin,
        y: cut.base.y + centre[0] * cos,
        theta: angle::wrap(cut.base.theta + turn),
        kappa,
        left: half,
        right: half,
        road_left: road_edges.0 - centre[0],
        road_right: centre[0] - road_edges.1,
        speed_limit: f64::INFINITY,
    };
    (point, folded)
}

/// Heading against the reference line, and curvature, of a curve beside it at `t`, `t'`, `t''`.
fn tangent(base: &CurvePoint, [t, dt, ddt]: [f64; 3]) -> (f64, f64, bool) {
    // Arc length of the base per metre of station scales everything that the base turns.
    let turning = base.stretch * base.kappa;
    let along = base.stretch * (1.0 - base.kappa * t);
    if along < FOLDED * base.stretch {
        return (0.0, 0.0, true);
    }
    let along_change = -base.stretch * (base.dkappa * t + base.kappa * dt);
    let second = (along_change - turning * dt, ddt + turning * along);
    let speed = libm::hypot(along, dt);
    let kappa = (along * second.1 - dt * second.0) / (speed * speed * speed);
    (
        libm::atan2(dt, along),
        kappa.clamp(-MAX_CURVATURE, MAX_CURVATURE),
        false,
    )
}

/// The same cross-section seen by traffic that comes the other way.
fn turned_round(point: LanePoint) -> LanePoint {
    LanePoint {
        theta: angle::wrap(point.theta + PI),
        kappa: -point.kappa,
        left: point.right,
        right: point.left,
        road_left: point.road_right,
        road_right: point.road_left,
        ..point
    }
}

/// Adds a point at the station that its distance gives. The last point of a lane always stays.
///
/// Returns how far the new stretch reaches, m.
fn append(line: &mut CentreLine, mut point: LanePoint, road_s: f64, last: bool) -> f64 {
    let width = point.left + point.right;
    let Some(before) = line.points.last() else {
        line.points.push(point);
        line.road_s.push(road_s);
        return width;
    };
    let chord = libm::hypot(point.x - before.x, point.y - before.y);
    if chord < LEAST_STEP {
        if last && line.points.len() > 1 {
            point.s = before.s;
            line.points.pop();
            line.road_s.pop();
            line.points.push(point);
            line.road_s.push(road_s);
        }
        return width;
    }
    // Length of the arc over the chord.
    let turn = angle::difference(point.theta, before.theta);
    point.s = before.s + chord * (1.0 + turn * turn / 24.0);
    line.points.push(point);
    line.road_s.push(road_s);
    chord + width
}

#[cfg(test)]
mod tests {
    use super::super::geometry::{Parametric, Piece, Shape, Spiral};
    use super::*;
    use corridor_decider::geometry::{Pose, Vec2};

    /// A curve beside others, against differences of its positions.
    #[test]
    fn the_tangent_beside_a_curve_is_the_derivative_of_the_position() {
        let spiral = Shape::Spiral(Spiral::new(0.02, -0.05, 60.0).expect("is a spiral"));
        let cubic = Parametric::new([0.0, 1.0, 0.004, 0.0], [0.0, 0.1, 0.01, -1e-4], 60.0, 64.0);
        let cubic = Shape::Parametric(cubic.expect("is a cubic"));
        for shape in [Shape::Line, Shape::Arc { curvature: 0.04 }, spiral, cubic] {
            let piece = Piece {
                s: 0.0,
                length: 60.0,
                start: Pose::new(1.0, 2.0, 0.5),
                shape,
            };
            let beside = |s: f64| [3.0 + s * (0.2 - s * 0.01), 0.2 - 0.02 * s, -0.02];
            let position = |s: f64| {
                let base = piece.at(s);
                let (sin, cos) = angle::sin_cos(base.theta);
                Vec2::new(base.x, base.y) + Vec2::new(-sin, cos) * beside(s)[0]
            };
            let h = 1e-3;
            for s in (1..60).map(f64::from) {
                let (turn, kappa, folded) = tangent(&piece.at(s), beside(s));
                let (a, at, b) = (position(s - h), position(s), position(s + h));
                let first = (b - a) / (2.0 * h);
                let second = (a - at * 2.0 + b) / (h * h);
                let heading = libm::atan2(first.y, first.x);
                let speed = first.norm();
                let expected = (first.x * second.y - first.y * second.x) / (speed * speed * speed);
                let off = angle::difference(heading, piece.at(s).theta + turn).abs();
                assert!(off < 1e-6, "{:?} at {s}: heading off by {off}", piece.shape);
                assert!(
                    (kappa - expected).abs() < 1e-6,
                    "{:?} at {s}: {kappa} {expected}",
                    piece.shape
                );
                assert!(!folded);
            }
        }
    }
}
