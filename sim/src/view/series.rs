//! Quantities over time, and what is held against them.

use super::thin;
use crate::trace::{TickRecord, Trace};
use crate::world::CLEARANCE_HORIZON;
use corridor_decider::decision::PathPoint;
use corridor_decider::geometry::{Vec2, cross};
use corridor_decider::reference_line::LineQuery;
use serde::Serialize;

/// Braking and acceleration that passengers call comfortable, m/s² (nuPlan `ego_is_comfortable`).
const COMFORTABLE_ACCELERATION: [f64; 2] = [-4.05, 2.40];

/// Longitudinal jerk that passengers call comfortable, m/s³ (same source).
const COMFORTABLE_JERK: [f64; 2] = [-4.13, 4.13];

/// Distance to an obstacle below which a report warns, m: the lateral buffer of the decider.
const NEAR: f64 = 0.4;

/// Largest lateral tracking error that passes, m.
const TRACKING_TOLERANCE: f64 = 0.3;

/// One value per tick in each array; `null` where there is none.
#[derive(Serialize)]
pub(super) struct Series {
    speed: Vec<f64>,
    cruise_speed: Vec<f64>,
    speed_limit: Vec<Option<f64>>,
    acceleration: Vec<f64>,
    /// Change of the acceleration between the ticks before and after, over the time between them.
    jerk: Vec<f64>,
    clearance: Vec<Option<f64>>,
    nearest: Vec<Option<u32>>,
    /// Where the ego is at the end of the tick, left of the path that it was to follow.
    tracking: Vec<Option<f64>>,
    limits: Limits,
}

/// Limits drawn into the charts.
#[derive(Serialize)]
struct Limits {
    acceleration: [f64; 2],
    jerk: [f64; 2],
    clearance: f64,
    /// Distance up to which clearance is measured, m.
    clearance_horizon: f64,
    tracking: f64,
}

impl Series {
    pub(super) fn new(trace: &Trace, stations: &[f64]) -> Self {
        let ticks = &trace.ticks;
        let column =
            |value: &dyn Fn(&TickRecord) -> f64| ticks.iter().map(|t| thin::milli(value(t))).collect();
        Self {
            speed: column(&|t| t.frame.ego.v),
            cruise_speed: column(&|t| t.frame.cruise_speed),
            speed_limit: (ticks.iter().zip(stations))
                .map(|(t, s)| trace.line(t).sample_at(*s).speed_limit)
                .collect(),
            acceleration: column(&|t| t.frame.ego.a),
            jerk: jerk(ticks),
            clearance: ticks
                .iter()
                .map(|t| t.clearance.map(|(d, _)| thin::milli(d)))
                .collect(),
            nearest: ticks.iter().map(|t| t.clearance.map(|(_, id)| id.0)).collect(),
            tracking: ticks
                .iter()
                .map(|t| beside_path(&t.decision.path, t.ego.pose.position()).map(thin::milli))
                .collect(),
            limits: Limits {
                acceleration: COMFORTABLE_ACCELERATION,
                jerk: COMFORTABLE_JERK,
                clearance: NEAR,
                clearance_horizon: CLEARANCE_HORIZON,
                tracking: TRACKING_TOLERANCE,
            },
        }
    }
}

/// Station of the ego on the line of each tick.
pub(super) fn stations(trace: &Trace) -> Vec<f64> {
    let station = |t: &TickRecord| trace.line(t).to_frenet(t.frame.ego.pose.position()).s;
    trace.ticks.iter().map(station).collect()
}

fn jerk(ticks: &[TickRecord]) -> Vec<f64> {
    let at = |k: usize| {
        let before = &ticks[k.saturating_sub(1)].frame;
        let after = &ticks[(k + 1).min(ticks.len() - 1)].frame;
        let period = after.time - before.time;
        if period > 0.0 {
            (after.ego.a - before.ego.a) / period
        } else {
            0.0
        }
    };
    (0..ticks.len()).map(|k| thin::centi(at(k))).collect()
}

/// Distance of `point` from the nearest segment of the path, left positive.
fn beside_path(path: &[PathPoint], point: Vec2) -> Option<f64> {
    let signed = |pair: &[PathPoint]| {
        let (a, b) = (pair[0].pose.position(), pair[1].pose.position());
        let along = b - a;
        let length_squared = along.norm_squared();
        if length_squared <= 0.0 {
            return None;
        }
        let t = ((point - a).dot(&along) / length_squared).clamp(0.0, 1.0);
        let distance = (point - a - along * t).norm();
        Some(distance.copysign(cross(along, point - a)))
    };
    path.windows(2)
        .filter_map(signed)
        .min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::synthetic;

    #[test]
    fn left_of_the_path_is_positive() {
        let trace = synthetic::trace(2, 3);
        let path = &trace.ticks[0].decision.path;
        for l in [-0.2, 0.0, 0.3] {
            let beside = path[20].pose.to_world(Vec2::new(0.1, l));
            assert!((beside_path(path, beside).unwrap() - l).abs() < 1e-3);
        }
        assert_eq!(beside_path(&path[..1], Vec2::new(0.0, 0.0)), None);
    }

    #[test]
    fn jerk_is_the_slope_of_the_acceleration() {
        let mut trace = synthetic::trace(10, 3);
        for (k, tick) in trace.ticks.iter_mut().enumerate() {
            tick.frame.ego.a = -0.25 * k as f64;
        }
        assert!(jerk(&trace.ticks).iter().all(|j| (j + 2.5).abs() < 1e-9));
        assert!(jerk(&trace.ticks[..1]).iter().all(|j| *j == 0.0));
    }
}
