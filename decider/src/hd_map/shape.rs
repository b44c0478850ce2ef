//! Outlines of areas and lines across the road: how far away they are.

use super::aabb_tree::{Aabb, AabbTree};
use super::data::{Area, StopLines};
use crate::geometry::{ConvexPolygon, Vec2, cross};

/// Something drawn on the map.
#[derive(Clone, Debug)]
enum Shape {
    /// A closed outline and what it encloses.
    Area(Vec<Vec2>),
    /// Open lines.
    Lines(Vec<Vec<Vec2>>),
}

impl Shape {
    /// Distance from `point`, 0 inside an area; infinite for nothing.
    fn distance(&self, point: Vec2) -> f64 {
        match self {
            Self::Area(outline) if encloses(outline, point) => 0.0,
            Self::Area(outline) => edges(outline).fold(f64::INFINITY, |least, (a, b)| {
                least.min(distance_to_piece(point, a, b))
            }),
            Self::Lines(lines) => lines
                .iter()
                .flat_map(|line| line.windows(2))
                .fold(f64::INFINITY, |least, pair| {
                    least.min(distance_to_piece(point, pair[0], pair[1]))
                }),
        }
    }

    fn bounds(&self) -> Option<Aabb> {
        match self {
            Self::Area(outline) => Aabb::around(outline.iter().copied()),
            Self::Lines(lines) => Aabb::around(lines.iter().flatten().copied()),
        }
    }
}

/// Things of one kind, with an index of where they are.
#[derive(Clone, Debug, Default)]
pub(super) struct Layer {
    names: Vec<String>,
    shapes: Vec<Shape>,
    tree: AabbTree,
}

impl Layer {
    pub(super) fn of_areas(areas: &[Area]) -> Self {
        let things = areas.iter();
        Self::new(things.map(|area| (area.id.clone(), Shape::Area(area.polygon.clone()))))
    }

    pub(super) fn of_lines(signs: &[StopLines]) -> Self {
        let things = signs.iter();
        Self::new(things.map(|sign| (sign.id.clone(), Shape::Lines(sign.lines.clone()))))
    }

    /// Things without a point are nowhere and left out.
    fn new(things: impl Iterator<Item = (String, Shape)>) -> Self {
        let mut layer = Self::default();
        let mut boxes = Vec::new();
        for (name, shape) in things {
            if let Some(bounds) = shape.bounds() {
                layer.names.push(name);
                layer.shapes.push(shape);
                boxes.push(bounds);
            }
        }
        layer.tree = AabbTree::new(&boxes);
        layer
    }

    /// Names of everything at most `radius` away, in file order.
    pub(super) fn near(&self, point: Vec2, radius: f64) -> Vec<&str> {
        let candidates = self.tree.near(point, radius).into_iter();
        candidates
            .filter(|k| self.shapes[*k].distance(point) <= radius)
            .map(|k| self.names[k].as_str())
            .collect()
    }
}

fn edges(outline: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
    let next = outline.iter().cycle().skip(1);
    outline.iter().copied().zip(next.copied())
}

/// Whether a ray from `point` leaves the outline an odd number of times.
fn encloses(outline: &[Vec2], point: Vec2) -> bool {
    let crosses = |(a, b): &(Vec2, Vec2)| {
        (a.y > point.y) != (b.y > point.y) && {
            let aside = cross(b - a, point - a);
            if b.y > a.y { aside > 0.0 } else { aside < 0.0 }
        }
    };
    edges(outline).filter(crosses).count() % 2 == 1
}

/// Distance from `point` to the straight piece `a`–`b`, which may be a point.
fn distance_to_piece(point: Vec2, a: Vec2, b: Vec2) -> f64 {
    let chord = b - a;
    let along = (point - a).dot(&chord) / chord.norm_squared();
    let t = if along.is_nan() {
        0.0
    } else {
        along.clamp(0.0, 1.0)
    };
    (point - a - chord * t).norm()
}

/// Distance between a polygon and the straight piece `a`–`b`, 0 when they touch.
pub(super) fn polygon_to_piece(polygon: &ConvexPolygon, a: Vec2, b: Vec2) -> f64 {
    // Where they only touch, an end or a corner has distance 0.
    let crosses = |(c, d): (Vec2, Vec2)| {
        let parts = |p: Vec2, q: Vec2, u: Vec2, v: Vec2| cross(q - p, u - p) * cross(q - p, v - p) < 0.0;
        parts(a, b, c, d) && parts(c, d, a, b)
    };
    if polygon.edges().any(crosses) {
        return 0.0;
    }
    let ends = polygon.distance_to_point(a).min(polygon.distance_to_point(b));
    let corners = polygon
        .vertices()
        .iter()
        .map(|corner| distance_to_piece(*corner, a, b));
    corners.fold(ends, f64::min)
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "whole numbers on straight pieces are exact")]
mod tests {
    use super::*;
    use crate::geometry::Pose;

    fn points(corners: &[(f64, f64)]) -> Vec<Vec2> {
        corners.iter().map(|(x, y)| Vec2::new(*x, *y)).collect()
    }

    #[test]
    fn an_area_may_have_a_dent() {
        let outline = points(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 1.0), (0.0, 4.0)]);
        let area = Shape::Area(outline);
        let distance = |x, y| area.distance(Vec2::new(x, y));
        assert_eq!(distance(1.0, 1.0), 0.0);
        assert_eq!(distance(2.0, -3.0), 3.0);
        assert!(distance(2.0, 3.0) > 0.9, "the dent is outside");
    }

    #[test]
    fn lines_are_found_by_their_distance_and_nothing_is_nowhere() {
        let sign = |id: &str, line: &[(f64, f64)]| StopLines {
            id: id.to_owned(),
            lines: vec![points(line)],
            ..StopLines::default()
        };
        let layer = Layer::of_lines(&[
            sign("near", &[(0.0, 0.0), (2.0, 0.0)]),
            sign("far", &[(0.0, 9.0), (2.0, 9.0)]),
            sign("point", &[(1.0, 1.0), (1.0, 1.0)]),
            sign("empty", &[]),
        ]);
        assert_eq!(layer.near(Vec2::new(1.0, 3.0), 3.0), ["near", "point"]);
    }

    #[test]
    fn a_piece_may_cross_pass_or_lie_inside() {
        let square = ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 1.0, 1.0, 1.0);
        let distance = |a: (f64, f64), b: (f64, f64)| {
            polygon_to_piece(&square, Vec2::new(a.0, a.1), Vec2::new(b.0, b.1))
        };
        assert_eq!(distance((-3.0, 0.0), (3.0, 0.0)), 0.0);
        assert_eq!(distance((-0.1, 0.0), (0.1, 0.0)), 0.0);
        assert_eq!(distance((-3.0, 2.0), (3.0, 2.0)), 1.0);
        assert_eq!(distance((3.0, -5.0), (3.0, 0.0)), 2.0);
        assert_eq!(distance((2.0, 5.0), (2.0, 9.0)), 17.0_f64.sqrt());
    }
}
