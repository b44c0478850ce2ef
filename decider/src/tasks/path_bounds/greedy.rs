//! The original's sweep over obstacle edges (`GetBoundaryFromStaticObstacles`), defects included.
//!
//! Each obstacle is passed on the side of its centre, seen from the corridor's middle at its first edge,
//! once and for all. Kept behind the quirk `greedy_sides`; [`super::gaps`] is what replaces it.

use super::bound::{BoundPoint, EdgeCause};
use super::edges::{Limit, narrow, tighten};
use super::input::Input;
use super::obstacles::{Passage, is_in_scope};
use crate::frame::ObstacleId;
use crate::road::Side;

/// A near or far edge of a widened obstacle.
#[derive(Clone, Copy)]
struct Edge {
    s: f64,
    is_start: bool,
    l_min: f64,
    l_max: f64,
    id: ObstacleId,
}

/// Obstacles that the sweep is beside, with the side of the car's passage and the edge it keeps from.
struct Active {
    id: ObstacleId,
    side: Side,
    l: f64,
}

pub(super) fn limit(bound: &mut Vec<BoundPoint>, input: &Input) -> Passage {
    let half_width = input.vehicle.half_width();
    let edges = sorted_edges(input);
    let mut next = 0;
    let mut center = input.ego.l;
    let mut active: Vec<Active> = Vec::new();
    let mut passage = Passage::default();

    for i in 1..bound.len() {
        let mut blocked = false;
        let mut consumed = false;
        while let Some(edge) = edges.get(next).filter(|edge| edge.s < bound[i].s) {
            consumed = true;
            if edge.is_start {
                enter(&mut active, edge, center);
                let (right, left) = limits(&active, half_width);
                // The original ignores whether this closes the corridor.
                let _ = tighten(&mut bound[i], right, left);
                center = f64::midpoint(bound[i].l_min, bound[i].l_max);
            } else if let Some(place) = active.iter().position(|other| other.id == edge.id) {
                passage.passed.push((active[place].id, active[place].side));
                active.remove(place);
            }
            blocked = !apply(&mut bound[i], &active, half_width, &mut center);
            if blocked {
                break;
            }
            next += 1;
        }
        if !consumed {
            blocked = !apply(&mut bound[i], &active, half_width, &mut center);
        }
        if blocked {
            passage.is_blocked = true;
            passage.blocked_by = blocker(&active, input.config.quirks.arbitrary_blocker);
            bound.truncate(i);
            break;
        }
    }
    passage
        .passed
        .extend(active.iter().map(|other| (other.id, other.side)));
    passage
}

/// Near edges before far ones at the same station, then by the obstacles' order.
fn sorted_edges(input: &Input) -> Vec<Edge> {
    let config = input.config;
    let mut edges = Vec::with_capacity(2 * input.obstacles.len());
    for obstacle in input
        .obstacles
        .iter()
        .filter(|obstacle| is_in_scope(obstacle, input))
    {
        let edge = |s, is_start| Edge {
            s,
            is_start,
            l_min: obstacle.start_l - config.obstacle_lat_buffer,
            l_max: obstacle.end_l + config.obstacle_lat_buffer,
            id: obstacle.id,
        };
        edges.push(edge(obstacle.start_s - config.obstacle_lon_start_buffer, true));
        edges.push(edge(obstacle.end_s + config.obstacle_lon_end_buffer, false));
    }
    edges.sort_by(|a, b| a.s.total_cmp(&b.s).then(b.is_start.cmp(&a.is_start)));
    edges
}

fn enter(active: &mut Vec<Active>, edge: &Edge, center: f64) {
    let (side, l) = if edge.l_min + edge.l_max < center * 2.0 {
        (Side::Left, edge.l_max)
    } else {
        (Side::Right, edge.l_min)
    };
    active.push(Active { id: edge.id, side, l });
}

/// The tightest limits that the active obstacles set for the rear axle.
fn limits(active: &[Active], half_width: f64) -> (Limit, Limit) {
    let mut right = Limit {
        l: -f64::MAX,
        cause: EdgeCause::Unbounded,
    };
    let mut left = Limit {
        l: f64::MAX,
        cause: EdgeCause::Unbounded,
    };
    for other in active {
        let cause = EdgeCause::Obstacle(other.id);
        match other.side {
            Side::Left if other.l > right.l => right = Limit { l: other.l, cause },
            Side::Right if other.l < left.l => left = Limit { l: other.l, cause },
            _ => {}
        }
    }
    (
        Limit {
            l: right.l + half_width,
            ..right
        },
        Limit {
            l: left.l - half_width,
            ..left
        },
    )
}

/// Narrows a point to the active obstacles; `false` when that closes it.
fn apply(point: &mut BoundPoint, active: &[Active], half_width: f64, center: &mut f64) -> bool {
    let (right, left) = limits(active, half_width);
    narrow(point, right, left);
    if point.l_min > point.l_max {
        return false;
    }
    *center = f64::midpoint(point.l_min, point.l_max);
    true
}

/// The original names the first of an unordered set: here the least id. Otherwise the one entered last.
fn blocker(active: &[Active], arbitrary: bool) -> Option<ObstacleId> {
    let least = || active.iter().map(|other| other.id).min();
    let named = if arbitrary {
        least()
    } else {
        active.last().map(|other| other.id)
    };
    named.filter(|id| *id != ObstacleId::ANONYMOUS)
}
