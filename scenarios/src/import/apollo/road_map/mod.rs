//! From plain data to a [`RoadMap`]: the order of the steps.
//!
//! `curve` lays a smooth line through the points of a lane, `lane` cuts it into cross-sections with the widths that
//! the file gives, `topology` joins lanes, `surface` finds the edges of the road.

mod budget;
mod curve;
mod edges;
mod joints;
mod lane;
mod surface;
mod topology;
mod warnings;
mod widths;

use crate::import::ImportError;
use budget::Budget;
use corridor_decider::geometry::Vec2;
use corridor_decider::hd_map::{HdLaneKind, LaneData, MapData};
use corridor_decider::road::{Lane, LaneKind, RoadMap};
use curve::Knots;
use std::collections::BTreeMap;
use topology::Topology;
use warnings::Warnings;

/// Turns the data of an HD map into a road map, with what had to be left out or repaired on the way.
///
/// Lanes keep their names and their order, so a lane's [`corridor_decider::road::LaneId`] is its place in the data.
///
/// # Errors
/// [`ImportError`] when a lane cannot be drawn, nothing is drivable, or the map is too large.
pub fn to_road_map(map: &MapData) -> Result<(RoadMap, Vec<String>), ImportError> {
    map.lanes.iter().try_for_each(drawable)?;
    let mut warnings = Warnings::default();
    let mut budget = Budget::default();
    let topology = Topology::new(map, &mut warnings);
    let knots: Vec<Knots> = map.lanes.iter().map(|lane| Knots::new(&lane.points)).collect();
    let headings = joints::headings(&knots, &topology);
    let mut lanes: Vec<Lane> = Vec::with_capacity(map.lanes.len());
    for (number, (data, knots)) in map.lanes.iter().zip(&knots).enumerate() {
        let curve = knots.curve(headings[number]);
        lanes.push(lane::lane(
            data,
            kind(data.kind),
            &curve,
            &mut budget,
            &mut warnings,
        )?);
    }
    let junctions = topology.connect(map, &mut lanes, &mut warnings);
    roads(map, &mut lanes, &mut budget)?;
    Ok((RoadMap::new(lanes, junctions)?, warnings.into_lines()))
}

/// Tells the lanes which road they belong to, and how far its surface reaches.
fn roads(map: &MapData, lanes: &mut [Lane], budget: &mut Budget) -> Result<(), ImportError> {
    let places: BTreeMap<&str, usize> = map
        .lanes
        .iter()
        .enumerate()
        .map(|(k, l)| (l.id.as_str(), k))
        .collect();
    for road in &map.roads {
        for section in &road.sections {
            let members: Vec<usize> = section
                .lanes
                .iter()
                .filter_map(|name| places.get(name.as_str()).copied())
                .collect();
            for &member in &members {
                lanes[member].road.clone_from(&road.id);
            }
            surface::apply(lanes, &members, &section.edges, budget)?;
        }
    }
    surface::keep_off_others(lanes, map, &places);
    Ok(())
}

/// Refuses lanes without two different points. A file has none, but the data may come from elsewhere.
fn drawable(lane: &LaneData) -> Result<(), ImportError> {
    let finite = |point: &Vec2| point.x.is_finite() && point.y.is_finite();
    let moves = lane.points.windows(2).any(|pair| pair[0] != pair[1]);
    if moves && lane.points.iter().all(finite) {
        return Ok(());
    }
    Err(ImportError::Field {
        place: None,
        path: format!("lane `{}`", lane.id),
        problem: "has no centre line".to_owned(),
        expected: "at least two different finite points".to_owned(),
    })
}

/// What a lane is for, in the road map's classes.
fn kind(kind: HdLaneKind) -> LaneKind {
    match kind {
        HdLaneKind::None => LaneKind::Other,
        HdLaneKind::CityDriving | HdLaneKind::Shared => LaneKind::Driving,
        HdLaneKind::Biking => LaneKind::Biking,
        HdLaneKind::Sidewalk => LaneKind::Sidewalk,
        HdLaneKind::Parking => LaneKind::Parking,
        HdLaneKind::Shoulder => LaneKind::Shoulder,
    }
}
