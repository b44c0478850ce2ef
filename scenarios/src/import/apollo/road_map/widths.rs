//! Half widths of a lane along its curve: from the file's samples, else from the lane's edges.

use super::curve::CurvePoint;
use super::edges::crossing;
use super::warnings::Warnings;
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::hd_map::LaneData;
use corridor_decider::road::Side;

/// Half width of a lane of which nothing is known, m: half a lane of 3.5 m.
const DEFAULT: f64 = 1.75;

/// Farther off than this an edge is not the lane's own, m.
const FARTHEST: f64 = 20.0;

/// Where the widths of a lane come from.
pub(super) struct Widths<'a> {
    left: Source<'a>,
    right: Source<'a>,
}

enum Source<'a> {
    Samples(&'a [(f64, f64)]),
    Edge(&'a [Vec2]),
    Unknown,
}

impl<'a> Widths<'a> {
    pub(super) fn new(lane: &'a LaneData, warnings: &mut Warnings) -> Self {
        let mut source = |samples: &'a [(f64, f64)], edge: &'a [Vec2]| {
            if !samples.is_empty() {
                return Source::Samples(samples);
            }
            let (what, source) = if edge.len() < 2 {
                ("no widths and no edge; 1.75 m are assumed", Source::Unknown)
            } else {
                ("no widths; they are measured to the edge", Source::Edge(edge))
            };
            warnings.add(what, || format!("lane `{}`", lane.id));
            source
        };
        Self {
            left: source(&lane.left_samples, &lane.left_boundary.points),
            right: source(&lane.right_samples, &lane.right_boundary.points),
        }
    }

    /// From a place on the curve to the lane's edge, m.
    pub(super) fn to_edge(&self, side: Side, at: &CurvePoint) -> f64 {
        let source = match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        };
        match source {
            Source::Samples(samples) => linear(samples, at.station).unwrap_or(DEFAULT),
            Source::Edge(edge) => {
                let (sin, cos) = angle::sin_cos(at.theta);
                let heading = Vec2::new(cos, sin);
                let offsets = edge
                    .windows(2)
                    .filter_map(|pair| crossing(at.position, heading, pair[0], pair[1]));
                let ahead = offsets.map(|l| l * side.sign()).filter(|l| *l >= 0.0);
                let nearest = ahead.fold(f64::INFINITY, f64::min);
                let nearest = if nearest.is_finite() {
                    nearest
                } else {
                    nearest_point(edge, at.position)
                };
                nearest.min(FARTHEST)
            }
            Source::Unknown => DEFAULT,
        }
    }

    /// How many pieces of edge one place is held against.
    pub(super) fn comparisons(&self) -> usize {
        let count = |source: &Source<'_>| match source {
            Source::Edge(edge) => edge.len(),
            _ => 1,
        };
        count(&self.left) + count(&self.right)
    }
}

/// The value at a station between samples; the first and the last hold beyond the ends.
pub(super) fn linear(samples: &[(f64, f64)], s: f64) -> Option<f64> {
    let above = samples.partition_point(|(at, _)| *at <= s);
    let Some(&(s1, w1)) = samples.get(above) else {
        return samples.last().map(|(_, width)| *width);
    };
    let Some(&(s0, w0)) = above.checked_sub(1).and_then(|below| samples.get(below)) else {
        return Some(w1);
    };
    Some(w0 + (w1 - w0) * ((s - s0) / (s1 - s0)))
}

/// Distance to the nearest point of an edge whose ends were passed.
fn nearest_point(edge: &[Vec2], from: Vec2) -> f64 {
    edge.iter()
        .map(|point| (point - from).norm())
        .fold(f64::INFINITY, f64::min)
}
