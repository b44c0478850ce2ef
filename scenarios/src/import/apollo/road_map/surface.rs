//! The edges of the road's surface seen from each lane of a section.
//!
//! A section's outline has an edge on the left and one on the right of each carriageway, drawn in its driving
//! direction. Going outwards from a lane, an edge either ends the surface or begins another one; carriageways that
//! touch or overlap are one surface.

use super::budget::Budget;
use super::edges::crossing;
use crate::import::ImportError;
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::hd_map::{EdgeData, EdgeKind, MapData};
use corridor_decider::road::{Lane, LanePoint, Neighbour, Side};
use std::collections::BTreeMap;

/// Strips narrower than this between two carriageways belong to the surface, m.
const STEP_OVER: f64 = 1.0;

/// Edges farther from a lane are those of another place of a winding road, m.
const FARTHEST: f64 = 40.0;

/// How far the ends of an edge are drawn on, m: the line across a lane's first point may pass just before it.
const DRAWN_ON: f64 = 1.0;

/// An edge met on the way outwards.
#[derive(Clone, Copy, Debug)]
struct Met {
    /// How far out, m.
    distance: f64,
    /// Whether the surface ends here; else another one begins.
    ends: bool,
}

/// Takes the road edges of the lanes in `members` from the edges of their section. Lanes beside which no edge is
/// found keep what they have.
pub(super) fn apply(
    lanes: &mut [Lane],
    members: &[usize],
    edges: &[EdgeData],
    budget: &mut Budget,
) -> Result<(), ImportError> {
    let edges: Vec<(EdgeKind, Vec<Vec2>)> = edges
        .iter()
        .map(|edge| (edge.kind, drawn_on(&edge.points)))
        .collect();
    let pieces: usize = edges.iter().map(|(_, points)| points.len()).sum();
    for &member in members {
        let lane = &mut lanes[member];
        budget.comparisons(lane.points.len() * pieces, &lane.name)?;
        for side in [Side::Left, Side::Right] {
            let found: Vec<Option<f64>> = lane
                .points
                .iter()
                .map(|point| outermost(point, side, &edges))
                .collect();
            for (point, distance) in lane.points.iter_mut().zip(filled(&found)) {
                let (road, own) = match side {
                    Side::Left => (&mut point.road_left, point.left),
                    Side::Right => (&mut point.road_right, point.right),
                };
                *road = distance.map_or(*road, |distance| distance.max(own));
            }
        }
    }
    Ok(())
}

/// A polyline whose ends go on straight.
fn drawn_on(points: &[Vec2]) -> Vec<Vec2> {
    let beyond = |end: Vec2, inner: Vec2| {
        let along = end - inner;
        let length = along.norm();
        if length > 0.0 {
            end + along * (DRAWN_ON / length)
        } else {
            end
        }
    };
    let mut drawn = points.to_vec();
    if let [first, second, ..] = *points {
        drawn[0] = beyond(first, second);
        let last = points.len() - 1;
        drawn[last] = beyond(points[last], points[last - 1]);
    }
    drawn
}

/// How far the surface reaches from a point of a lane to one side, as far as the edges tell.
fn outermost(point: &LanePoint, side: Side, edges: &[(EdgeKind, Vec<Vec2>)]) -> Option<f64> {
    let (sin, cos) = angle::sin_cos(point.theta);
    let heading = Vec2::new(cos, sin);
    let mut met: Vec<Met> = edges
        .iter()
        .flat_map(|(kind, points)| points.windows(2).map(|pair| (*kind, pair[0], pair[1])))
        .filter_map(|piece| meet(Vec2::new(point.x, point.y), heading, side, piece))
        .collect();
    met.sort_by(|a, b| a.distance.total_cmp(&b.distance));
    // How many carriageways the way outwards is in.
    let (mut depth, mut reach) = (1, None);
    for edge in met {
        if reach.is_some_and(|reach| depth == 0 && edge.distance - reach > STEP_OVER) {
            break;
        }
        depth = if edge.ends { (depth - 1).max(0) } else { depth + 1 };
        if depth == 0 {
            reach = Some(edge.distance);
        }
    }
    reach
}

/// Where a piece of an edge is met on one side of a point, if it is.
fn meet(from: Vec2, heading: Vec2, side: Side, (kind, a, b): (EdgeKind, Vec2, Vec2)) -> Option<Met> {
    let distance = crossing(from, heading, a, b)? * side.sign();
    if !(0.0..=FARTHEST).contains(&distance) {
        return None;
    }
    let along = heading.dot(&(b - a)) >= 0.0;
    let ends = match kind {
        EdgeKind::Left => (side == Side::Left) == along,
        EdgeKind::Right => (side == Side::Right) == along,
        EdgeKind::Normal | EdgeKind::Unknown => true,
    };
    Some(Met { distance, ends })
}

/// Gaps filled with the nearest value.
fn filled(found: &[Option<f64>]) -> Vec<Option<f64>> {
    let mut filled = found.to_vec();
    let mut before = None;
    for value in &mut filled {
        before = value.or(before);
        *value = before;
    }
    let mut behind = None;
    for value in filled.iter_mut().rev() {
        behind = value.or(behind);
        *value = behind;
    }
    filled
}

/// Ends the surface at adjacent lanes that are not for cars, such as a bike lane inside the road's outline.
pub(super) fn keep_off_others(lanes: &mut [Lane], map: &MapData, places: &BTreeMap<&str, usize>) {
    for (number, data) in map.lanes.iter().enumerate() {
        if !lanes[number].kind.is_road_surface() {
            continue;
        }
        for beside in Neighbour::ALL {
            let mut others = data.neighbours[beside.index()]
                .iter()
                .filter_map(|name| places.get(name.as_str()));
            if others.all(|other| lanes[*other].kind.is_road_surface()) {
                continue;
            }
            for point in &mut lanes[number].points {
                match beside.side {
                    Side::Left => point.road_left = point.left,
                    Side::Right => point.road_right = point.right,
                }
            }
        }
    }
}
