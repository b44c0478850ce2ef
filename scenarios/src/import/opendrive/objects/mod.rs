//! What stands or lies on and beside the roads: `<object>` elements as outlines in the world.
//!
//! Source: ASAM OpenDRIVE, "Objects". Stations and lateral positions are the reference line's (no lane offset), heights
//! are dropped. An element that repeats gives one [`MapObject`] per copy, all of one name. Objects are no lanes and
//! no bodies: they say what the file knows.

mod kind;
mod place;
mod read;

pub use kind::ObjectKind;

use super::budget::Budget;
use super::record::Road;
use crate::import::ImportError;
use crate::import::notes::Notes;
use crate::import::xml::Element;
use corridor_decider::geometry::{ConvexPolygon, Pose};
use std::collections::BTreeMap;

/// Something on or beside a road.
#[derive(Clone, Debug, PartialEq)]
pub struct MapObject {
    /// `road_object` by the ids of the file; copies and parts of one element share it.
    pub name: String,
    /// What it is.
    pub kind: ObjectKind,
    /// The ground that it covers, in the world.
    pub outline: ConvexPolygon,
    /// Its own origin and heading.
    pub pose: Pose,
}

/// All objects in the order of the file. `roads` are those of `root`.
pub(super) fn objects(
    root: Element<'_>,
    roads: &[Road],
    budget: &mut Budget<'_>,
    notes: &mut Notes<'_>,
) -> Result<Vec<MapObject>, ImportError> {
    let by_id: BTreeMap<&str, &Road> = roads.iter().map(|road| (road.id.as_str(), road)).collect();
    let mut objects = Vec::new();
    for element in root.children("road") {
        let Some(road) = element.text("id").and_then(|id| by_id.get(id)) else {
            continue;
        };
        let elements = element.children("objects").flat_map(Element::elements);
        for child in elements {
            if child.name() != "object" {
                let what = "a reference, a tunnel or a bridge among the objects is not read";
                notes.add(what, child.place(), || format!("<{}>", child.name()));
                continue;
            }
            match read::object(child, notes) {
                Ok(record) => place::place(&record, road, &mut objects, budget, notes)?,
                // A thing beside the road is not worth the road.
                Err(error) => {
                    let what = "an object that cannot be read is left out";
                    notes.add(what, child.place(), || format!("road `{}`: {error}", road.id));
                }
            }
        }
    }
    Ok(objects)
}
