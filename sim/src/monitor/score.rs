//! `nuplan_cls`: nuPlan's closed-loop score of a run, for comparison with other planners. Never a gate.
//!
//! The product of the multipliers times the weighted mean of progress 5, time to collision 5, speed limit 4 and
//! comfort 2. What a run gave no occasion to measure counts as good.

use super::measure::Measure;
use crate::verdict::Metric;

/// The four weighted terms; whether the value itself is the score, or whether it is good enough.
const TERMS: [(&str, f64, bool); 4] = [
    ("progress", 5.0, true),
    ("ttc", 5.0, false),
    ("speed_limit", 4.0, true),
    ("comfort", 2.0, false),
];

/// The multipliers that are 0 or 1.
const MULTIPLIERS: [&str; 3] = ["no_at_fault_collision", "drivable_area", "progress_min"];

/// Distance against the lane's direction up to which the score is whole, and half, m.
const AGAINST: [(f64, f64); 2] = [(2.0, 1.0), (6.0, 0.5)];

/// The score in `[0, 1]`.
pub(super) fn nuplan_score(metrics: &[Metric]) -> Measure {
    let find = |name: &str| metrics.iter().find(|m| m.name == name);
    let passes = |name: &str| find(name).is_none_or(|m| m.pass);
    let direction = find("driving_direction").and_then(|m| m.value).unwrap_or(0.0);
    let direction = AGAINST
        .iter()
        .find(|(limit, _)| direction <= *limit)
        .map_or(0.0, |(_, score)| *score);
    if !MULTIPLIERS.iter().all(|name| passes(name)) {
        return Measure::new("nuplan_cls", Some(0.0));
    }
    let (mut sum, mut weights) = (0.0, 0.0);
    for (name, weight, is_score) in TERMS {
        let good = f64::from(u8::from(passes(name)));
        let value = find(name)
            .and_then(|m| m.value)
            .filter(|_| is_score)
            .unwrap_or(good);
        sum += weight * value;
        weights += weight;
    }
    Measure::new("nuplan_cls", Some(direction * sum / weights))
}
