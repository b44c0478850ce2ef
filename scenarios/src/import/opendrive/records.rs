//! Reads the root: roads and junctions.

use super::record::{Connection, End, JunctionRecord, Road, RoadLink, SpeedRecord};
use super::{lane_read, plan_view, signals};
use crate::import::ImportError;
use crate::import::notes::Notes;
use crate::import::xml::Element;
use std::collections::BTreeSet;

/// All roads that have a course and lanes, in the order of the file.
pub(super) fn roads(root: Element<'_>, notes: &mut Notes<'_>) -> Result<Vec<Road>, ImportError> {
    let mut seen = BTreeSet::new();
    let mut roads = Vec::new();
    let all_hollow = root.children("road").all(is_hollow);
    for element in root.children("road") {
        if is_hollow(element) && !all_hollow {
            let what = "a road without a course or without lanes is left out";
            notes.add(what, element.place(), || {
                format!("road `{}`", element.text("id").unwrap_or_default())
            });
            continue;
        }
        let road = road(element, notes)?;
        if !seen.insert(road.id.clone()) {
            return Err(element.error(format!("is the second of id `{}`", road.id), "each id once"));
        }
        roads.push(road);
    }
    if roads.is_empty() {
        return Err(root.error("has no <road>", "at least one"));
    }
    Ok(roads)
}

/// Whether there is nothing of a road but its name.
fn is_hollow(road: Element<'_>) -> bool {
    let lacks = |list: &'static str, item: &'static str| {
        road.child(list)
            .is_none_or(|list| list.children(item).next().is_none())
    };
    lacks("planView", "geometry") || lacks("lanes", "laneSection")
}

fn road(element: Element<'_>, notes: &mut Notes<'_>) -> Result<Road, ImportError> {
    let id = element.required_text("id")?.to_owned();
    let left_hand = match element.text("rule") {
        None | Some("RHT") => false,
        Some("LHT") => true,
        Some(rule) => return Err(element.error(format!("has rule=\"{rule}\""), "RHT or LHT")),
    };
    let (length, pieces) = plan_view::read(element, notes)?;
    let (offset, sections) = lane_read::read(element, notes)?;
    let links = element.child("link");
    let link = |name| {
        links
            .and_then(|links| links.child(name))
            .map_or(Ok(None), road_link)
    };
    Ok(Road {
        id,
        place: element.place(),
        length,
        left_hand,
        junction: element
            .text("junction")
            .filter(|id| *id != "-1")
            .map(str::to_owned),
        links: [link("predecessor")?, link("successor")?],
        speeds: road_speeds(element, notes)?,
        signs: signals::speed_signs(element, notes),
        pieces,
        offset,
        sections,
    })
}

fn road_link(element: Element<'_>) -> Result<Option<RoadLink>, ImportError> {
    let Some(id) = element.text("elementId") else {
        return Ok(None);
    };
    match element.text("elementType") {
        Some("junction") => Ok(Some(RoadLink::Junction(id.to_owned()))),
        Some("road") | None if element.text("elementS").is_some() => Ok(Some(RoadLink::Middle {
            id: id.to_owned(),
            s: element.number("elementS")?,
        })),
        Some("road") | None => Ok(Some(RoadLink::Road {
            id: id.to_owned(),
            contact: contact(element)?,
        })),
        Some(kind) => Err(element.error(format!("has elementType=\"{kind}\""), "road or junction")),
    }
}

fn contact(element: Element<'_>) -> Result<Option<End>, ImportError> {
    match element.text("contactPoint") {
        None => Ok(None),
        Some("start") => Ok(Some(End::Start)),
        Some("end") => Ok(Some(End::Finish)),
        Some(end) => Err(element.error(format!("has contactPoint=\"{end}\""), "start or end")),
    }
}

/// Limits by road type; a type without a speed has none.
fn road_speeds(road: Element<'_>, notes: &mut Notes<'_>) -> Result<Vec<SpeedRecord>, ImportError> {
    let mut records = Vec::new();
    for kind in road.children("type") {
        let limit = match kind.child("speed") {
            Some(element) => lane_read::speed(element, notes)?,
            None => None,
        };
        records.push(SpeedRecord {
            s: kind.number_or("s", 0.0)?,
            limit: limit.unwrap_or(f64::INFINITY),
        });
    }
    records.sort_by(|a, b| a.s.total_cmp(&b.s));
    Ok(records)
}

/// All junctions, in the order of the file.
pub(super) fn junctions(
    root: Element<'_>,
    notes: &mut Notes<'_>,
) -> Result<Vec<JunctionRecord>, ImportError> {
    let mut seen = BTreeSet::new();
    let mut junctions = Vec::new();
    for element in root.children("junction") {
        let id = element.required_text("id")?.to_owned();
        if !seen.insert(id.clone()) {
            return Err(element.error(format!("is the second of id `{id}`"), "each id once"));
        }
        let mut connections = Vec::new();
        for child in element.children("connection") {
            match connection(child)? {
                Some(connection) => connections.push(connection),
                None => notes.add(
                    "a junction's connection that names no roads is ignored",
                    child.place(),
                    || format!("junction `{id}`"),
                ),
            }
        }
        junctions.push(JunctionRecord { id, connections });
    }
    Ok(junctions)
}

fn connection(element: Element<'_>) -> Result<Option<Connection>, ImportError> {
    // Direct junctions have no road inside: they name the road that goes on.
    let through = element
        .text("connectingRoad")
        .or_else(|| element.text("linkedRoad"));
    let (Some(incoming), Some(connecting)) = (element.text("incomingRoad"), through) else {
        return Ok(None);
    };
    let mut lanes = Vec::new();
    for link in element.children("laneLink") {
        lanes.push((link.integer("from")?, link.integer("to")?));
    }
    Ok(Some(Connection {
        place: element.place(),
        incoming: incoming.to_owned(),
        connecting: connecting.to_owned(),
        contact: contact(element)?,
        lanes,
    }))
}
