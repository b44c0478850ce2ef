//! The way around static obstacles, chosen among all gaps between them.
//!
//! Obstacles beside a station leave gaps. A corridor is a chain of gaps, one per station, each touching the
//! next, from the ego's own side of whatever it is beside; the sides on which it passes the obstacles follow
//! from it. A forward dynamic program keeps the best chain into every gap: farthest first, then least lateral
//! motion, with a surcharge on passing an obstacle on another side than in the tick before. So a road that can
//! be passed is never taken for blocked, the answer does not depend on the order of the obstacles, and it does
//! not flip without a reason.

use super::bound::{BoundPoint, EdgeCause};
use super::edges::{Limit, narrow};
use super::input::{Input, ObstacleSl};
use super::obstacles::{Passage, Widening, is_in_scope};
use crate::frame::ObstacleId;
use crate::road::Side;

/// Surcharge for passing an obstacle on the other side than before, in metres of lateral motion: half a lane
/// width, so that only a clearly better way changes the mind.
const FLIP_COST: f64 = 1.75;

/// Weight of the distance from the line, per station: enough to prefer the near side of an obstacle,
/// too little to give up room.
const OFFSET_WEIGHT: f64 = 0.02;

/// A gap narrower than this is avoided where a wider one exists, m.
const COMFORTABLE_WIDTH: f64 = 0.4;

/// Weight of the width that is missing to a comfortable gap, per station.
const NARROW_WEIGHT: f64 = 0.2;

/// How near to its own place the ego keeps a relaxed limit, m.
const EGO_SLACK: f64 = 0.02;

/// A widened obstacle in terms of the rear axle: the interval of `l` that it forbids.
#[derive(Clone, Copy, Debug)]
struct Forbidden {
    id: ObstacleId,
    /// Near edge of the obstacle itself, m.
    start_s: f64,
    first: usize,
    past: usize,
    l_min: f64,
    l_max: f64,
    remembered: Option<Side>,
    /// The only side left to an ego that is beside it.
    only: Option<Side>,
}

impl Forbidden {
    /// On which side of it a gap lies whose right limit is `right`.
    fn side_of(&self, right: f64) -> Side {
        if self.l_max <= right {
            Side::Left
        } else {
            Side::Right
        }
    }
}

/// A free interval between two forbidden ones (or the bound's edges) and the best chain that leads into it.
#[derive(Clone, Copy, Debug)]
struct Gap {
    right: Limit,
    left: Limit,
    /// Cost of the best chain up to here.
    cost: f64,
    /// Where that chain runs.
    l: f64,
    /// Place of its predecessor among the gaps of the station before.
    parent: usize,
}

pub(super) fn limit(
    bound: &mut Vec<BoundPoint>,
    input: &Input,
    remembered: &[(ObstacleId, Side)],
    widening: Widening,
) -> Passage {
    let forbidden = forbidden_intervals(bound, input, remembered, widening);
    if forbidden.is_empty() {
        return Passage::default();
    }
    let mut passage = Passage::default();
    let mut layers: Vec<Gap> = Vec::with_capacity(2 * bound.len());
    let mut starts: Vec<usize> = Vec::with_capacity(bound.len() + 1);
    let mut active: Vec<Forbidden> = Vec::new();
    let mut next = 0;

    for (i, point) in bound.iter().enumerate() {
        let before = starts.last().copied().unwrap_or(0)..layers.len();
        starts.push(layers.len());
        active.retain(|obstacle| obstacle.past > i);
        while let Some(obstacle) = forbidden.get(next).filter(|obstacle| obstacle.first <= i) {
            let place = active.partition_point(|other| other.l_min <= obstacle.l_min);
            active.insert(place, *obstacle);
            next += 1;
        }
        open_gaps(point, &active, |right, left| {
            if let Some(gap) = best_entry(
                &layers[before.clone()],
                i == 0,
                input.ego.l,
                right,
                left,
                &active,
                i,
            ) {
                layers.push(gap);
            }
        });
        if starts[i] == layers.len() {
            passage.is_blocked = true;
            passage.blocked_by = if input.config.quirks.arbitrary_blocker {
                active.iter().map(|obstacle| obstacle.id).min()
            } else {
                closer(&active, &layers[before], point)
            }
            .filter(|id| *id != ObstacleId::ANONYMOUS);
            starts.pop();
            bound.truncate(i);
            break;
        }
    }
    carve(bound, &layers, &starts);
    passage.passed = sides(bound, &forbidden);
    passage
}

/// What each obstacle in scope forbids, by first station.
fn forbidden_intervals(
    bound: &[BoundPoint],
    input: &Input,
    remembered: &[(ObstacleId, Side)],
    widening: Widening,
) -> Vec<Forbidden> {
    let side_before = |id| remembered.iter().find(|(other, _)| *other == id);
    let mut all: Vec<Forbidden> = Vec::with_capacity(input.obstacles.len());
    for obstacle in input.obstacles {
        if is_in_scope(obstacle, input)
            && let Some(mut forbidden) = forbidden_by(obstacle, bound, input, widening)
        {
            forbidden.remembered = side_before(obstacle.id).map(|(_, side)| *side);
            all.push(forbidden);
        }
    }
    all.sort_by(|a, b| {
        a.first
            .cmp(&b.first)
            .then(a.l_min.total_cmp(&b.l_min))
            .then(a.id.cmp(&b.id))
    });
    all
}

/// What one obstacle forbids, if that is anything.
fn forbidden_by(
    obstacle: &ObstacleSl,
    bound: &[BoundPoint],
    input: &Input,
    widening: Widening,
) -> Option<Forbidden> {
    let config = input.config;
    let half_width = input.vehicle.half_width();
    let first = bound.partition_point(|p| p.s <= obstacle.start_s - config.obstacle_lon_start_buffer);
    let past = bound.partition_point(|p| p.s <= obstacle.end_s + config.obstacle_lon_end_buffer);
    // Beside the ego the buffer gives way rather than demand a jump, and the side is chosen.
    let is_beside = first == 0;
    let buffer = |room: f64| {
        let kept = if is_beside {
            room - half_width - EGO_SLACK
        } else {
            widening.lateral
        };
        kept.max(widening.hard.min(widening.lateral))
            .min(widening.lateral)
    };
    let right = obstacle.start_l.min(obstacle.end_l);
    let left = obstacle.start_l.max(obstacle.end_l);
    let (room_left, room_right) = (input.ego.l - left, right - input.ego.l);
    let only = match (room_left >= 0.0, room_right >= 0.0) {
        (true, _) => Some(Side::Left),
        (_, true) => Some(Side::Right),
        _ => None,
    };
    let l_min = right - half_width - buffer(room_right);
    let l_max = left + half_width + buffer(room_left);
    (first < past && l_min < l_max).then(|| Forbidden {
        id: obstacle.id,
        start_s: obstacle.start_s,
        first,
        past,
        l_min,
        l_max,
        remembered: None,
        only: only.filter(|_| is_beside),
    })
}

/// Calls `found` for each free interval of a station, from right to left. `active` is sorted by `l_min`.
fn open_gaps(point: &BoundPoint, active: &[Forbidden], mut found: impl FnMut(Limit, Limit)) {
    let mut right = Limit {
        l: point.l_min,
        cause: point.right,
    };
    for obstacle in active {
        let left = Limit {
            l: obstacle.l_min,
            cause: EdgeCause::Obstacle(obstacle.id),
        };
        let left = if left.l < point.l_max {
            left
        } else {
            Limit {
                l: point.l_max,
                cause: point.left,
            }
        };
        if right.l <= left.l {
            found(right, left);
        }
        if obstacle.l_max > right.l {
            right = Limit {
                l: obstacle.l_max,
                cause: EdgeCause::Obstacle(obstacle.id),
            };
        }
        if right.l > point.l_max {
            return;
        }
    }
    if right.l <= point.l_max {
        found(
            right,
            Limit {
                l: point.l_max,
                cause: point.left,
            },
        );
    }
}

/// The best chain into a gap from the station before, if any of its gaps touches it.
fn best_entry(
    before: &[Gap],
    is_first: bool,
    ego_l: f64,
    right: Limit,
    left: Limit,
    active: &[Forbidden],
    i: usize,
) -> Option<Gap> {
    let flips = flip_cost(right, left, active, i);
    let narrow = (COMFORTABLE_WIDTH - (left.l - right.l)).max(0.0) * NARROW_WEIGHT;
    let entered = |from: f64, cost: f64, parent: usize| {
        let l = from.clamp(right.l, left.l);
        let cost = cost + (l - from).abs() + OFFSET_WEIGHT * l.abs() + narrow + flips;
        Gap {
            right,
            left,
            cost,
            l,
            parent,
        }
    };
    if is_first {
        // The ego cannot jump across what it is beside.
        let jumps =
            |obstacle: &Forbidden| (obstacle.only).is_some_and(|only| only != obstacle.side_of(right.l));
        return (!active.iter().any(jumps)).then(|| entered(ego_l, 0.0, 0));
    }
    let touching = |gap: &Gap| gap.right.l <= left.l && right.l <= gap.left.l;
    before
        .iter()
        .enumerate()
        .filter(|(_, gap)| touching(gap))
        .map(|(parent, gap)| entered(gap.l, gap.cost, parent))
        .min_by(|a, b| a.cost.total_cmp(&b.cost).then(b.parent.cmp(&a.parent)))
}

/// Surcharges for the obstacles that begin at this station and would be passed on another side than before.
fn flip_cost(right: Limit, left: Limit, active: &[Forbidden], i: usize) -> f64 {
    let flips = active.iter().filter(|obstacle| {
        debug_assert!(obstacle.l_max <= right.l || obstacle.l_min >= left.l);
        let side = obstacle.side_of(right.l);
        obstacle.first == i && obstacle.remembered.is_some_and(|before| before != side)
    });
    flips.count() as f64 * FLIP_COST
}

/// The obstacle that closed the corridor, of those beside the first station that cannot be reached: one that
/// stands in a gap by which the station before can be left. Those all begin here, because a gap is clear of what
/// began before; the nearest in `s` is named, then the least id. Where nothing new stands in the way the road
/// itself closes a gap: then it is the obstacle begun last among those that stand between the bound's edges.
fn closer(active: &[Forbidden], before: &[Gap], point: &BoundPoint) -> Option<ObstacleId> {
    let stands_in =
        |obstacle: &Forbidden, right: f64, left: f64| obstacle.l_min < left && right < obstacle.l_max;
    let in_a_gap = |obstacle: &&Forbidden| {
        before
            .iter()
            .any(|gap| stands_in(obstacle, gap.right.l, gap.left.l))
    };
    let in_the_bound = |obstacle: &&Forbidden| stands_in(obstacle, point.l_min, point.l_max);
    let nearest = |a: &&Forbidden, b: &&Forbidden| a.start_s.total_cmp(&b.start_s).then(a.id.cmp(&b.id));
    let latest = |a: &&Forbidden, b: &&Forbidden| a.first.cmp(&b.first).then(nearest(b, a));
    active
        .iter()
        .filter(in_a_gap)
        .min_by(nearest)
        .or_else(|| active.iter().filter(in_the_bound).max_by(latest))
        .map(|obstacle| obstacle.id)
}

/// Narrows the bound to the best chain, walking back from its last station.
fn carve(bound: &mut [BoundPoint], layers: &[Gap], starts: &[usize]) {
    let Some(last) = starts.last() else { return };
    let final_gaps = &layers[*last..];
    let best = final_gaps
        .iter()
        .enumerate()
        .min_by(|a, b| a.1.cost.total_cmp(&b.1.cost).then(b.0.cmp(&a.0)));
    let mut place = best.map_or(0, |(place, _)| place);
    for (point, start) in bound.iter_mut().zip(starts).rev() {
        let gap = &layers[start + place];
        narrow(point, gap.right, gap.left);
        place = gap.parent;
    }
}

/// On which side of each obstacle the bound runs.
fn sides(bound: &[BoundPoint], forbidden: &[Forbidden]) -> Vec<(ObstacleId, Side)> {
    let side = |obstacle: &Forbidden| {
        let point = bound.get(obstacle.first)?;
        Some((obstacle.id, obstacle.side_of(point.l_min)))
    };
    forbidden.iter().filter_map(side).collect()
}
