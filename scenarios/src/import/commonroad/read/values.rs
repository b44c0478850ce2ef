//! Numbers, intervals, points, shapes, positions and states: what all elements are made of.

use crate::import::ImportError;
use crate::import::commonroad::data::{Id, Interval, Position, Shape, State};
use crate::import::xml::{Element, shortened};
use corridor_decider::geometry::Vec2;

/// Largest number anywhere but in an id: beyond every projection's coordinates, and far from where adding loses
/// millimetres.
const LARGEST: f64 = 1e8;

/// The id in an attribute.
pub(super) fn id(element: Element<'_>, attribute: &str) -> Result<Id, ImportError> {
    let text = element.required_text(attribute)?;
    text.parse().map_err(|_| {
        let found = format!("has {attribute}=\"{}\"", shortened(text));
        element.error(found, "a whole number")
    })
}

/// Ids that the children of one name refer to.
pub(super) fn references(element: Element<'_>, child: &'static str) -> Result<Vec<Id>, ImportError> {
    element.children(child).map(|child| id(child, "ref")).collect()
}

/// The number inside an element.
pub(super) fn number(element: Element<'_>) -> Result<f64, ImportError> {
    let text = element.content().unwrap_or_default();
    match text.parse::<f64>() {
        Ok(number) if number.abs() <= LARGEST => Ok(number),
        _ => Err(element.error(
            format!("is `{}`", shortened(text)),
            format!("a number, at most {LARGEST:e} in size"),
        )),
    }
}

fn child_number(element: Element<'_>, child: &'static str) -> Result<f64, ImportError> {
    number(element.required_child(child)?)
}

fn size(element: Element<'_>, child: &'static str) -> Result<f64, ImportError> {
    let size = child_number(element, child)?;
    if size > 0.0 {
        return Ok(size);
    }
    let child = element.required_child(child)?;
    Err(child.error(format!("is `{size}`"), "a positive number of metres"))
}

/// A number, be it exact, an interval, or without either tag around it.
pub(super) fn interval(element: Element<'_>) -> Result<Interval, ImportError> {
    if let Some(exact) = element.child("exact") {
        return Ok(Interval::exact(number(exact)?));
    }
    if element.elements().next().is_none() {
        return Ok(Interval::exact(number(element)?));
    }
    let low = child_number(element, "intervalStart")?;
    let high = child_number(element, "intervalEnd")?;
    if low > high {
        let expected = "an intervalStart that is not above its intervalEnd";
        return Err(element.error(format!("goes from {low} to {high}"), expected));
    }
    Ok(Interval { low, high })
}

fn optional(element: Element<'_>, child: &'static str) -> Result<Option<Interval>, ImportError> {
    element.child(child).map(interval).transpose()
}

/// A point; a third coordinate is not looked at.
pub(super) fn point(element: Element<'_>) -> Result<Vec2, ImportError> {
    Ok(Vec2::new(
        child_number(element, "x")?,
        child_number(element, "y")?,
    ))
}

/// The points inside an element.
pub(super) fn points(element: Element<'_>) -> Result<Vec<Vec2>, ImportError> {
    element.children("point").map(point).collect()
}

/// The shapes inside an element; at least one.
pub(super) fn shapes(element: Element<'_>) -> Result<Vec<Shape>, ImportError> {
    let found: Vec<Shape> = element
        .elements()
        .filter_map(|child| shape(child).transpose())
        .collect::<Result<_, _>>()?;
    if found.is_empty() {
        return Err(element.error("has no shape inside", "a <rectangle>, <circle> or <polygon>"));
    }
    Ok(found)
}

fn shape(element: Element<'_>) -> Result<Option<Shape>, ImportError> {
    let center = || element.child("center").map_or(Ok(Vec2::zeros()), point);
    Ok(Some(match element.name() {
        "rectangle" => Shape::Rectangle {
            length: size(element, "length")?,
            width: size(element, "width")?,
            orientation: element.child("orientation").map_or(Ok(0.0), number)?,
            center: center()?,
        },
        "circle" => Shape::Circle {
            radius: size(element, "radius")?,
            center: center()?,
        },
        "polygon" => {
            let corners = points(element)?;
            if corners.len() < 3 {
                return Err(element.error(format!("has {} points", corners.len()), "three or more"));
            }
            Shape::Polygon(corners)
        }
        _ => return Ok(None),
    }))
}

fn position(element: Element<'_>) -> Result<Position, ImportError> {
    if let Some(found) = element.child("point") {
        return Ok(Position::Point(point(found)?));
    }
    let lanelets = references(element, "lanelet")?;
    if lanelets.is_empty() {
        return Ok(Position::Shapes(shapes(element)?));
    }
    Ok(Position::Lanelets(lanelets))
}

/// A state, its children in any order.
pub(super) fn state(element: Element<'_>) -> Result<State, ImportError> {
    Ok(State {
        position: element.child("position").map(position).transpose()?,
        orientation: optional(element, "orientation")?,
        time: interval(element.required_child("time")?)?,
        velocity: optional(element, "velocity")?,
        acceleration: optional(element, "acceleration")?,
        yaw_rate: optional(element, "yawRate")?,
        slip_angle: optional(element, "slipAngle")?,
    })
}
