//! Curves and areas to points.

use super::super::fault::{Fault, Inside};
use super::super::messages::{Curve, Point, Polygon};
use corridor_decider::geometry::Vec2;

/// Farthest a point may be from the origin, m: the same as the road map allows.
const FARTHEST: f64 = 1e8;

/// A point with both coordinates.
pub(in super::super) fn point(point: &Point) -> Result<Vec2, Fault> {
    let coordinate = |value: Option<f64>, field| {
        match value {
            Some(value) if value.abs() <= FARTHEST => Ok(value),
            Some(value) => Err(Fault::new(format!("is {value}"), "at most 1e8 m from the origin")),
            None => Err(Fault::new("is missing", "a coordinate in metres")),
        }
        .inside(field)
    };
    Ok(Vec2::new(coordinate(point.x, "x")?, coordinate(point.y, "y")?))
}

/// The points of some messages.
fn points(messages: &[Point]) -> Result<Vec<Vec2>, Fault> {
    let each = |(nth, message)| point(message).inside_nth("point", nth);
    messages.iter().enumerate().map(each).collect()
}

/// The points of all segments of a curve; none where there is no curve.
pub(super) fn curve(curve: Option<&Curve>) -> Result<Vec<Vec2>, Fault> {
    let mut all = Vec::new();
    for (nth, segment) in curve.iter().flat_map(|curve| &curve.segment).enumerate() {
        let line = segment.line_segment.as_ref();
        let line = points(line.map_or(&[], |line| &line.point));
        all.extend(line.inside("line_segment").inside_nth("segment", nth)?);
    }
    Ok(all)
}

/// The polylines of some curves; those without points are left out.
pub(super) fn curves(messages: &[Curve], field: &'static str) -> Result<Vec<Vec<Vec2>>, Fault> {
    let each = |(nth, message)| curve(Some(message)).inside_nth(field, nth);
    let lines = messages.iter().enumerate().map(each);
    lines
        .filter(|line| !matches!(line, Ok(points) if points.is_empty()))
        .collect()
}

/// The corners of an area.
pub(super) fn polygon(polygon: Option<&Polygon>, field: &'static str) -> Result<Vec<Vec2>, Fault> {
    points(polygon.map_or(&[], |polygon| &polygon.point)).inside(field)
}
