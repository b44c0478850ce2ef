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
use super::input::Input;
use super::obstacles::{Beside, Passage, Widening};
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
    /// Place of its predecessor among the gaps of the slab before.
    parent: usize,
}

/// Stations in a row with the same gaps: no obstacle begins or ends between them and the bound keeps its edges.
#[derive(Clone, Copy, Debug)]
struct Slab {
    /// Its first station.
    first: usize,
    /// Place of its rightmost gap among all gaps.
    gaps: usize,
}

pub(super) fn limit(
    bound: &mut Vec<BoundPoint>,
    input: &Input,
    beside: &[Beside],
    widening: Widening,
) -> Passage {
    let forbidden = forbidden_intervals(bound.len(), input, beside, widening);
    let mut passage = Passage::default();
    if forbidden.is_empty() {
        return passage;
    }
    let mut slabs: Vec<Slab> = Vec::with_capacity(2 * forbidden.len());
    let mut gaps: Vec<Gap> = Vec::with_capacity(4 * forbidden.len());
    let mut active = Active::of(&forbidden, bound);
    let mut first = 0;

    while first < bound.len() {
        active.move_to(first);
        let past = first + count_alike(&bound[first..active.next_change().min(bound.len())]);
        let start = gaps.len();
        let before = slabs.last().map_or(0, |slab| slab.gaps)..start;
        let entry = Entry {
            is_first: first == 0,
            ego_l: input.ego.l,
            first,
            stations: (past - first) as f64,
        };
        open_gaps(&bound[first], &active.beside, |right, left| {
            if let Some(gap) = entry.best(&gaps[before.clone()], right, left, &active.beside) {
                gaps.push(gap);
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
    passage.passed = sides(bound, &forbidden);
    passage
}

/// What each obstacle forbids, by first station.
fn forbidden_intervals(
    stations: usize,
    input: &Input,
    beside: &[Beside],
    widening: Widening,
) -> Vec<Forbidden> {
    let mut all = Vec::with_capacity(beside.len());
    let reached = beside.iter().take_while(|obstacle| obstacle.first < stations);
    all.extend(reached.filter_map(|obstacle| forbidden_by(obstacle, input, widening)));
    all
}

/// What one obstacle forbids, if that is anything.
fn forbidden_by(obstacle: &Beside, input: &Input, widening: Widening) -> Option<Forbidden> {
    let half_width = input.vehicle.half_width();
    let right = obstacle.start_l.min(obstacle.end_l);
    let left = obstacle.start_l.max(obstacle.end_l);
    let (mut buffer_right, mut buffer_left) = (widening.lateral, widening.lateral);
    let mut only = None;
    if obstacle.first == 0 {
        // Beside the ego the buffer gives way rather than demand a jump, and the side is chosen.
        let kept = |room: f64| {
            (room - half_width - EGO_SLACK)
                .max(widening.hard.min(widening.lateral))
                .min(widening.lateral)
        };
        let (room_left, room_right) = (input.ego.l - left, right - input.ego.l);
        (buffer_right, buffer_left) = (kept(room_right), kept(room_left));
        only = match (room_left >= 0.0, room_right >= 0.0) {
            (true, _) => Some(Side::Left),
            (_, true) => Some(Side::Right),
            _ => None,
        };
    }
    let l_min = right - half_width - buffer_right;
    let l_max = left + half_width + buffer_left;
    (l_min < l_max).then_some(Forbidden {
        id: obstacle.id,
        start_s: obstacle.start_s,
        first: obstacle.first,
        past: obstacle.past,
        l_min,
        l_max,
        remembered: obstacle.remembered,
        only,
    })
}

/// The obstacles beside one station, moved along the bound.
struct Active<'a> {
    /// By ascending right edge.
    beside: Vec<&'a Forbidden>,
    /// Those still to come.
    ahead: std::iter::Peekable<std::vec::IntoIter<&'a Forbidden>>,
}

impl<'a> Active<'a> {
    /// All that narrow the bound somewhere, or that the ego is beside: what lies outside changes no gap.
    fn of(all: &'a [Forbidden], bound: &[BoundPoint]) -> Self {
        let (right, left) = bound.iter().fold((f64::MAX, -f64::MAX), |(right, left), point| {
            (right.min(point.l_min), left.max(point.l_max))
        });
        let matters = |o: &&Forbidden| (o.l_max > right && o.l_min < left) || o.only.is_some();
        let mut ahead = Vec::with_capacity(all.len());
        ahead.extend(all.iter().filter(matters));
        Self {
            beside: Vec::with_capacity(ahead.len()),
            ahead: ahead.into_iter().peekable(),
        }
    }

    fn move_to(&mut self, station: usize) {
        self.beside.retain(|obstacle| obstacle.past > station);
        while let Some(obstacle) = self.ahead.next_if(|obstacle| obstacle.first <= station) {
            let place = self.beside.partition_point(|other| other.l_min <= obstacle.l_min);
            self.beside.insert(place, obstacle);
        }
    }

    /// The next station at which an obstacle begins or ends.
    fn next_change(&mut self) -> usize {
        let next = self.ahead.peek().map_or(usize::MAX, |obstacle| obstacle.first);
        self.beside
            .iter()
            .map(|obstacle| obstacle.past)
            .fold(next, usize::min)
    }
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

/// How chains come into the gaps of a slab.
struct Entry {
    is_first: bool,
    ego_l: f64,
    /// Its first station, and how many there are.
    first: usize,
    stations: f64,
}

impl Entry {
    /// The best chain into a gap from the slab before, if any of its gaps touches it; the leftmost of equals.
    fn best(&self, before: &[Gap], right: Limit, left: Limit, active: &[&Forbidden]) -> Option<Gap> {
        let flips = flip_cost(right, left, active, self.first);
        let narrow = (COMFORTABLE_WIDTH - (left.l - right.l)).max(0.0) * NARROW_WEIGHT;
        let entered = |from: f64, cost: f64, parent: usize| {
            let l = from.clamp(right.l, left.l);
            let along = self.stations * (OFFSET_WEIGHT * l.abs() + narrow);
            Gap {
                right,
                left,
                cost: cost + (l - from).abs() + flips + along,
                l,
                parent,
            }
        };
        if self.is_first {
            // The ego cannot jump across what it is beside.
            let jumps = |obstacle: &&Forbidden| {
                obstacle
                    .only
                    .is_some_and(|only| only != obstacle.side_of(right.l))
            };
            return (!active.iter().any(jumps)).then(|| entered(self.ego_l, 0.0, 0));
        }
        let touching = |gap: &Gap| gap.right.l <= left.l && right.l <= gap.left.l;
        let mut best: Option<Gap> = None;
        for (parent, gap) in before.iter().enumerate().filter(|(_, gap)| touching(gap)) {
            let next = entered(gap.l, gap.cost, parent);
            if best.is_none_or(|best| next.cost <= best.cost) {
                best = Some(next);
            }
        }
        best
    }
}

/// Surcharges for the obstacles that begin at this station and would be passed on another side than before.
fn flip_cost(right: Limit, left: Limit, active: &[&Forbidden], i: usize) -> f64 {
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
        .min_by(|a, b| a.1.cost.total_cmp(&b.1.cost).then(b.0.cmp(&a.0)));
    let mut place = best.map_or(0, |(place, _)| place);
    let mut past = points.len();
    for slab in slabs.iter().rev() {
        let gap = &gaps[slab.gaps + place];
        for point in &mut points[slab.first..past] {
            narrow(point, gap.right, gap.left);
        }
        (place, past) = (gap.parent, slab.first);
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
