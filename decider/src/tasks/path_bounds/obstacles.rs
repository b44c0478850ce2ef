//! Which obstacles a bound goes around, and how they close it.

use super::bound::BoundPoint;
use super::input::{Input, ObstacleSl};
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

/// Narrows `bound` to one way around all static obstacles; ends it where there is none.
pub(super) fn limit(
    bound: &mut Vec<BoundPoint>,
    input: &Input,
    remembered: &[(ObstacleId, Side)],
    widening: Widening,
) -> Passage {
    if bound.is_empty() {
        return Passage::default();
    }
    if input.config.quirks.greedy_sides {
        greedy::limit(bound, input)
    } else {
        gaps::limit(bound, input, remembered, widening)
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
