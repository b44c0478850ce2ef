//! A chain of straight pieces: stations along it, and the Frenet frame that the original hangs on it.
//!
//! Plane, metres; `s` from the first point, `l` positive to the left. Source: the original's `LaneInfo::GetProjection`
//! and `Path::GetProjection`, which agree.

use super::aabb_tree::{Aabb, AabbTree};
use crate::geometry::{Vec2, cross};

/// Points nearer than this are one, m.
pub(super) const SAME_POINT: f64 = 1e-7;

/// Distance below which a point is a vertex, m; the original's general epsilon.
pub(super) const EPSILON: f64 = 1e-10;

/// At least two points, each apart from the one before.
#[derive(Clone, Debug)]
pub(crate) struct Polyline {
    points: Vec<Vec2>,
    /// Sums of chord lengths.
    stations: Vec<f64>,
    /// Unit vectors of the pieces.
    directions: Vec<Vec2>,
    pieces: AabbTree,
}

/// Where a point lies in the frame of a polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Station, m; below 0 or above the length beyond an end.
    pub s: f64,
    /// Offset to the left, m.
    pub l: f64,
    /// Distance from the polyline, m.
    pub distance: f64,
}

/// The point of a polyline that is nearest to some point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// The point.
    pub point: Vec2,
    /// Its station, m.
    pub s: f64,
    /// The piece it lies on; the first of several.
    pub piece: usize,
    /// Distance to it, m.
    pub distance: f64,
}

impl Polyline {
    /// `None` when fewer than two points are left of `points`, which must be apart and finite.
    pub(super) fn new(points: Vec<Vec2>) -> Option<Self> {
        if points.len() < 2 {
            return None;
        }
        let mut stations = vec![0.0];
        let mut directions = Vec::with_capacity(points.len() - 1);
        let mut boxes = Vec::with_capacity(points.len() - 1);
        let mut s = 0.0;
        for pair in points.windows(2) {
            let chord = pair[1] - pair[0];
            let length = length(chord);
            s += length;
            stations.push(s);
            directions.push(chord / length);
            boxes.extend(Aabb::around([pair[0], pair[1]]));
        }
        Some(Self {
            points,
            stations,
            directions,
            pieces: AabbTree::new(&boxes),
        })
    }

    pub(super) fn points(&self) -> &[Vec2] {
        &self.points
    }

    pub(super) fn stations(&self) -> &[f64] {
        &self.stations
    }

    pub(super) fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Heading of every point: that of the piece behind it; the last one repeats.
    pub(super) fn headings(&self) -> Vec<f64> {
        let heading = |d: &Vec2| libm::atan2(d.y, d.x);
        let last = self.directions.last().map(heading);
        self.directions.iter().map(heading).chain(last).collect()
    }

    /// The last vertex not beyond `s`, and how far `s` is behind it. Outside the polyline, one of its ends.
    pub(super) fn locate(&self, s: f64) -> (usize, f64) {
        if s >= self.length() {
            return (self.points.len() - 1, 0.0);
        }
        match self.stations.partition_point(|at| *at <= s) {
            0 => (0, 0.0),
            after => (after - 1, s - self.stations[after - 1]),
        }
    }

    /// The point at `s`, clamped to the polyline.
    pub(super) fn point_at(&self, s: f64) -> Vec2 {
        let (vertex, offset) = self.locate(s);
        match self.directions.get(vertex) {
            Some(direction) => self.points[vertex] + direction * offset,
            None => self.points[vertex],
        }
    }

    /// Frenet coordinates of `point`. On the ends the end piece goes on straight.
    pub(super) fn project(&self, point: Vec2) -> Projection {
        let nearest = self.pieces.nearest(point, |k| self.distance_squared(k, point));
        self.project_on(nearest.map_or(0, |(piece, _)| piece), point)
    }

    /// The same with only some pieces to choose from; the first where there are none.
    pub(super) fn project_within(&self, pieces: std::ops::Range<usize>, point: Vec2) -> Projection {
        let first = pieces.start.min(self.directions.len() - 1);
        let mut best = (first, f64::INFINITY);
        for piece in pieces.start..pieces.end.min(self.directions.len()) {
            let distance = self.distance_squared(piece, point);
            if distance < best.1 {
                best = (piece, distance);
            }
        }
        self.project_on(best.0, point)
    }

    fn project_on(&self, piece: usize, point: Vec2) -> Projection {
        let d = point - self.points[piece];
        let (along, aside) = self.in_frame(piece, d);
        let (start, length) = (self.stations[piece], self.piece_length(piece));
        let distance = self.distance_squared(piece, point).sqrt();
        // A point straight ahead counts as right, as in the original.
        let signed = if aside > 0.0 { distance } else { -distance };
        let last = piece + 1 == self.directions.len();
        let (s, l) = if piece == 0 {
            let l = if along < 0.0 { aside } else { signed };
            (along.min(length), l)
        } else if last {
            let l = if along > 0.0 { aside } else { signed };
            (start + along.max(0.0), l)
        } else {
            (start + along.clamp(0.0, length), signed)
        };
        Projection { s, l, distance }
    }

    /// The nearest point of the polyline.
    pub(super) fn foot(&self, point: Vec2) -> Foot {
        let nearest = self.pieces.nearest(point, |k| self.distance_squared(k, point));
        self.foot_on(nearest.map_or(0, |(piece, _)| piece), point)
    }

    /// The nearest point of one piece.
    pub(super) fn foot_on(&self, piece: usize, point: Vec2) -> Foot {
        let (along, _) = self.in_frame(piece, point - self.points[piece]);
        let along = along.clamp(0.0, self.piece_length(piece));
        Foot {
            point: self.points[piece] + self.directions[piece] * along,
            s: self.stations[piece] + along,
            piece,
            distance: self.distance_squared(piece, point).sqrt(),
        }
    }

    /// Offset to the left of the straight line through one piece.
    pub(super) fn aside(&self, piece: usize, point: Vec2) -> f64 {
        self.in_frame(piece, point - self.points[piece]).1
    }

    /// Squared distance from `point` to one piece.
    pub(super) fn distance_squared(&self, piece: usize, point: Vec2) -> f64 {
        let d = point - self.points[piece];
        let (along, aside) = self.in_frame(piece, d);
        if along <= 0.0 {
            d.norm_squared()
        } else if along >= self.piece_length(piece) {
            (point - self.points[piece + 1]).norm_squared()
        } else {
            aside * aside
        }
    }

    fn in_frame(&self, piece: usize, d: Vec2) -> (f64, f64) {
        let direction = self.directions[piece];
        (direction.dot(&d), cross(direction, d))
    }

    fn piece_length(&self, piece: usize) -> f64 {
        self.stations[piece + 1] - self.stations[piece]
    }
}

/// The length of a vector, to the last bit but for one case in thousands.
///
/// One Newton step takes the rounding of the root off: C. F. Borges, "An Improved Algorithm for hypot(a, b)", 2019.
/// The original's C library does the same, and stations that it wrote are found on the same side of a vertex here.
fn length(d: Vec2) -> f64 {
    let (a, b) = (d.x.abs().max(d.y.abs()), d.x.abs().min(d.y.abs()));
    let h = (a * a + b * b).sqrt();
    if h <= 0.0 {
        return h;
    }
    let excess = if h <= 2.0 * b {
        let delta = h - b;
        a * (2.0 * delta - a) + (delta - 2.0 * (a - b)) * delta
    } else {
        let delta = h - a;
        2.0 * delta * (a - 2.0 * b) + ((4.0 * delta - b) * b + delta * delta)
    };
    h - excess / (2.0 * h)
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "whole numbers on straight pieces are exact")]
mod tests {
    use super::*;

    fn hook() -> Polyline {
        let points = [(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (4.0, 5.0)];
        Polyline::new(points.map(|(x, y)| Vec2::new(x, y)).to_vec()).unwrap()
    }

    #[test]
    fn stations_go_on_beyond_both_ends_but_not_at_corners() {
        let hook = hook();
        let project = |x, y| {
            let at = hook.project(Vec2::new(x, y));
            (at.s, at.l)
        };
        assert_eq!(project(-3.0, 1.0), (-3.0, 1.0));
        assert_eq!(project(2.0, 8.0), (23.0, -3.0));
        assert_eq!(project(5.0, 1.0), (5.0, 1.0));
        // Outside the first corner both pieces are equally near, and the first one rules.
        assert_eq!(project(13.0, -4.0), (10.0, -5.0));
        assert_eq!(project(10.0, 0.0), (10.0, 0.0));
    }

    #[test]
    fn stations_find_their_points() {
        let hook = hook();
        assert_eq!(hook.locate(-1.0), (0, 0.0));
        assert_eq!(hook.locate(10.0), (1, 0.0));
        assert_eq!(hook.locate(12.0), (1, 2.0));
        assert_eq!(hook.locate(21.0), (3, 0.0));
        assert_eq!(hook.point_at(18.0), Vec2::new(7.0, 5.0));
        assert!(hook.project(Vec2::repeat(f64::NAN)).l.is_nan());
    }

    #[test]
    fn lengths_are_right_to_the_last_bit() {
        for (x, y, root) in [
            (3.0, 4.0, 5.0),
            (-5.0, 12.0, 13.0),
            (0.0, -7.0, 7.0),
            (20.0, 21.0, 29.0),
        ] {
            assert_eq!(length(Vec2::new(x, y)), root);
            assert_eq!(length(Vec2::new(x, y) / 1024.0), root / 1024.0);
        }
        assert_eq!(length(Vec2::zeros()), 0.0);
    }

    #[test]
    fn a_search_may_be_limited() {
        let hook = hook();
        let at = hook.project_within(0..1, Vec2::new(6.0, 4.5));
        assert_eq!((at.s, at.l, at.distance), (6.0, 4.5, 4.5));
        assert_eq!(hook.foot(Vec2::new(6.0, 4.5)).piece, 2);
    }
}
