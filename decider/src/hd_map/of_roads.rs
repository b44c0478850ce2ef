//! The HD map of a road map: what the lane-follow map needs of lanes that came from another format.

use super::data::{BoundaryData, HdLaneKind, LaneData, MapData, RoadData, SectionData};
use super::map::{HdMap, HdMapError};
use crate::road::{Lane, LaneId, LaneKind, LanePoint, Mark, RoadMap};

impl HdMap {
    /// The same lanes under the same handles. Junctions, signs and overlaps are not carried over: nothing that follows
    /// a route asks for them.
    ///
    /// # Errors
    /// [`HdMapError`] when a lane cannot be an HD lane.
    pub fn of_roads(roads: &RoadMap) -> Result<Self, HdMapError> {
        let mut data = MapData {
            lanes: roads.lanes().iter().map(|lane| lane_data(roads, lane)).collect(),
            ..MapData::default()
        };
        for lane in roads.lanes() {
            match data.roads.iter_mut().find(|road| road.id == lane.road) {
                Some(road) => road.sections[0].lanes.push(lane.name.clone()),
                None => data.roads.push(RoadData {
                    id: lane.road.clone(),
                    sections: vec![SectionData {
                        id: "0".to_owned(),
                        lanes: vec![lane.name.clone()],
                        ..SectionData::default()
                    }],
                    ..RoadData::default()
                }),
            }
        }
        Self::new(data)
    }
}

fn lane_data(roads: &RoadMap, lane: &Lane) -> LaneData {
    let name = |id: &LaneId| roads.lane(*id).name.clone();
    let widths = |width: fn(&LanePoint) -> f64| lane.points.iter().map(|p| (p.s, width(p))).collect();
    let limit = lane.points.first().map(|first| first.speed_limit);
    LaneData {
        id: lane.name.clone(),
        points: lane.points.iter().map(|p| p.offset(0.0)).collect(),
        length: lane.length(),
        speed_limit: limit.filter(|limit| limit.is_finite()),
        kind: kind(lane.kind),
        left_boundary: boundary(&lane.left_marks),
        right_boundary: boundary(&lane.right_marks),
        predecessors: lane.predecessors.iter().map(name).collect(),
        successors: lane.successors.iter().map(name).collect(),
        neighbours: lane.neighbours.map(|id| id.iter().map(name).collect()),
        left_samples: widths(|p| p.left),
        right_samples: widths(|p| p.right),
        left_road_samples: widths(|p| p.road_left),
        right_road_samples: widths(|p| p.road_right),
        ..LaneData::default()
    }
}

fn boundary(marks: &[Mark]) -> BoundaryData {
    BoundaryData {
        types: marks.iter().map(|mark| (mark.s, vec![mark.kind])).collect(),
        ..BoundaryData::default()
    }
}

fn kind(kind: LaneKind) -> HdLaneKind {
    match kind {
        LaneKind::Driving | LaneKind::Ramp => HdLaneKind::CityDriving,
        LaneKind::Biking => HdLaneKind::Biking,
        LaneKind::Sidewalk => HdLaneKind::Sidewalk,
        LaneKind::Parking => HdLaneKind::Parking,
        LaneKind::Stop | LaneKind::Shoulder => HdLaneKind::Shoulder,
        _ => HdLaneKind::None,
    }
}
