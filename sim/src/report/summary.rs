//! What the runs of one scenario add up to.

use super::{RunResult, SweepRow};
use crate::sweep::statistics::{CONFIDENCE, failure_rate_bound, percentile};
use crate::verdict::Ending;
use serde::Serialize;
use std::cmp::Ordering;

/// The runs of one scenario.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScenarioSummary {
    /// Name of the scenario family.
    pub scenario: String,
    /// Runs in all.
    pub runs: u64,
    /// Runs that passed.
    pub passed: u64,
    /// Runs that could not be judged.
    pub broken: u64,
    /// Runs with a collision.
    pub collisions: u64,
    /// Runs with a collision for which the ego is to blame.
    pub at_fault: u64,
    /// Runs in which the ego left the road.
    pub off_road: u64,
    /// Median of the progress, where it was measured.
    pub progress: Option<f64>,
    /// Mean of nuPlan's score over the judged runs.
    pub nuplan_cls: Option<f64>,
    /// Mean of the extended score over them.
    pub ext_cls: Option<f64>,
    /// Runs that were asked to pull over, and how many did.
    pub pull_overs: PullOvers,
    /// Upper bound of the failure rate at 95 %, from the judged runs.
    pub failure_rate_bound: f64,
    /// Rejected draws.
    pub rejected: u64,
    /// The seed of the worst run: a failed one, else the one that came nearest to an obstacle.
    pub worst_seed: Option<u64>,
    /// The seed whose run took longest in simulated time.
    pub longest_seed: Option<u64>,
    /// The seed whose run took longest on this machine.
    #[serde(skip)]
    pub slowest_seed: Option<u64>,
}

/// Pull-overs asked for and done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct PullOvers {
    /// Runs whose ending should have been a pull-over.
    pub asked: u64,
    /// Runs that ended in one.
    pub done: u64,
}

impl ScenarioSummary {
    /// Adds up rows of one scenario.
    pub(super) fn new(rows: &[SweepRow]) -> Self {
        let count = |wanted: &dyn Fn(&SweepRow) -> bool| rows.iter().filter(|r| wanted(r)).count() as u64;
        let fails = |row: &SweepRow, name: &str| {
            let metrics = row.verdict().map_or(&[][..], |verdict| &verdict.metrics);
            metrics.iter().any(|m| m.name == name && !m.pass)
        };
        let broken = count(&|row| matches!(row.result, RunResult::Broken(_)));
        let passed = count(&|row| row.passed());
        let judged = rows.len() as u64 - broken;
        let progress: Vec<f64> = rows.iter().filter_map(|row| row.metric("progress")).collect();
        let mean = |name: &str| {
            let values: Vec<f64> = rows.iter().filter_map(|row| row.metric(name)).collect();
            (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
        };
        let asked = |row: &SweepRow| row.metric("pull_over_success").is_some();
        let seed_of = |best: Option<&SweepRow>| best.map(|row| row.seed);
        Self {
            scenario: rows.first().map_or(String::new(), |row| row.scenario.clone()),
            runs: rows.len() as u64,
            passed,
            broken,
            collisions: count(&|row| fails(row, "no_collision")),
            at_fault: count(&|row| fails(row, "no_at_fault_collision")),
            off_road: count(&|row| fails(row, "drivable_area")),
            progress: percentile(&progress, 50.0),
            nuplan_cls: mean("nuplan_cls"),
            ext_cls: mean("ext_cls"),
            pull_overs: PullOvers {
                asked: count(&asked),
                done: count(&|row| asked(row) && row.ending() == Some(Ending::PulledOver)),
            },
            failure_rate_bound: failure_rate_bound(judged - passed, judged, CONFIDENCE),
            rejected: rows
                .iter()
                .flat_map(|r| r.rejected.values())
                .map(|n| u64::from(*n))
                .sum(),
            worst_seed: seed_of(rows.iter().min_by(|a, b| goodness(a, b))),
            longest_seed: seed_of(
                rows.iter()
                    .max_by(|a, b| duration(a).total_cmp(&duration(b)).then(b.seed.cmp(&a.seed))),
            ),
            slowest_seed: seed_of(
                rows.iter()
                    .max_by(|a, b| a.wall_time.cmp(&b.wall_time).then(b.seed.cmp(&a.seed))),
            ),
        }
    }
}

fn duration(row: &SweepRow) -> f64 {
    row.verdict().map_or(0.0, |verdict| verdict.duration)
}

/// Failed before passed, then the smaller clearance, then the smaller seed.
fn goodness(a: &SweepRow, b: &SweepRow) -> Ordering {
    let clearance = |row: &SweepRow| row.metric("min_clearance").unwrap_or(f64::INFINITY);
    a.passed()
        .cmp(&b.passed())
        .then(clearance(a).total_cmp(&clearance(b)))
        .then(a.seed.cmp(&b.seed))
}
