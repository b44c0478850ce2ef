//! Outlines of CommonRoad as convex pieces and as areas of goals.

use super::data::Shape;
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle, cross};
use std::f64::consts::PI;

/// Corners of the polygon that stands for a circle. It lies around the circle, at most 0.9 % beyond it.
const CIRCLE_CORNERS: u32 = 24;

/// A convex polygon for a shape, and whether that is larger than the shape: the hull of one that is not convex.
/// `None`: it encloses nothing.
pub(super) fn convex(shape: &Shape) -> Option<(ConvexPolygon, bool)> {
    let corners = corners(shape);
    let is_larger = matches!(shape, Shape::Polygon(_)) && !is_convex(&corners);
    Some((ConvexPolygon::hull(&corners)?, is_larger))
}

/// Corners of a shape; for a circle those of a polygon around it.
pub(super) fn corners(shape: &Shape) -> Vec<Vec2> {
    match shape {
        Shape::Polygon(corners) => corners.clone(),
        Shape::Rectangle {
            length,
            width,
            orientation,
            center,
        } => {
            let pose = Pose::new(center.x, center.y, angle::wrap(*orientation));
            let rectangle = ConvexPolygon::rectangle(pose, length / 2.0, length / 2.0, width / 2.0);
            rectangle.vertices().to_vec()
        }
        Shape::Circle { radius, center } => {
            let turn = 2.0 * PI / f64::from(CIRCLE_CORNERS);
            let reach = radius / libm::cos(turn / 2.0);
            let corner = |k| {
                let (sin, cos) = angle::sin_cos(f64::from(k) * turn);
                center + Vec2::new(cos, sin) * reach
            };
            (0..CIRCLE_CORNERS).map(corner).collect()
        }
    }
}

/// Whether all corners turn the same way, once around.
fn is_convex(corners: &[Vec2]) -> bool {
    let next = |k: usize| corners[(k + 1) % corners.len()];
    let turn = |k: usize| {
        let (a, b, c) = (corners[k], next(k), next(k + 1));
        cross(b - a, c - b)
    };
    let turns: Vec<f64> = (0..corners.len())
        .map(turn)
        .filter(|turn| turn.abs() > 1e-9)
        .collect();
    let same_way = turns.iter().all(|turn| *turn > 0.0) || turns.iter().all(|turn| *turn < 0.0);
    same_way && !winds_twice(corners)
}

/// Whether a polygon that turns the same way everywhere goes around more than once, as a star does.
fn winds_twice(corners: &[Vec2]) -> bool {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let headings: Vec<f64> = edges
        .map(|(a, b)| b - a)
        .filter(|edge| edge.norm_squared() > 0.0)
        .map(|edge| libm::atan2(edge.y, edge.x))
        .collect();
    let turns = headings.iter().zip(headings.iter().cycle().skip(1));
    let all: f64 = turns.map(|(from, to)| angle::difference(*to, *from)).sum();
    all.abs() > 3.0 * PI
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(corners: &[(f64, f64)]) -> Shape {
        Shape::Polygon(corners.iter().map(|(x, y)| Vec2::new(*x, *y)).collect())
    }

    #[test]
    fn a_circle_is_covered_and_little_more() {
        let shape = Shape::Circle {
            radius: 2.0,
            center: Vec2::new(1.0, -1.0),
        };
        let (outline, is_larger) = convex(&shape).unwrap();
        assert!(!is_larger);
        for k in 0..100 {
            let (sin, cos) = angle::sin_cos(f64::from(k) * 0.0628);
            let rim = Vec2::new(1.0 + 2.0 * cos, -1.0 + 2.0 * sin);
            assert!(outline.distance_to_point(rim) < 1e-9, "the rim is inside");
        }
        assert!(outline.area() < PI * 4.0 * 1.01);
    }

    #[test]
    fn only_what_is_not_convex_becomes_larger() {
        let square = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        let turned: Vec<(f64, f64)> = square.iter().rev().copied().collect();
        let corner = [
            (0.0, 0.0),
            (4.0, 0.0),
            (4.0, 1.0),
            (1.0, 1.0),
            (1.0, 4.0),
            (0.0, 4.0),
        ];
        let star = [(0.0, 3.0), (1.8, -2.4), (-2.9, 0.9), (2.9, 0.9), (-1.8, -2.4)];
        for (corners, larger) in [
            (&square[..], false),
            (&turned, false),
            (&corner, true),
            (&star, true),
        ] {
            assert_eq!(convex(&polygon(corners)).unwrap().1, larger, "{corners:?}");
        }
        assert!(convex(&polygon(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)])).is_none());
    }

    #[test]
    fn a_rectangle_is_turned_and_moved() {
        let shape = Shape::Rectangle {
            length: 4.0,
            width: 2.0,
            orientation: PI / 2.0,
            center: Vec2::new(10.0, 0.0),
        };
        let (outline, _) = convex(&shape).unwrap();
        assert!(outline.contains(Vec2::new(10.9, 1.9)) && !outline.contains(Vec2::new(11.9, 0.9)));
    }
}
