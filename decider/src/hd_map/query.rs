//! What a planner asks of the map as a whole: the nearest lane, and everything within a radius.
//!
//! World frame, metres, radians. Lists come in file order. Source: the original's `hdmap_impl.cc`.

use super::{HdMap, ObjectKind};
use crate::geometry::{Vec2, angle};
use crate::road::LaneId;

/// A lane near a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearLane {
    /// The lane.
    pub lane: LaneId,
    /// Station of its nearest point, m.
    pub s: f64,
    /// Offset to the left of the straight line through its nearest piece, m: no distance, beyond an end.
    pub l: f64,
    /// Distance, m.
    pub distance: f64,
    /// Heading of its nearest piece, rad.
    pub heading: f64,
}

impl HdMap {
    /// The lane whose centre line is nearest to `point`; the first in the file of several. `None` only for a point
    /// that is no number.
    pub fn nearest_lane(&self, point: Vec2) -> Option<NearLane> {
        let distance = |k: usize| {
            let (lane, piece) = self.pieces[k];
            self.lane(lane).centre().distance_squared(piece, point)
        };
        let (nearest, _) = self.pieces_tree.nearest(point, distance)?;
        let (lane, piece) = self.pieces[nearest];
        Some(self.near_piece(lane, piece, point))
    }

    /// The nearest lane nearer than `radius` that runs within `tolerance` of `heading` where it is nearest.
    pub fn nearest_lane_with_heading(
        &self,
        point: Vec2,
        radius: f64,
        heading: f64,
        tolerance: f64,
    ) -> Option<NearLane> {
        let near = self.near_lanes(point, radius).into_iter();
        near.filter(|lane| agrees(lane, heading, tolerance) && lane.distance < radius)
            .min_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    /// Lanes at most `radius` away.
    pub fn lanes_within(&self, point: Vec2, radius: f64) -> Vec<LaneId> {
        let near = self.near_lanes(point, radius).into_iter();
        near.map(|near| near.lane).collect()
    }

    /// Lanes at most `radius` away that run within `tolerance` of `heading` where they are nearest.
    pub fn lanes_with_heading(&self, point: Vec2, radius: f64, heading: f64, tolerance: f64) -> Vec<LaneId> {
        let near = self.near_lanes(point, radius).into_iter();
        near.filter(|lane| agrees(lane, heading, tolerance))
            .map(|near| near.lane)
            .collect()
    }

    /// Names of the roads whose lanes are at most `radius` away, sorted.
    pub fn roads_within(&self, point: Vec2, radius: f64) -> Vec<&str> {
        let lanes = self.near_lanes(point, radius).into_iter();
        let roads = lanes.filter_map(|near| self.lane(near.lane).road());
        let mut names: Vec<&str> = roads.filter(|name| !name.is_empty()).collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    /// Names of the objects of one kind at most `radius` away: areas by their outline, signs by their stop lines,
    /// lanes by their centre lines. Inside an area the distance is 0.
    pub fn objects_within(&self, kind: ObjectKind, point: Vec2, radius: f64) -> Vec<&str> {
        if kind == ObjectKind::Lane {
            let lanes = self.lanes_within(point, radius).into_iter();
            return lanes.map(|lane| self.lane(lane).name()).collect();
        }
        self.layers[kind.index()].near(point, radius)
    }

    /// Lanes at most `radius` away, each with its nearest piece, by handle.
    fn near_lanes(&self, point: Vec2, radius: f64) -> Vec<NearLane> {
        let mut near: Vec<NearLane> = Vec::new();
        for place in self.pieces_tree.near(point, radius) {
            let (lane, piece) = self.pieces[place];
            let found = self.near_piece(lane, piece, point);
            if found.distance > radius {
                continue;
            }
            // Pieces come by lane, and within a lane from its start.
            match near.last_mut().filter(|last| last.lane == lane) {
                Some(last) if found.distance < last.distance => *last = found,
                Some(_) => {}
                None => near.push(found),
            }
        }
        near
    }

    fn near_piece(&self, id: LaneId, piece: usize, point: Vec2) -> NearLane {
        let lane = self.lane(id);
        let foot = lane.centre().foot_on(piece, point);
        NearLane {
            lane: id,
            s: foot.s,
            l: lane.centre().aside(piece, point),
            distance: foot.distance,
            heading: lane.headings()[piece],
        }
    }
}

fn agrees(lane: &NearLane, heading: f64, tolerance: f64) -> bool {
    angle::difference(lane.heading, heading).abs() <= tolerance
}
