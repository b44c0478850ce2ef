//! Where sampled curves end (the original's `EndConditionSampler`).

use super::feasible_region::FeasibleRegion;
use super::path_time_graph::PathTimeEntry;
use crate::st_graph::StPoint;
use crate::vehicle::VehicleParams;

/// End offsets of lateral curves, m, and the path lengths at which they are reached, m.
const OFFSETS: [f64; 3] = [0.0, -0.5, 0.5];
const LENGTHS: [f64; 4] = [10.0, 20.0, 40.0, 80.0];

/// Shortest curve, s (`polynomial_minimal_param`).
const SHORTEST: f64 = 0.01;

/// End times of longitudinal curves, s.
const END_TIMES: [f64; 9] = [SHORTEST, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];

/// Most speeds between the lowest and the highest one (`num_velocity_sample` − 2), and least difference, m/s
/// (`min_velocity_sample_gap`).
const MOST_SPEEDS: f64 = 4.0;
const SPEED_GAP: f64 = 1.0;

/// Distance along the line that is kept to obstacles, m (`default_lon_buffer`).
const BUFFER: f64 = 5.0;

/// Samples behind a point below an obstacle (`num_sample_follow_per_timestamp`).
const FOLLOW_SAMPLES: usize = 3;

/// How far beside an entry its points lie, m (`numerical_epsilon`).
const BESIDE: f64 = 1e-6;

/// Value, first and second derivative at the end of a curve, and its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndCondition {
    /// Value, first and second derivative.
    pub state: [f64; 3],
    /// Where in the parameter.
    pub length: f64,
}

/// Ends of lateral curves.
pub fn lateral() -> Vec<EndCondition> {
    let at = |length: f64| {
        OFFSETS.map(|l| EndCondition {
            state: [l, 0.0, 0.0],
            length,
        })
    };
    LENGTHS.into_iter().flat_map(at).collect()
}

/// Ends of cruise curves, whose place is free: at each time the lowest and the highest speed and some between.
pub fn cruise(region: &FeasibleRegion, cruise_speed: f64) -> Vec<EndCondition> {
    let mut ends = Vec::new();
    for length in END_TIMES {
        let (low, high) = (region.v_lower(length), region.v_upper(length).min(cruise_speed));
        let mut push = |v: f64| {
            ends.push(EndCondition {
                state: [0.0, v, 0.0],
                length,
            });
        };
        push(low);
        push(high);
        // A car far above the cruise speed cannot be as slow as that soon: then there is nothing between.
        let range = high - low;
        let between = (range / SPEED_GAP).floor().clamp(0.0, MOST_SPEEDS);
        let mut k = 1.0;
        while k <= between {
            push(low + k * range / (between + 1.0));
            k += 1.0;
        }
    }
    ends
}

/// Ends of curves from `s` to a standstill at `stop_s`, or where the car is if that is behind it.
pub fn stop(s: f64, stop_s: f64) -> Vec<EndCondition> {
    let end = |length: f64| EndCondition {
        state: [s.max(stop_s), 0.0, 0.0],
        length,
    };
    END_TIMES.map(end).to_vec()
}

/// Ends of curves that follow and overtake an obstacle in the path-time graph; `speed` is its speed along the line at a
/// station and a time.
pub fn path_time(
    entry: &PathTimeEntry,
    region: &FeasibleRegion,
    vehicle: &VehicleParams,
    speed: impl Fn(StPoint) -> f64,
) -> Vec<EndCondition> {
    let mut ends = Vec::new();
    let mut push = |point: StPoint, s: f64| {
        let is_feasible =
            point.t >= SHORTEST && (region.s_lower(point.t)..=region.s_upper(point.t)).contains(&s);
        if is_feasible {
            ends.push(EndCondition {
                state: [s, speed(point), 0.0],
                length: point.t,
            });
        }
    };
    for point in entry.points_beside(-BESIDE) {
        let farthest = point.s - vehicle.front_edge_to_center;
        let gap = BUFFER / (FOLLOW_SAMPLES - 1) as f64;
        for k in 0..FOLLOW_SAMPLES {
            push(point, farthest - BUFFER + k as f64 * gap);
        }
    }
    for point in entry.points_beside(BESIDE) {
        push(point, point.s + BUFFER);
    }
    ends
}
