//! How near a run came to a failure, as one number: what a search follows downhill.

use crate::verdict::Verdict;

/// Metrics that shrink as a failure comes near, with the value at which a run is as good as it gets: a clearance at which
/// nobody looks up, a time to collision beyond nuPlan's horizon, a whole score.
const SHRINKING: [(&str, f64); 3] = [("min_clearance", 2.0), ("ttc", 3.0), ("ext_cls", 1.0)];

/// Metrics that grow towards their threshold.
const GROWING: [&str; 4] = ["drivable_area", "standstill", "bound_jitter", "fallback_ratio"];

/// At most 0 for a run that failed, else in (0, 1]: the smallest share that is left of anything, with a little of the others
/// so that a run that is near in two ways is nearer.
pub fn margin(verdict: &Verdict) -> f64 {
    let value = |name: &str| verdict.metric(name).and_then(|metric| metric.value);
    let shrinking = SHRINKING
        .iter()
        .filter_map(|(name, whole)| Some((value(name)? / whole).clamp(0.0, 1.0)));
    let growing = GROWING.iter().filter_map(|name| {
        let metric = verdict.metric(name)?;
        let threshold = metric.threshold.filter(|threshold| *threshold > 0.0)?;
        Some((1.0 - metric.value? / threshold).clamp(0.0, 1.0))
    });
    let shares: Vec<f64> = shrinking.chain(growing).collect();
    let least = shares.iter().copied().fold(1.0, f64::min);
    let mean = shares.iter().sum::<f64>() / shares.len().max(1) as f64;
    let near = 0.9 * least + 0.1 * mean;
    if verdict.pass {
        near.max(f64::MIN_POSITIVE)
    } else {
        near - 1.0
    }
}
