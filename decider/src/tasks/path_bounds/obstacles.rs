//! Which obstacles a bound goes around, and how they close it.

use super::bound::BoundPoint;
use super::config::PathBoundsConfig;
use super::forbidden::Forbidden;
use super::input::{Input, ObstacleSl};
use super::stations::{self, Station};
use super::{gaps, greedy};
use crate::frame::ObstacleId;
use crate::road::Side;

/// How much obstacles are widened for one candidate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Widening {
    /// To each side, m.
    pub lateral: f64,
    /// Down to which the lateral widening gives way beside the ego, m.
    pub hard: f64,
}

impl Widening {
    /// For every bound but the fallback.
    pub(super) fn regular(config: &PathBoundsConfig) -> Self {
        Self {
            lateral: config.obstacle_lat_buffer,
            hard: config.hard_obstacle_lat_buffer,
        }
    }

    pub(super) fn fallback(config: &PathBoundsConfig) -> Self {
        Self {
            lateral: config.fallback_obstacle_lat_buffer,
            hard: config.hard_obstacle_lat_buffer,
        }
    }
}

/// An obstacle in scope and the stations beside it: the same for all candidates of a call.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beside {
    pub id: ObstacleId,
    /// First station beside it, and the first one past it.
    pub first: usize,
    pub past: usize,
    /// Its near edge, m.
    pub start_s: f64,
    /// Its right and left edge, m.
    pub start_l: f64,
    pub end_l: f64,
    /// The side on which it was passed in the tick before.
    pub remembered: Option<Side>,
}

/// What a bound's obstacles did to it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Passage {
    /// Whether the bound ends before its horizon because of obstacles.
    pub is_blocked: bool,
    /// By which, if one can be named.
    pub blocked_by: Option<ObstacleId>,
    /// On which side of each obstacle the bound runs.
    pub passed: Vec<(ObstacleId, Side)>,
}

/// Finds the stations beside every obstacle in scope, by first station; then right to left, whatever the order of
/// the input.
pub(super) fn beside(stations: &[Station], input: &Input, remembered: &[(ObstacleId, Side)]) -> Vec<Beside> {
    let config = input.config;
    // Of an id that is there twice the first one counts, as the sort is stable.
    let mut remembered = remembered.to_vec();
    remembered.sort_by_key(|(id, _)| *id);
    let passed = |id: ObstacleId| {
        let place = remembered.partition_point(|(other, _)| *other < id);
        remembered
            .get(place)
            .filter(|(other, _)| *other == id)
            .map(|(_, side)| *side)
    };
    let mut all: Vec<Beside> = Vec::with_capacity(input.obstacles.len());
    for obstacle in input.obstacles.iter().filter(|o| is_in_scope(o, input)) {
        let first = stations::count_until(stations, obstacle.start_s - config.obstacle_lon_start_buffer);
        let past = stations::count_until(stations, obstacle.end_s + config.obstacle_lon_end_buffer);
        if first < past {
            all.push(Beside {
                id: obstacle.id,
                first,
                past,
                start_s: obstacle.start_s,
                start_l: obstacle.start_l,
                end_l: obstacle.end_l,
                remembered: passed(obstacle.id),
            });
        }
    }
    all.sort_by(|a, b| {
        a.first
            .cmp(&b.first)
            .then(a.start_l.total_cmp(&b.start_l))
            .then(a.id.cmp(&b.id))
    });
    all
}

/// Narrows `bound` to one way around all static obstacles; ends it where there is none.
pub(super) fn limit(bound: &mut Vec<BoundPoint>, input: &Input, forbidden: &[Forbidden]) -> Passage {
    if bound.is_empty() {
        return Passage::default();
    }
    if input.config.quirks.greedy_sides {
        greedy::limit(bound, input)
    } else {
        gaps::limit(bound, input, forbidden)
    }
}

/// Whether an obstacle concerns the static bounds at all. One whose box has an edge that is no number cannot be
/// placed and does not.
pub(super) fn is_in_scope(obstacle: &ObstacleSl, input: &Input) -> bool {
    let edges = [obstacle.start_s, obstacle.end_s, obstacle.start_l, obstacle.end_l];
    let is_placed = edges.iter().all(|edge| !edge.is_nan());
    let stands = obstacle.is_static && obstacle.speed <= input.config.static_obstacle_speed_threshold;
    let last = if input.config.quirks.forgets_beside_overhang {
        obstacle.end_s
    } else {
        obstacle.end_s + input.config.obstacle_lon_end_buffer
    };
    is_placed && !obstacle.is_virtual && !obstacle.is_ignored && stands && last >= input.ego.s
}
