//! The importer on small roads written for one question each.

mod directions;
mod header;
mod hostile;
mod junctions;
mod lanes;
mod links;
mod mirrored;
mod objects;
mod signals;

use super::{OpenDriveImport, read};
use corridor_decider::road::{Lane, RoadMap};

const STRAIGHT: &str = r#"<geometry s="0" x="0" y="0" hdg="0" length="100"><line/></geometry>"#;

/// A file around some roads and junctions.
fn file(body: &str) -> String {
    format!(r#"<?xml version="1.0"?><OpenDRIVE>{body}</OpenDRIVE>"#)
}

/// A road of 100 m along `+x`; `lanes` goes inside `<lanes>`.
fn straight(attributes: &str, link: &str, lanes: &str) -> String {
    road(attributes, link, STRAIGHT, lanes)
}

fn road(attributes: &str, link: &str, geometry: &str, lanes: &str) -> String {
    format!(
        "<road length=\"100\" {attributes}>{link}<planView>{geometry}</planView><lanes>{lanes}</lanes></road>"
    )
}

/// A section from lane elements left, on and right of lane 0.
fn section(s: f64, left: &str, centre: &str, right: &str) -> String {
    format!(
        r#"<laneSection s="{s}"><left>{left}</left>
        <center><lane id="0" type="driving">{centre}</lane></center><right>{right}</right></laneSection>"#
    )
}

/// A lane of constant width; `inside` goes into its element.
fn lane(id: i32, kind: &str, width: f64, inside: &str) -> String {
    format!(
        r#"<lane id="{id}" type="{kind}"><width sOffset="0" a="{width}" b="0" c="0" d="0"/>{inside}</lane>"#
    )
}

fn imported(body: &str) -> OpenDriveImport {
    read(&file(body)).unwrap_or_else(|error| panic!("{error}"))
}

fn named<'a>(map: &'a RoadMap, name: &str) -> &'a Lane {
    map.lane(map.find(name).unwrap_or_else(|| panic!("no lane `{name}`")))
}

/// Names of the lanes behind some handles.
fn successors<'a>(map: &'a RoadMap, name: &str) -> Vec<&'a str> {
    named(map, name)
        .successors
        .iter()
        .map(|id| map.lane(*id).name.as_str())
        .collect()
}
