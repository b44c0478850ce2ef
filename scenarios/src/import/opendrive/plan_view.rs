//! Reads `<planView>`: the pieces of the reference line.

use super::geometry::{Parametric, Piece, Shape, ShapeError, Spiral};
use crate::import::ImportError;
use crate::import::notes::Notes;
use crate::import::xml::Element;
use corridor_decider::geometry::Pose;

/// Pieces shorter than this are rounding dust of the program that wrote the file, m.
const DUST: f64 = 1e-3;

/// A longer road is an error of unit or of typing, m. It bounds time and memory.
const MAX_ROAD_LENGTH: f64 = 1e5;

/// Coordinates beyond this leave no millimetre in an f64 computation, m. UTM stays below 1e7.
const MAX_COORDINATE: f64 = 1e8;

/// Sharper bends than a radius of one centimetre are not roads, 1/m.
const MAX_CURVATURE: f64 = 100.0;

/// Joints that miss each other by more are told, m.
const NOTED_GAP: f64 = 0.01;

/// ... and by more than this make the road unusable, m: the distance within which lanes must meet.
const MAX_GAP: f64 = 0.5;

/// The road's length and its pieces by ascending station.
pub(super) fn read(road: Element<'_>, notes: &mut Notes<'_>) -> Result<(f64, Vec<Piece>), ImportError> {
    let length = checked_length(road)?;
    let view = road.required_child("planView")?;
    let mut pieces = Vec::new();
    for element in view.children("geometry") {
        if let Some(piece) = piece(element, notes)? {
            pieces.push(piece);
        }
    }
    pieces.sort_by(|a, b| a.s.total_cmp(&b.s));
    let Some(last) = pieces.last() else {
        // A road of dust: its sections are dust too and vanish.
        if length < DUST {
            return Ok((0.0, pieces));
        }
        return Err(view.error("has no <geometry> of a millimetre or more", "at least one"));
    };
    let end = last.end();
    if (end - length).abs() > NOTED_GAP {
        notes.add(
            "the geometry does not end at the road's length",
            road.place(),
            || subject(road),
        );
    }
    for pair in pieces.windows(2) {
        let (from, to) = (pair[0].at(pair[0].end()), pair[1].start);
        let gap = libm::hypot(to.x - from.x, to.y - from.y);
        if gap > MAX_GAP {
            let problem = format!(
                "has a reference line that jumps by {gap:.2} m at s = {:.2}",
                pair[1].s
            );
            return Err(view.error(problem, format!("pieces that meet within {MAX_GAP} m")));
        }
        if gap > NOTED_GAP {
            notes.add("a gap in the reference line", road.place(), || subject(road));
        }
    }
    Ok((length.min(end), pieces))
}

fn subject(road: Element<'_>) -> String {
    format!("road `{}`", road.text("id").unwrap_or_default())
}

/// A length that is a number, not negative and believable.
fn checked_length(element: Element<'_>) -> Result<f64, ImportError> {
    let length = element.number("length")?;
    if (0.0..=MAX_ROAD_LENGTH).contains(&length) {
        return Ok(length);
    }
    Err(element.error(
        format!("has length=\"{length}\""),
        format!("0 to {MAX_ROAD_LENGTH} m"),
    ))
}

fn coordinate(element: Element<'_>, attribute: &str) -> Result<f64, ImportError> {
    let value = element.number(attribute)?;
    if value.abs() <= MAX_COORDINATE {
        return Ok(value);
    }
    let problem = format!("has {attribute}=\"{value}\"");
    Err(element.error(problem, format!("at most {MAX_COORDINATE} m from the origin")))
}

fn curvature(element: Element<'_>, attribute: &str) -> Result<f64, ImportError> {
    let value = element.number(attribute)?;
    if value.abs() <= MAX_CURVATURE {
        return Ok(value);
    }
    let problem = format!("has {attribute}=\"{value}\"");
    Err(element.error(problem, format!("at most {MAX_CURVATURE} 1/m")))
}

/// One piece, `None` when it is dust.
fn piece(element: Element<'_>, notes: &mut Notes<'_>) -> Result<Option<Piece>, ImportError> {
    let length = checked_length(element)?;
    let s = coordinate(element, "s")?;
    let hdg = element.number("hdg")?;
    let start = Pose::new(coordinate(element, "x")?, coordinate(element, "y")?, hdg);
    if length < DUST {
        notes.add(
            "a piece of geometry shorter than 1 mm is skipped",
            element.place(),
            || format!("s = {s}"),
        );
        return Ok(None);
    }
    let shape = shape(element, length)?;
    Ok(Some(Piece {
        s,
        length,
        start,
        shape,
    }))
}

fn shape(element: Element<'_>, length: f64) -> Result<Shape, ImportError> {
    const KNOWN: [&str; 5] = ["line", "arc", "spiral", "poly3", "paramPoly3"];
    let Some(form) = element.elements().find(|child| KNOWN.contains(&child.name())) else {
        return Err(element.error(
            "has no form",
            "one of <line>, <arc>, <spiral>, <poly3>, <paramPoly3>",
        ));
    };
    let bad = |problem: ShapeError| form.error(problem.to_string(), "a curve of the given length");
    Ok(match form.name() {
        "line" => Shape::Line,
        "arc" => Shape::Arc {
            curvature: curvature(form, "curvature")?,
        },
        "spiral" => {
            let (start, end) = (curvature(form, "curvStart")?, curvature(form, "curvEnd")?);
            Shape::Spiral(Spiral::new(start, end, length).map_err(bad)?)
        }
        "poly3" => {
            let v = numbers(form, ["a", "b", "c", "d"])?;
            Shape::Parametric(Parametric::function(v, length).map_err(bad)?)
        }
        _ => {
            let u = numbers(form, ["aU", "bU", "cU", "dU"])?;
            let v = numbers(form, ["aV", "bV", "cV", "dV"])?;
            let end = match form.text("pRange") {
                Some("arcLength") => length,
                _ => 1.0,
            };
            Shape::Parametric(Parametric::new(u, v, end, length).map_err(bad)?)
        }
    })
}

fn numbers(element: Element<'_>, names: [&str; 4]) -> Result<[f64; 4], ImportError> {
    let mut values = [0.0; 4];
    for (value, name) in values.iter_mut().zip(names) {
        *value = element.number(name)?;
    }
    Ok(values)
}
