//! Roads, their sections and their edges.

use super::super::fault::{Fault, Inside};
use super::super::messages::{BoundaryEdge, Road, RoadSection};
use super::curve::curve;
use super::{choice, names, optional_name};
use corridor_decider::hd_map::{EdgeData, EdgeKind, RoadData, RoadKind, SectionData};

const KINDS: [(i32, RoadKind); 4] = [
    (0, RoadKind::Unknown),
    (1, RoadKind::Highway),
    (2, RoadKind::CityRoad),
    (3, RoadKind::Park),
];
const EDGES: [(i32, EdgeKind); 4] = [
    (0, EdgeKind::Unknown),
    (1, EdgeKind::Normal),
    (2, EdgeKind::Left),
    (3, EdgeKind::Right),
];

/// A road. Sections without lanes are left out.
pub(in super::super) fn road(road: Road) -> Result<RoadData, Fault> {
    let mut sections = Vec::new();
    for (nth, section_message) in road.section.into_iter().enumerate() {
        let data = section(section_message).inside_nth("section", nth)?;
        if !data.lanes.is_empty() {
            sections.push(data);
        }
    }
    Ok(RoadData {
        id: optional_name(road.id).unwrap_or_default(),
        junction: optional_name(road.junction_id).unwrap_or_default(),
        kind: choice(road.r#type, &KINDS).inside("type")?,
        sections,
    })
}

/// Lanes side by side. Edges without points are left out.
fn section(section: RoadSection) -> Result<SectionData, Fault> {
    let outline = section.boundary.and_then(|boundary| boundary.outer_polygon);
    let mut edges = Vec::new();
    for (nth, message) in outline.iter().flat_map(|outline| &outline.edge).enumerate() {
        let data = edge(message).inside_nth("edge", nth);
        let data = data.inside("outer_polygon").inside("boundary")?;
        if !data.points.is_empty() {
            edges.push(data);
        }
    }
    Ok(SectionData {
        id: optional_name(section.id).unwrap_or_default(),
        lanes: names(section.lane_id, "lane_id")?,
        edges,
    })
}

fn edge(edge: &BoundaryEdge) -> Result<EdgeData, Fault> {
    Ok(EdgeData {
        points: curve(edge.curve.as_ref()).inside("curve")?,
        kind: choice(edge.r#type, &EDGES).inside("type")?,
    })
}
