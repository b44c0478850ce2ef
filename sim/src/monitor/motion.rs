//! `comfort` with its parts, `speed_limit`, `overspeed`: how the ego moves.
//!
//! nuPlan's comfort: six quantities from 10 Hz samples at the rear axle by Savitzky–Golay parabolas. SI units.

use super::SAMPLE_PERIOD;
use super::measure::{Extreme, Measure};
use super::savitzky_golay::derivative;
use super::view::Sample;
use corridor_decider::geometry::angle;

/// Samples in the window that smooths accelerations (nuPlan).
const ACCELERATION_WINDOW: usize = 8;

/// Samples in the window for jerk, yaw rate and yaw acceleration (nuPlan).
const RATE_WINDOW: usize = 15;

/// Hardest comfortable braking, m/s² (nuPlan; the next five too).
pub(super) const MAX_BRAKING: f64 = 4.05;
/// Strongest comfortable acceleration, m/s².
pub(super) const MAX_ACCELERATION: f64 = 2.40;
/// Largest comfortable lateral acceleration, m/s².
pub(super) const MAX_LATERAL: f64 = 4.89;
/// Largest comfortable yaw acceleration, rad/s².
pub(super) const MAX_YAW_ACCELERATION: f64 = 1.93;
/// Largest comfortable yaw rate, rad/s.
pub(super) const MAX_YAW_RATE: f64 = 0.95;
/// Largest comfortable longitudinal jerk, m/s³.
pub(super) const MAX_LON_JERK: f64 = 4.13;
/// Largest comfortable jerk, m/s³.
pub(super) const MAX_JERK: f64 = 8.37;

/// Mean overspeed at which the score is 0, m/s (nuPlan).
const OVERSPEED_SCALE: f64 = 2.23;

/// Overspeed that nuPlan calls a violation, m/s.
pub(super) const OVERSPEED_VIOLATION: f64 = 1.0;

/// The motion of a whole run, sampled.
#[derive(Clone, Debug, Default)]
pub(super) struct MotionWatch {
    times: Vec<f64>,
    a_lon: Vec<f64>,
    a_lat: Vec<f64>,
    /// Heading without jumps at ±π.
    theta: Vec<f64>,
    overspeed: Extreme,
    /// ∫ max(0, v − limit) dt, m.
    overspeed_integral: f64,
}

impl MotionWatch {
    pub(super) fn sample(&mut self, sample: &Sample) {
        let ego = sample.ego();
        self.times.push(sample.time());
        self.a_lon.push(ego.a);
        self.a_lat.push(ego.v * ego.yaw_rate);
        let theta = self.theta.last().map_or(ego.pose.theta, |last| {
            last + angle::difference(ego.pose.theta, *last)
        });
        self.theta.push(theta);
        if let Some(limit) = sample.scenario.line.sample_at(sample.at.s).speed_limit {
            self.overspeed.raise(ego.v - limit, sample.time(), None);
            self.overspeed_integral += (ego.v - limit).max(0.0) * SAMPLE_PERIOD;
        }
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        let parts = self.comfort_parts();
        let mut worst = Extreme::default();
        for (_, part, limit) in &parts {
            if let (Some(value), Some(time)) = (part.value, part.time) {
                worst.raise(value / limit, time, None);
            }
        }
        let duration = self.times.len() as f64 * SAMPLE_PERIOD;
        let score = (1.0 - self.overspeed_integral / (OVERSPEED_SCALE * duration)).max(0.0);
        let score = self.overspeed.value.map(|_| score);
        let mut measures = vec![
            worst.measure("comfort"),
            Measure::new("speed_limit", score).at(self.overspeed.time),
            self.overspeed.measure("overspeed"),
        ];
        measures.extend(parts.iter().map(|(name, part, _)| part.measure(name)));
        measures
    }

    /// The largest magnitude of each quantity, with its name and its bound.
    fn comfort_parts(&self) -> [(&'static str, Extreme, f64); 7] {
        let smooth = |values: &[f64]| derivative(values, ACCELERATION_WINDOW, 0, SAMPLE_PERIOD);
        let rate = |values: &[f64], order| derivative(values, RATE_WINDOW, order, SAMPLE_PERIOD);
        let largest = |values: &[f64], of: fn(f64) -> f64| {
            let mut extreme = Extreme::default();
            for (value, time) in values.iter().zip(&self.times) {
                extreme.raise(of(*value), *time, None);
            }
            extreme
        };
        let pairs = self.a_lon.iter().zip(&self.a_lat);
        let magnitude: Vec<f64> = pairs.map(|(lon, lat)| (lon * lon + lat * lat).sqrt()).collect();
        let (lon, lat) = (smooth(&self.a_lon), smooth(&self.a_lat));
        let (yaw_rate, yaw_acceleration) = (rate(&self.theta, 1), rate(&self.theta, 2));
        let (lon_jerk, jerk) = (rate(&self.a_lon, 1), rate(&magnitude, 1));
        [
            ("braking", largest(&lon, |a| -a), MAX_BRAKING),
            ("acceleration", largest(&lon, |a| a), MAX_ACCELERATION),
            ("lateral_acceleration", largest(&lat, f64::abs), MAX_LATERAL),
            ("yaw_rate", largest(&yaw_rate, f64::abs), MAX_YAW_RATE),
            (
                "yaw_acceleration",
                largest(&yaw_acceleration, f64::abs),
                MAX_YAW_ACCELERATION,
            ),
            ("lon_jerk", largest(&lon_jerk, f64::abs), MAX_LON_JERK),
            ("jerk", largest(&jerk, f64::abs), MAX_JERK),
        ]
    }
}
