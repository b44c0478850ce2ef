//! The way around static obstacles, chosen among all gaps between them.
//!
//! Obstacles beside a station leave gaps. A corridor is a chain of gaps, one per station, each touching the
//! next, from the ego's own side of whatever it is beside; the sides on which it passes the obstacles follow
//! from it. A forward dynamic program keeps the best chain into every gap: farthest first, then least lateral
//! motion, with a surcharge on passing an obstacle on another side than in the tick before. So a road that can
//! be passed is never taken for blocked, the answer does not depend on the order of the obstacles, and it does
//! not flip without a reason.
//!
//! Where neither the obstacles nor the edges of the bound change, one gap stands for many stations.

use super::bound::{BoundPoint, EdgeCause};
use super::edges::{Limit, narrow};
use super::forbidden::{Active, Forbidden};
use super::input::Input;
use super::obstacles::Passage;
use crate::frame::ObstacleId;
use crate::road::Side;
use std::ops::Range;

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

/// A way from the ego through one gap per slab.
#[derive(Clone, Copy, Debug)]
struct Chain {
    cost: f64,
    /// Where it runs in its last gap.
    l: f64,
    /// The gap before the last one, by its place among all gaps.
    parent: usize,
}

/// A free interval between two forbidden ones (or the bound's edges) and the best chain that leads into it.
#[derive(Clone, Copy, Debug)]
struct Gap {
    right: Limit,
    left: Limit,
    chain: Chain,
}

/// Stations in a row with the same gaps: no obstacle begins or ends between them and the bound keeps its edges.
#[derive(Clone, Copy, Debug)]
struct Slab {
    /// Its first station.
    first: usize,
    /// Place of its rightmost gap among all gaps.
    gaps: usize,
}

pub(super) fn limit(bound: &mut Vec<BoundPoint>, input: &Input, forbidden: &[Forbidden]) -> Passage {
    let reached = forbidden.partition_point(|obstacle| obstacle.first < bound.len());
    let forbidden = &forbidden[..reached];
    let mut passage = Passage::default();
    if forbidden.is_empty() {
        return passage;
    }
    let mut slabs: Vec<Slab> = Vec::with_capacity(2 * forbidden.len());
    let mut gaps: Vec<Gap> = Vec::with_capacity(4 * forbidden.len());
    let mut active = Active::of(forbidden, bound);
    let mut first = 0;

    while first < bound.len() {
        active.move_to(first);
        let past = first + count_alike(&bound[first..active.next_change.min(bound.len())]);
        let start = gaps.len();
        let before = slabs.last().map_or(0, |slab| slab.gaps)..start;
        let mut entry = Entry {
            from: (first > 0).then(|| before.clone()),
            ego_l: input.ego.l,
            stations: (past - first) as f64,
            active: &active,
        };
        open_gaps(&bound[first], &active.beside, |right, left| {
            if let Some(chain) = entry.best(&gaps, right.l, left.l) {
                gaps.push(Gap { right, left, chain });
            }
        });
        if gaps.len() == start {
            passage.is_blocked = true;
            let blocker = if input.config.quirks.arbitrary_blocker {
                active.beside.iter().map(|obstacle| obstacle.id).min()
            } else {
                closer(&active.beside, &gaps[before], &bound[first])
            };
            passage.blocked_by = blocker.filter(|id| *id != ObstacleId::ANONYMOUS);
            bound.truncate(first);
            break;
        }
        slabs.push(Slab { first, gaps: start });
        first = past;
    }
    carve(&mut bound[..first], &gaps, &slabs);
    passage.passed = sides(bound, forbidden);
    passage
}

/// How many points have the edges of the first one. Where only the causes differ, gaps do not.
fn count_alike(points: &[BoundPoint]) -> usize {
    let edges = |p: &BoundPoint| (p.l_min.to_bits(), p.l_max.to_bits());
    let first = edges(&points[0]);
    points.iter().take_while(|p| edges(p) == first).count()
}

/// Calls `found` for each free interval of a station, from right to left. `active` is sorted by `l_min`.
fn open_gaps(point: &BoundPoint, active: &[&Forbidden], mut found: impl FnMut(Limit, Limit)) {
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

/// How chains come into the gaps of a slab, asked from the rightmost gap to the leftmost.
struct Entry<'a> {
    /// The gaps of the slab before that may touch the next gap, by place; `None` in the first slab.
    from: Option<Range<usize>>,
    ego_l: f64,
    /// How many stations the slab has.
    stations: f64,
    active: &'a Active<'a>,
}

impl Entry<'_> {
    /// The best chain into the gap `[right, left]`, if there is any; of equals the one from farthest left.
    fn best(&mut self, gaps: &[Gap], right: f64, left: f64) -> Option<Chain> {
        let flips = flip_cost(right, left, self.active);
        let narrow = (COMFORTABLE_WIDTH - (left - right)).max(0.0) * NARROW_WEIGHT;
        let entered = |from: f64, cost: f64, parent: usize| {
            let l = from.clamp(right, left);
            let along = self.stations * (OFFSET_WEIGHT * l.abs() + narrow);
            let cost = cost + (l - from).abs() + flips + along;
            Chain { cost, l, parent }
        };
        let Some(from) = &mut self.from else {
            // The ego cannot jump across what it is beside.
            let is_jump =
                |obstacle: &&Forbidden| obstacle.only.is_some_and(|only| only != obstacle.side_of(right));
            let jumps = self.active.beside.iter().any(is_jump);
            return (!jumps).then(|| entered(self.ego_l, 0.0, 0));
        };
        // What ends right of this gap ends right of all that are still asked for.
        while from.start < from.end && gaps[from.start].left.l < right {
            from.start += 1;
        }
        let mut best: Option<Chain> = None;
        for parent in from.clone().take_while(|place| gaps[*place].right.l <= left) {
            let Chain { cost, l, .. } = gaps[parent].chain;
            let next = entered(l, cost, parent);
            if best.is_none_or(|best| next.cost <= best.cost) {
                best = Some(next);
            }
        }
        best
    }
}

/// Surcharges for the obstacles that begin at this station and would be passed on another side than before.
fn flip_cost(right: f64, left: f64, active: &Active) -> f64 {
    let flips = active.begun().iter().filter(|obstacle| {
        debug_assert!(obstacle.l_max <= right || obstacle.l_min >= left);
        obstacle
            .remembered
            .is_some_and(|before| before != obstacle.side_of(right))
    });
    flips.count() as f64 * FLIP_COST
}

/// The obstacle that closed the corridor, of those beside the first station that cannot be reached: one that
/// stands in a gap by which the station before can be left. Those all begin here, because a gap is clear of what
/// began before; the nearest in `s` is named, then the least id. Where nothing new stands in the way the road
/// itself closes a gap: then it is the obstacle begun last among those that stand between the bound's edges.
fn closer(active: &[&Forbidden], before: &[Gap], point: &BoundPoint) -> Option<ObstacleId> {
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
    let beside = || active.iter().copied();
    let named = beside().filter(in_a_gap).min_by(nearest);
    named
        .or_else(|| beside().filter(in_the_bound).max_by(latest))
        .map(|obstacle| obstacle.id)
}

/// Narrows the points to the best chain, walking back from the last slab.
fn carve(points: &mut [BoundPoint], gaps: &[Gap], slabs: &[Slab]) {
    let Some(last) = slabs.last() else { return };
    let best = gaps[last.gaps..]
        .iter()
        .enumerate()
        .min_by(|a, b| a.1.chain.cost.total_cmp(&b.1.chain.cost).then(b.0.cmp(&a.0)));
    let mut place = best.map_or(last.gaps, |(place, _)| last.gaps + place);
    let mut past = points.len();
    for slab in slabs.iter().rev() {
        let gap = &gaps[place];
        for point in &mut points[slab.first..past] {
            narrow(point, gap.right, gap.left);
        }
        (place, past) = (gap.chain.parent, slab.first);
    }
}

/// On which side of each obstacle the bound runs.
fn sides(bound: &[BoundPoint], forbidden: &[Forbidden]) -> Vec<(ObstacleId, Side)> {
    let side = |obstacle: &Forbidden| {
        let point = bound.get(obstacle.first)?;
        Some((obstacle.id, obstacle.side_of(point.l_min)))
    };
    let mut all = Vec::with_capacity(forbidden.len());
    all.extend(forbidden.iter().map_while(side));
    all
}
