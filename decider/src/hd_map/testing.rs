//! Hand-made maps for tests.

use super::data::{BoundaryData, LaneData, MapData, Overlap, OverlapKind, OverlapObject};
use super::{HdMap, LaneSegment};
use crate::geometry::Vec2;
use crate::road::{BoundaryType, Neighbour, Side};
use std::sync::Arc;

/// Half width of every lane, m.
pub(crate) const HALF_WIDTH: f64 = 1.75;

/// A lane through points, 1.75 m to each side.
pub(crate) fn lane(id: &str, points: &[(f64, f64)]) -> LaneData {
    let edge = BoundaryData {
        types: vec![(0.0, vec![BoundaryType::DottedWhite])],
        ..BoundaryData::default()
    };
    LaneData {
        id: id.to_owned(),
        points: points.iter().map(|(x, y)| Vec2::new(*x, *y)).collect(),
        left_boundary: edge.clone(),
        right_boundary: edge,
        left_samples: vec![(0.0, HALF_WIDTH)],
        right_samples: vec![(0.0, HALF_WIDTH)],
        ..LaneData::default()
    }
}

/// Lets lane `from` lead to lane `to`.
pub(crate) fn connect(data: &mut MapData, from: &str, to: &str) {
    named(data, from).successors.push(to.to_owned());
    named(data, to).predecessors.push(from.to_owned());
}

/// Puts lane `left` on the left of lane `right`, both in the same direction.
pub(crate) fn adjoin(data: &mut MapData, left: &str, right: &str) {
    let on = |side| Neighbour { side, reverse: false }.index();
    named(data, left).neighbours[on(Side::Right)].push(right.to_owned());
    named(data, right).neighbours[on(Side::Left)].push(left.to_owned());
}

/// Lets an object lie on a lane from one station to another.
pub(crate) fn overlap(data: &mut MapData, lane: &str, object: &str, stations: (f64, f64)) {
    let id = format!("{object} on {lane}");
    let on = OverlapKind::Lane {
        start_s: stations.0,
        end_s: stations.1,
        is_merge: false,
    };
    let object = |id: &str, kind| OverlapObject {
        id: id.to_owned(),
        kind: Some(kind),
    };
    let objects = vec![
        object(lane, on),
        object(id.split(' ').next().unwrap(), OverlapKind::Crosswalk),
    ];
    named(data, lane).overlaps.push(id.clone());
    data.overlaps.push(Overlap { id, objects });
}

fn named<'a>(data: &'a mut MapData, id: &str) -> &'a mut LaneData {
    data.lanes.iter_mut().find(|lane| lane.id == id).unwrap()
}

/// Two lanes, `left` and `right`, 100 m from `x = 0`; each goes on for 100 m, as `left on` and `right on`. In front of
/// `right` lie `before`, 40 m, and `aside`, which comes in from below.
pub(crate) fn two_lanes() -> MapData {
    let mut data = MapData {
        lanes: vec![
            lane("aside", &[(-30.0, -30.0), (0.0, 0.0)]),
            lane("before", &[(-40.0, 0.0), (0.0, 0.0)]),
            lane("left", &[(0.0, 3.5), (100.0, 3.5)]),
            lane("right", &[(0.0, 0.0), (100.0, 0.0)]),
            lane("left on", &[(100.0, 3.5), (200.0, 3.5)]),
            lane("right on", &[(100.0, 0.0), (200.0, 0.0)]),
        ],
        ..MapData::default()
    };
    connect(&mut data, "aside", "right");
    connect(&mut data, "before", "right");
    connect(&mut data, "left", "left on");
    connect(&mut data, "right", "right on");
    adjoin(&mut data, "left", "right");
    adjoin(&mut data, "left on", "right on");
    data
}

pub(crate) fn map(data: MapData) -> Arc<HdMap> {
    Arc::new(HdMap::new(data).unwrap())
}

pub(crate) fn segment(map: &HdMap, lane: &str, start_s: f64, end_s: f64) -> LaneSegment {
    LaneSegment::new(map.find(lane).unwrap(), start_s, end_s)
}
