//! What the map puts on its lanes, as standing obstacles. Copies of one object share its name and are numbered.

use super::Draft;
use super::placement::Spot;
use crate::import::opendrive::MapObject;
use crate::route::Road;
use crate::scenario::{Behaviour, Obstacle};
use corridor_decider::frame::{ObstacleId, ObstacleKind};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle};
use corridor_decider::reference_line::LineQuery;
use std::collections::BTreeMap;

/// Puts the objects of the road behind the obstacles of the file.
pub(super) fn place_all(draft: &mut Draft, road: &Road) {
    let mut copies: BTreeMap<&str, u32> = BTreeMap::new();
    for object in &road.objects {
        let Some((pose, shape)) = body(object) else {
            continue;
        };
        let copy = copies.entry(&object.name).or_default();
        *copy += 1;
        let name = match *copy {
            1 => format!("map object {}", object.name),
            copy => format!("map object {} #{copy}", object.name),
        };
        let at = road.line.to_frenet(pose.position());
        draft.spots.push(Spot {
            s: at.s,
            l: at.l,
            heading: angle::difference(pose.theta, road.line.point(at.s).theta),
        });
        draft.obstacles.push(Obstacle {
            id: ObstacleId(u32::try_from(draft.obstacles.len()).unwrap_or(u32::MAX)),
            name,
            kind: ObstacleKind::Other,
            shape,
            behaviour: Behaviour::Parked(pose),
        });
    }
}

/// The middle of an object, and its outline around that.
fn body(object: &MapObject) -> Option<(Pose, ConvexPolygon)> {
    let corners = object.outline.vertices();
    let middle = corners.iter().sum::<Vec2>() / (corners.len() as f64);
    let pose = Pose::new(middle.x, middle.y, object.pose.theta);
    let local: Vec<Vec2> = corners.iter().map(|corner| pose.to_local(*corner)).collect();
    Some((pose, ConvexPolygon::hull(&local)?))
}
