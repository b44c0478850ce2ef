//! Lanelets, signs, lights and intersections.

use super::values;
use crate::import::ImportError;
use crate::import::commonroad::data::{Adjacent, Bound, Intersection, Lanelet, Light, Sign};
use crate::import::notes::Notes;
use crate::import::xml::Element;
use std::collections::BTreeSet;

pub(super) fn lanelets(root: Element<'_>, notes: &mut Notes<'_>) -> Result<Vec<Lanelet>, ImportError> {
    let mut seen = BTreeSet::new();
    let mut lanelets = Vec::new();
    for element in root.children("lanelet") {
        let lanelet = lanelet(element, notes)?;
        if !seen.insert(lanelet.id) {
            return Err(element.error(format!("is the second of id `{}`", lanelet.id), "each id once"));
        }
        lanelets.push(lanelet);
    }
    if lanelets.is_empty() {
        return Err(root.error("has no <lanelet>", "at least one"));
    }
    Ok(lanelets)
}

fn lanelet(element: Element<'_>, notes: &mut Notes<'_>) -> Result<Lanelet, ImportError> {
    let id = values::id(element, "id")?;
    let bounds = [
        bound(element.required_child("leftBound")?)?,
        bound(element.required_child("rightBound")?)?,
    ];
    if bounds[0].points.len() != bounds[1].points.len() {
        notes.add(
            "has bounds of different numbers of points",
            element.place(),
            || format!("lanelet {id}"),
        );
    }
    let words = |names: [&'static str; 2]| {
        let named = names.into_iter().flat_map(|name| element.children(name));
        named.filter_map(Element::content).map(str::to_owned).collect()
    };
    Ok(Lanelet {
        id,
        bounds,
        predecessors: values::references(element, "predecessor")?,
        successors: values::references(element, "successor")?,
        adjacent: [
            adjacent(element, "adjacentLeft")?,
            adjacent(element, "adjacentRight")?,
        ],
        speed_limit: element.child("speedLimit").map(values::number).transpose()?,
        types: words(["laneletType", "type"]),
        users: words(["userOneWay", "userBidirectional"]),
        signs: values::references(element, "trafficSignRef")?,
        lights: values::references(element, "trafficLightRef")?,
        has_stop_line: element.child("stopLine").is_some(),
    })
}

fn bound(element: Element<'_>) -> Result<Bound, ImportError> {
    let points = values::points(element)?;
    if points.len() < 2 {
        return Err(element.error(format!("has {} points", points.len()), "two or more"));
    }
    let marking = element.child("lineMarking").and_then(Element::content);
    Ok(Bound {
        points,
        marking: marking.map(str::to_owned),
    })
}

fn adjacent(lanelet: Element<'_>, side: &'static str) -> Result<Option<Adjacent>, ImportError> {
    let Some(element) = lanelet.child(side) else {
        return Ok(None);
    };
    let same_direction = match element.required_text("drivingDir")? {
        "same" => true,
        "opposite" => false,
        other => return Err(element.error(format!("has drivingDir=\"{other}\""), "same or opposite")),
    };
    Ok(Some(Adjacent {
        id: values::id(element, "ref")?,
        same_direction,
    }))
}

/// All of a kind that can be read: a sign or a light is not worth the scene.
fn readable<T>(
    root: Element<'_>,
    name: &'static str,
    notes: &mut Notes<'_>,
    read: impl Fn(Element<'_>) -> Result<T, ImportError>,
) -> Vec<T> {
    let mut all = Vec::new();
    for element in root.children(name) {
        match read(element) {
            Ok(one) => all.push(one),
            Err(error) => {
                let what = "a sign or a light that cannot be read is left out";
                notes.add(what, element.place(), || error.to_string());
            }
        }
    }
    all
}

pub(super) fn signs(root: Element<'_>, notes: &mut Notes<'_>) -> Vec<Sign> {
    let text = |element: Element<'_>| element.content().unwrap_or_default().to_owned();
    let plate = |element: Element<'_>| {
        let number = element.child("trafficSignID").map(text).unwrap_or_default();
        (number, element.children("additionalValue").map(text).collect())
    };
    let sign = |element: Element<'_>| {
        Ok(Sign {
            id: values::id(element, "id")?,
            plates: element.children("trafficSignElement").map(plate).collect(),
        })
    };
    readable(root, "trafficSign", notes, sign)
}

pub(super) fn lights(root: Element<'_>, notes: &mut Notes<'_>) -> Vec<Light> {
    let phase = |element: Element<'_>| {
        let color = element.required_child("color")?.content().unwrap_or_default();
        let duration = values::number(element.required_child("duration")?)?;
        Ok((color.to_owned(), duration))
    };
    let light = |element: Element<'_>| {
        let cycle = element
            .child("cycle")
            .or_else(|| element.child("trafficLightCycle"));
        let phases = cycle.into_iter().flat_map(|cycle| cycle.children("cycleElement"));
        let offset = cycle.and_then(|cycle| cycle.child("timeOffset"));
        Ok(Light {
            id: values::id(element, "id")?,
            cycle: phases.map(phase).collect::<Result<_, ImportError>>()?,
            offset: offset.map_or(Ok(0.0), values::number)?,
            active: element.child("active").and_then(Element::content) != Some("false"),
        })
    };
    readable(root, "trafficLight", notes, light)
}

/// Names of the lists of lanelets that lead through: older files use the singular, newer ones another word.
const THROUGH: [&str; 9] = [
    "successorsRight",
    "successorsStraight",
    "successorsLeft",
    "successorRight",
    "successorStraight",
    "successorLeft",
    "outgoingRight",
    "outgoingStraight",
    "outgoingLeft",
];

pub(super) fn intersections(root: Element<'_>) -> Result<Vec<Intersection>, ImportError> {
    let intersection = |element: Element<'_>| {
        let (mut incoming, mut through) = (Vec::new(), Vec::new());
        for way in element.children("incoming") {
            incoming.extend(values::references(way, "incomingLanelet")?);
            for name in THROUGH {
                through.extend(values::references(way, name)?);
            }
        }
        Ok(Intersection {
            id: values::id(element, "id")?,
            incoming,
            through,
        })
    };
    root.children("intersection").map(intersection).collect()
}
