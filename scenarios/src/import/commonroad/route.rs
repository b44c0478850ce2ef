//! The way from a place to a goal over successors and adjacent lanes: first the fewest changes of lane, then the
//! shortest.

use crate::route::joins;
use corridor_decider::road::{LaneId, Neighbour, RoadMap, Side};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

/// How far a vehicle's heading may be from its lane's, rad: less than a right angle, so that it points along it.
const ALONG: f64 = 1.5;

/// How far beside every lane a vehicle may start, m.
const BESIDE: f64 = 10.0;

/// A step of a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// The lane.
    pub(super) lane: LaneId,
    /// To which side it is entered from the lane before; `None`: straight ahead.
    pub(super) change: Option<Side>,
}

/// Lanes in which a vehicle at `pose` may be, each with its station there, the one along its heading first.
pub(super) fn lanes_of(map: &RoadMap, pose: corridor_decider::geometry::Pose) -> Vec<(LaneId, f64)> {
    use corridor_decider::geometry::angle::difference;
    let point = pose.position();
    let mut found: Vec<(LaneId, f64)> = map
        .lanes_at(point)
        .into_iter()
        .map(|(lane, theta)| (lane, difference(theta, pose.theta).abs()))
        .filter(|(_, turn)| *turn <= ALONG)
        .collect();
    found.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    let mut lanes: Vec<(LaneId, f64)> = found
        .into_iter()
        .map(|(lane, _)| (lane, station(map, lane, point)))
        .collect();
    if lanes.is_empty() {
        let nearest = |tolerance| map.nearest_lane(point, BESIDE, pose.theta, tolerance);
        let any = nearest(ALONG).or_else(|| nearest(std::f64::consts::PI));
        lanes.extend(any.map(|(lane, s, _)| (lane, s)));
    }
    lanes
}

/// Station of the cross-section of `lane` that is nearest to a point, m.
pub(super) fn station(map: &RoadMap, lane: LaneId, point: corridor_decider::geometry::Vec2) -> f64 {
    let distance = |p: &corridor_decider::road::LanePoint| libm::hypot(p.x - point.x, p.y - point.y);
    let nearest = map
        .lane(lane)
        .points
        .iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.map_or(0.0, |p| p.s)
}

/// Changes of lane, millimetres, and how early a start is listed: whole numbers are ordered without question.
type Cost = (u32, u64, usize);

/// The lane before, and to which side one leaves it.
type Before = Option<(LaneId, Option<Side>)>;

/// The best way from the end of one of `starts` to a lane that `is_goal`; the first lane of the way is the start.
pub(super) fn find(map: &RoadMap, starts: &[LaneId], is_goal: impl Fn(LaneId) -> bool) -> Option<Vec<Step>> {
    let mut open: BinaryHeap<Reverse<(Cost, LaneId)>> = BinaryHeap::new();
    let mut best: BTreeMap<LaneId, (Cost, Before)> = BTreeMap::new();
    for (place, lane) in starts.iter().enumerate() {
        let cost = (0, 0, place);
        best.entry(*lane).or_insert((cost, None));
        open.push(Reverse((cost, *lane)));
    }
    while let Some(Reverse((cost, lane))) = open.pop() {
        if best[&lane].0 != cost {
            continue;
        }
        if is_goal(lane) {
            return Some(trace_back(lane, |at| best[&at].1));
        }
        for (next, change) in steps(map, lane) {
            let cost = match change {
                Some(_) => (cost.0 + 1, cost.1, cost.2),
                None => (cost.0, cost.1 + millimetres(map.lane(next).length()), cost.2),
            };
            if best.get(&next).is_none_or(|(known, _)| cost < *known) {
                best.insert(next, (cost, Some((lane, change))));
                open.push(Reverse((cost, next)));
            }
        }
    }
    None
}

/// Where one can go on from a lane.
fn steps(map: &RoadMap, lane: LaneId) -> impl Iterator<Item = (LaneId, Option<Side>)> + '_ {
    let ahead = map.lane(lane).successors.iter().copied();
    let ahead = ahead
        .filter(move |next| joins(map, lane, *next))
        .map(|next| (next, None));
    let beside = [Side::Left, Side::Right].into_iter().filter_map(move |side| {
        let neighbour = map.neighbour(lane, Neighbour { side, reverse: false })?;
        Some((neighbour, Some(side)))
    });
    ahead
        .chain(beside)
        .filter(|(next, _)| map.lane(*next).kind.is_drivable())
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "lanes are of positive length, and shorter than the 1e16 m that fit"
)]
fn millimetres(length: f64) -> u64 {
    (length * 1000.0).round() as u64
}

fn trace_back(end: LaneId, before: impl Fn(LaneId) -> Before) -> Vec<Step> {
    let mut way = Vec::new();
    let mut lane = end;
    while let Some((previous, change)) = before(lane) {
        way.push(Step { lane, change });
        lane = previous;
    }
    way.push(Step { lane, change: None });
    way.reverse();
    way
}
