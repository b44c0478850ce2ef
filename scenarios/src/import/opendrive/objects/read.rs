//! Reads one `<object>`: where it is, how large, its outlines and its copies. Numbers are checked, nothing is placed.

use super::ObjectKind;
use crate::import::ImportError;
use crate::import::notes::Notes;
use crate::import::xml::{Element, Place};
use corridor_decider::geometry::Vec2;

/// An `<object>`.
#[derive(Debug)]
pub(super) struct ObjectRecord {
    pub(super) id: String,
    pub(super) kind: ObjectKind,
    pub(super) place: Place,
    pub(super) s: f64,
    pub(super) t: f64,
    /// Heading against the road's, rad.
    pub(super) hdg: f64,
    pub(super) size: Size,
    /// Rule over the size.
    pub(super) outlines: Vec<Outline>,
    /// Rule over the position.
    pub(super) repeats: Vec<Repeat>,
}

/// What the file says of an object's extent, m.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Size {
    pub(super) length: Option<f64>,
    pub(super) width: Option<f64>,
    pub(super) radius: Option<f64>,
}

/// A ring or a chain of corners.
#[derive(Debug)]
pub(super) struct Outline {
    pub(super) corners: Corners,
    pub(super) closed: bool,
}

/// Corners of an outline.
#[derive(Debug)]
pub(super) enum Corners {
    /// In the object's frame.
    Local(Vec<Vec2>),
    /// By station and lateral position.
    Road(Vec<(f64, f64)>),
}

impl Corners {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Local(corners) => corners.len(),
            Self::Road(corners) => corners.len(),
        }
    }
}

/// Copies along the road; pairs are values at the start and at the end, m.
#[derive(Debug)]
pub(super) struct Repeat {
    pub(super) s: f64,
    pub(super) length: f64,
    /// Between copies; 0: one thing without gaps.
    pub(super) distance: f64,
    pub(super) t: (f64, f64),
    pub(super) lengths: Option<(f64, f64)>,
    pub(super) widths: Option<(f64, f64)>,
    pub(super) radii: Option<(f64, f64)>,
}

pub(super) fn object(element: Element<'_>, notes: &mut Notes<'_>) -> Result<ObjectRecord, ImportError> {
    let name = element.text("type").unwrap_or_default();
    let kind = ObjectKind::named(name);
    if kind == ObjectKind::Other {
        let what = "an object of a type that is not known is kept as it is";
        notes.add(what, element.place(), || format!("type=\"{name}\""));
    }
    let (s, t) = (element.number("s")?, element.number("t")?);
    let mut repeats = Vec::new();
    for child in element.children("repeat") {
        repeats.push(repeat(child, t)?);
    }
    let mut size = Size {
        length: size(element, "length")?,
        width: size(element, "width")?,
        radius: size(element, "radius")?,
    };
    if size.length.is_none() && size.radius.is_none() {
        size.length = self::size(element, "validLength")?;
    }
    Ok(ObjectRecord {
        id: element.text("id").unwrap_or_default().to_owned(),
        kind,
        place: element.place(),
        s,
        t,
        hdg: element.number_or("hdg", 0.0)?,
        size,
        outlines: outlines(element, notes)?,
        repeats,
    })
}

/// A positive number, `None` when there is none.
fn size(element: Element<'_>, attribute: &str) -> Result<Option<f64>, ImportError> {
    let value = element.number_or(attribute, 0.0)?;
    Ok((value > 0.0).then_some(value))
}

fn repeat(element: Element<'_>, t: f64) -> Result<Repeat, ImportError> {
    let pair = |start: &str, end: &str| -> Result<Option<(f64, f64)>, ImportError> {
        let first = size(element, start)?;
        let last = size(element, end)?;
        Ok(first.or(last).zip(last.or(first)))
    };
    let t_start = element.number_or("tStart", t)?;
    let repeat = Repeat {
        s: element.number("s")?,
        length: element.number("length")?,
        distance: element.number_or("distance", 0.0)?,
        t: (t_start, element.number_or("tEnd", t_start)?),
        lengths: pair("lengthStart", "lengthEnd")?,
        widths: pair("widthStart", "widthEnd")?,
        radii: pair("radiusStart", "radiusEnd")?,
    };
    if repeat.length < 0.0 || repeat.distance < 0.0 {
        return Err(element.error("has a negative length or distance", "0 or more"));
    }
    Ok(repeat)
}

/// The outlines, be they inside `<outlines>` (since 1.5) or not.
fn outlines(object: Element<'_>, notes: &mut Notes<'_>) -> Result<Vec<Outline>, ImportError> {
    let grouped = object
        .children("outlines")
        .flat_map(|group| group.children("outline"));
    let mut outlines = Vec::new();
    for element in object.children("outline").chain(grouped) {
        if element.text("outer") == Some("false") {
            let what = "a hole in an object is filled";
            notes.add(what, element.place(), || "<outline>".to_owned());
            continue;
        }
        let corners = corners(element)?;
        if corners.len() >= 2 {
            outlines.push(Outline {
                closed: corners.len() > 2 && element.text("closed") != Some("false"),
                corners,
            });
        }
    }
    Ok(outlines)
}

fn corners(outline: Element<'_>) -> Result<Corners, ImportError> {
    let mut road = Vec::new();
    for corner in outline.children("cornerRoad") {
        road.push((corner.number("s")?, corner.number("t")?));
    }
    if !road.is_empty() {
        return Ok(Corners::Road(road));
    }
    let mut local = Vec::new();
    for corner in outline.children("cornerLocal") {
        local.push(Vec2::new(corner.number("u")?, corner.number("v")?));
    }
    Ok(Corners::Local(local))
}
