//! How far left and right the car may be at each metre ahead, by what stands there (the original's
//! `PathTimeGraph::GetLateralBounds`).
//!
//! In the original an obstacle limits a single station; here all at which the car would be beside it.

use super::path_time_graph::LaneWidth;
use crate::frame::ObstacleId;
use crate::vehicle::VehicleParams;

/// Distance between two stations, m (`default_delta_s_lateral_optimization`).
pub(super) const STEP: f64 = 1.0;

/// Stations that are looked at (`max_s_lateral_optimization`).
const STATIONS: usize = 60;

/// Room beside the car where it is, m (`bound_buffer`), and beside what is passed, m (`nudge_buffer`).
const EGO_ROOM: f64 = 0.1;
const PASSING_ROOM: f64 = 0.3;

/// Room before and behind what is passed, m: the collision check's, with a little more.
const LENGTHWISE_ROOM: f64 = 2.5;

/// What is less far from the line stands on it, m.
const ON_LINE: f64 = 1e-6;

/// Half the width of a lane that the map does not tell, m.
const HALF_WIDTH: f64 = 2.0;

/// What stands in the lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticBox {
    /// Which obstacle.
    pub id: ObstacleId,
    /// From and to along the line, m.
    pub s: (f64, f64),
    /// From right to left across it, m.
    pub l: (f64, f64),
}

/// Limits (right, left) of the rear axle at `s` and every metre beyond it.
pub fn lateral_bounds(
    s: f64,
    l: f64,
    standing: &[StaticBox],
    lane_width: LaneWidth,
    vehicle: &VehicleParams,
) -> Vec<(f64, f64)> {
    let half = vehicle.half_width();
    let bound = |k: usize| {
        let at = s + k as f64 * STEP;
        let (left, right) = lane_width(at).unwrap_or((HALF_WIDTH, HALF_WIDTH));
        let (mut low, mut high) = ((-right).min(l - half - EGO_ROOM), left.max(l + half + EGO_ROOM));
        let beside = |other: &&StaticBox| {
            at + vehicle.front_edge_to_center + LENGTHWISE_ROOM >= other.s.0
                && at - vehicle.back_edge_to_center - LENGTHWISE_ROOM <= other.s.1
        };
        for other in standing.iter().filter(beside) {
            if other.l.1 > -ON_LINE && other.l.0 < ON_LINE {
                (low, high) = (-ON_LINE, ON_LINE);
            } else if other.l.1 < ON_LINE {
                low = low.max(other.l.1 + PASSING_ROOM);
            } else {
                high = high.min(other.l.0 - PASSING_ROOM);
            }
        }
        let (low, high) = (low + half, high - half);
        if low >= high { (0.0, 0.0) } else { (low, high) }
    };
    (0..STATIONS).map(bound).collect()
}
