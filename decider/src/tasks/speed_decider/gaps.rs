//! Distances kept to moving obstacles (the original's `StGapEstimator`).

/// Time kept to a leader, s (`follow_time_buffer`).
const FOLLOW_TIME: f64 = 2.5;

/// Least distance to a leader, m (`follow_min_distance`).
const FOLLOW_DISTANCE: f64 = 3.0;

/// Distance to whom one lets pass, m (`yield_distance`).
const YIELD_DISTANCE: f64 = 5.0;

/// Time kept before whom one passes, s.
const OVERTAKE_TIME: f64 = 3.0;

/// Least distance before whom one passes, m.
const OVERTAKE_DISTANCE: f64 = 10.0;

/// Distance to pass before a car with speed `v_object` along the ego's heading, m.
pub fn overtaking_gap(v_object: f64, v_ego: f64) -> f64 {
    (v_ego.max(v_object) * OVERTAKE_TIME).max(OVERTAKE_DISTANCE)
}

/// Distance to a leader at speed `v_ego`, m.
pub fn following_gap(v_ego: f64) -> f64 {
    (v_ego * FOLLOW_TIME).max(FOLLOW_DISTANCE)
}

/// Distance to whom one lets pass, m.
pub fn yielding_gap() -> f64 {
    YIELD_DISTANCE
}
