//! From lanelets to lanes: the order of the steps.

use super::Source;
use super::budget::Budget;
use super::centre::{Strip, strip};
use super::joints::{Links, end_poses};
use super::links::{links, neighbours};
use super::section::{Beside, lane_points};
use super::smooth::smooth;
use super::surface::far_bounds;
use crate::import::ImportError;
use corridor_decider::road::{
    BoundaryType, Junction, JunctionId, Lane, LaneId, LanePoint, Mark, RoadMap, Side,
};

/// A lane that is nowhere wider is left out, m.
const CLOSED: f64 = 1e-3;

/// The map of all lanelets.
pub(super) fn build(mut source: Source<'_, '_>, junctions: Vec<String>) -> Result<RoadMap, ImportError> {
    let mut budget = Budget::default();
    let mut strips = Vec::with_capacity(source.lanelets.len());
    for number in 0..source.lanelets.len() {
        let strip = strip(number, &mut budget, &mut source)?;
        if strip.is_none() {
            source.note("a lanelet without any length is left out", number);
        }
        strips.push(strip);
    }
    let links = links(&strips, &mut source);
    let neighbours = neighbours(&strips, &mut source);
    let points = all_points(&strips, &links, &neighbours, &mut budget, &mut source)?;
    let lanes = lanes(&source, points, &links, &neighbours, junctions.len());
    let junctions = junctions.into_iter().map(|name| Junction { name }).collect();
    Ok(RoadMap::new(lanes, junctions)?)
}

/// The cross-sections of every lanelet; none for those that are left out.
fn all_points(
    strips: &[Option<Strip>],
    links: &Links,
    neighbours: &[[Option<usize>; 4]],
    budget: &mut Budget,
    source: &mut Source<'_, '_>,
) -> Result<Vec<Vec<LanePoint>>, ImportError> {
    let poses = end_poses(strips, links);
    let mut all = Vec::with_capacity(strips.len());
    for (number, strip) in strips.iter().enumerate() {
        let (Some(strip), Some([start, end])) = (strip, poses[number]) else {
            all.push(Vec::new());
            continue;
        };
        let line = smooth(strip.centre.points(), start, end);
        let far = |side| far_bounds(source.lanelets, neighbours, number, side);
        let beside = Beside {
            left: far(Side::Left),
            right: far(Side::Right),
        };
        let mut points = lane_points(number, &line, &beside, strips, budget, source)?;
        if points.len() < 2 || points.iter().all(|p| p.left + p.right < CLOSED) {
            source.note("a lanelet without any width is left out", number);
            points.clear();
        }
        all.push(points);
    }
    Ok(all)
}

/// The lanes of all lanelets that have points.
fn lanes(
    source: &Source<'_, '_>,
    points: Vec<Vec<LanePoint>>,
    links: &Links,
    neighbours: &[[Option<usize>; 4]],
    junction_count: usize,
) -> Vec<Lane> {
    let mut kept = 0u32;
    let ids: Vec<Option<LaneId>> = points
        .iter()
        .map(|points| {
            let id = (!points.is_empty()).then_some(LaneId(kept));
            kept += u32::from(id.is_some());
            id
        })
        .collect();
    let drivable = |other: usize| source.lanelets[other].kind.is_drivable();
    let roads = roads(neighbours);
    let mut lanes = Vec::new();
    for (number, points) in points.into_iter().enumerate() {
        let lanelet = &source.lanelets[number];
        if points.is_empty() {
            continue;
        }
        let others = |list: &[usize]| list.iter().filter_map(|other| ids[*other]).collect();
        let beside = |other: Option<usize>| {
            let other = other.filter(|other| drivable(number) && drivable(*other))?;
            ids[other]
        };
        let junction = lanelet.junction.filter(|place| *place < junction_count);
        lanes.push(Lane {
            name: lanelet.name.clone(),
            kind: lanelet.kind,
            road: source.lanelets[roads[number]].name.clone(),
            junction: junction
                .and_then(|place| u32::try_from(place).ok())
                .map(JunctionId),
            points,
            left_marks: marks(lanelet.left_mark),
            right_marks: marks(lanelet.right_mark),
            neighbours: neighbours[number].map(beside),
            predecessors: others(&links.predecessors[number]),
            successors: others(&links.successors[number]),
        });
    }
    lanes
}

/// One line from the start to the end.
fn marks(kind: BoundaryType) -> Vec<Mark> {
    match kind {
        BoundaryType::Unknown => Vec::new(),
        kind => vec![Mark { s: 0.0, kind }],
    }
}

/// The road of every lanelet, named after the first of the lanelets side by side.
fn roads(neighbours: &[[Option<usize>; 4]]) -> Vec<usize> {
    let mut roads: Vec<Option<usize>> = vec![None; neighbours.len()];
    for first in 0..neighbours.len() {
        let mut pending = vec![first];
        while let Some(number) = pending.pop() {
            if roads[number].is_none() {
                roads[number] = Some(first);
                pending.extend(neighbours[number].iter().flatten());
            }
        }
    }
    roads
        .into_iter()
        .enumerate()
        .map(|(own, road)| road.unwrap_or(own))
        .collect()
}
