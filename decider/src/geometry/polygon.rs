//! Convex polygons: footprints of cars, obstacles and their swept copies.

use super::{Pose, Vec2, cross};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

/// A convex polygon, vertices counter-clockwise, at least three.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ConvexPolygon {
    #[serde(deserialize_with = "at_least_three")]
    vertices: Vec<Vec2>,
}

/// What a file calls a polygon must at least enclose something.
fn at_least_three<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Vec2>, D::Error> {
    let vertices = Vec::<Vec2>::deserialize(deserializer)?;
    if vertices.len() < 3 {
        let found = format!(
            "an outline of {} points; a polygon has three or more",
            vertices.len()
        );
        return Err(D::Error::custom(found));
    }
    Ok(vertices)
}

impl ConvexPolygon {
    /// The convex hull of `points`, or `None` when they span no area (or are not finite).
    ///
    /// Andrew's monotone chain; collinear points are dropped.
    pub fn hull(points: &[Vec2]) -> Option<Self> {
        if points.iter().any(|p| !(p.x.is_finite() && p.y.is_finite())) {
            return None;
        }
        let mut sorted = points.to_vec();
        sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        sorted.dedup();
        let mut vertices = half_hull(sorted.iter().copied());
        vertices.extend(half_hull(sorted.iter().rev().copied()));
        let polygon = Self { vertices };
        (polygon.vertices.len() >= 3 && polygon.area() > 1e-9).then_some(polygon)
    }

    /// A rectangle around `pose`: `front` metres ahead of it, `back` behind, `half_width` to each side.
    pub fn rectangle(pose: Pose, front: f64, back: f64, half_width: f64) -> Self {
        let forward = pose.forward();
        let left = Vec2::new(-forward.y, forward.x) * half_width;
        let (nose, tail) = (
            pose.position() + forward * front,
            pose.position() - forward * back,
        );
        Self {
            vertices: vec![tail - left, nose - left, nose + left, tail + left],
        }
    }

    /// The vertices, counter-clockwise.
    pub fn vertices(&self) -> &[Vec2] {
        &self.vertices
    }

    /// Enclosed area, m².
    pub fn area(&self) -> f64 {
        0.5 * self.edges().map(|(a, b)| cross(a, b)).sum::<f64>()
    }

    /// Edges as (from, to) pairs, counter-clockwise.
    pub fn edges(&self) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
        let next = self.vertices.iter().cycle().skip(1);
        self.vertices.iter().copied().zip(next.copied())
    }

    /// Whether `point` lies inside or on the edge.
    pub fn contains(&self, point: Vec2) -> bool {
        self.edges().all(|(a, b)| cross(b - a, point - a) >= 0.0)
    }

    /// Distance from `point` to this polygon, 0 inside.
    pub fn distance_to_point(&self, point: Vec2) -> f64 {
        if self.contains(point) {
            return 0.0;
        }
        self.edges()
            .map(|(a, b)| distance_to_segment(point, a, b))
            .fold(f64::MAX, f64::min)
    }

    /// This polygon, given in the frame of `pose`, in world coordinates.
    #[must_use]
    pub fn at(&self, pose: Pose) -> Self {
        Self {
            vertices: self.vertices.iter().map(|v| pose.to_world(*v)).collect(),
        }
    }

    /// Whether the interiors meet (separating-axis theorem). Touching polygons do not overlap.
    pub fn overlaps(&self, other: &Self) -> bool {
        !separates(self, other) && !separates(other, self)
    }

    /// Whether the segment between two points meets this polygon; touching counts.
    pub fn meets_segment(&self, from: Vec2, to: Vec2) -> bool {
        // The part of the segment on the inner side of every edge, as shares of its length.
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for (a, b) in self.edges() {
            let (at, per_share) = (cross(b - a, from - a), cross(b - a, to - from));
            if per_share == 0.0 {
                if at < 0.0 {
                    return false;
                }
            } else if per_share > 0.0 {
                enter = enter.max(-at / per_share);
            } else {
                leave = leave.min(-at / per_share);
            }
        }
        enter <= leave
    }

    /// Shortest distance to `other`, 0 when they overlap.
    pub fn distance(&self, other: &Self) -> f64 {
        if self.overlaps(other) {
            return 0.0;
        }
        let one_way = |from: &Self, to: &Self| {
            from.vertices
                .iter()
                .flat_map(|p| to.edges().map(move |(a, b)| distance_to_segment(*p, a, b)))
                .fold(f64::MAX, f64::min)
        };
        one_way(self, other).min(one_way(other, self))
    }
}

/// Distance from `point` to the segment `a`–`b`.
fn distance_to_segment(point: Vec2, a: Vec2, b: Vec2) -> f64 {
    let along = b - a;
    let length_squared = along.norm_squared();
    let t = if length_squared > 0.0 {
        ((point - a).dot(&along) / length_squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (point - a - along * t).norm()
}

/// Whether some edge of `a` has all of `b` on its outer side.
fn separates(a: &ConvexPolygon, b: &ConvexPolygon) -> bool {
    a.edges()
        .any(|(p, q)| b.vertices.iter().all(|v| cross(q - p, v - p) <= 0.0))
}

/// One chain of the hull over points in sorted order, without its last point.
fn half_hull(points: impl Iterator<Item = Vec2>) -> Vec<Vec2> {
    let mut chain: Vec<Vec2> = Vec::new();
    for point in points {
        while let [.., a, b] = chain[..] {
            if cross(b - a, point - b) > 0.0 {
                break;
            }
            chain.pop();
        }
        chain.push(point);
    }
    chain.pop();
    chain
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64) -> ConvexPolygon {
        ConvexPolygon::rectangle(Pose::new(x, y, 0.0), 0.5, 0.5, 0.5)
    }

    #[test]
    fn touching_is_not_overlapping_and_the_distance_is_exact() {
        assert!(!square(0.0, 0.0).overlaps(&square(1.0, 0.0)));
        assert!(square(0.0, 0.0).overlaps(&square(0.999, 0.999)));
        assert!((square(0.0, 0.0).distance(&square(4.0, 5.0)) - 5.0).abs() < 1e-12);
    }

    #[test]
    fn a_thin_pole_between_the_corners_overlaps() {
        let car = ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.3), 3.89, 1.043, 1.055);
        let pole = ConvexPolygon::rectangle(Pose::new(1.5, 0.4, 0.0), 0.1, 0.1, 0.1);
        assert!(car.overlaps(&pole) && pole.overlaps(&car));
    }

    #[test]
    fn a_segment_meets_what_it_ends_in_touches_or_passes_through() {
        let meets = |a: (f64, f64), b: (f64, f64)| {
            square(0.0, 0.0).meets_segment(Vec2::new(a.0, a.1), Vec2::new(b.0, b.1))
        };
        assert!(meets((0.0, 0.0), (5.0, 0.0)) && meets((0.1, 0.1), (0.2, 0.1)));
        assert!(meets((-5.0, 0.2), (5.0, 0.3)) && meets((-5.0, 0.5), (5.0, 0.5)));
        assert!(!meets((-5.0, 0.6), (5.0, 0.6)) && !meets((1.0, 0.0), (5.0, 0.0)));
        assert!(!meets((0.0, 1.2), (1.2, 0.0)), "past the corner");
    }

    #[test]
    fn the_hull_of_a_grid_is_its_border() {
        let points: Vec<Vec2> = (0..25)
            .map(|k| Vec2::new(f64::from(k % 5), f64::from(k / 5)))
            .collect();
        let hull = ConvexPolygon::hull(&points).unwrap();
        assert_eq!(hull.vertices().len(), 4);
        assert!((hull.area() - 16.0).abs() < 1e-12);
        assert!(ConvexPolygon::hull(&points[..5]).is_none(), "a line has no area");
    }
}
