//! Reports on many runs: one row per run, what they add up to, and their forms for people and machines.
//!
//! A report is a pure function of its rows. Wall times are kept beside what is hashed or compared, never in it.

mod comparison;
mod coverage;
mod digest;
mod grid;
mod json;
mod junit;
mod summary;
mod table;
mod times;

pub use comparison::{Comparison, comparison_to_json, comparison_to_table};
pub use coverage::{Bins, Coverage, Decided, Situation};
pub use json::to_json;
pub use junit::to_junit;
pub use summary::{PullOvers, ScenarioSummary};
pub use table::{Colour, to_table};
pub use times::times_to_table;

use crate::sweep::CycleTimes;
use crate::verdict::{Ending, Verdict};
use std::collections::BTreeMap;
use std::time::Duration;

/// Why a report could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// The JSON writer failed.
    #[error("cannot write the report as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// The XML writer failed.
    #[error("cannot write the report as JUnit XML: {0}")]
    Junit(#[from] quick_junit::SerializeError),
}

/// One run of a sweep.
#[derive(Clone, Debug)]
pub struct SweepRow {
    /// Name of the scenario family.
    pub scenario: String,
    /// The seed that drew its numbers.
    pub seed: u64,
    /// What came of it.
    pub result: RunResult,
    /// Whether the scenario has a goal to get to.
    pub has_goal: bool,
    /// How often the drawn scenario was rejected before this one, by reason.
    pub rejected: BTreeMap<String, u32>,
    /// The command that runs it again.
    pub replay: String,
    /// How long it took on this machine. Never hashed.
    pub wall_time: Duration,
    /// How long the decider took for its answers on this machine. Never hashed.
    pub cycles: CycleTimes,
}

/// What came of a run.
#[derive(Clone, Debug)]
pub enum RunResult {
    /// It was run and judged.
    Judged(Box<Verdict>),
    /// It could not be run: the testbed is to blame, not the decider. Why.
    Broken(String),
}

impl SweepRow {
    /// The judgement, if there is one.
    pub fn verdict(&self) -> Option<&Verdict> {
        match &self.result {
            RunResult::Judged(verdict) => Some(verdict),
            RunResult::Broken(_) => None,
        }
    }

    /// Whether it was judged and passed.
    pub fn passed(&self) -> bool {
        self.verdict().is_some_and(|verdict| verdict.pass)
    }

    /// The value of a metric, if it was measured.
    pub fn metric(&self, name: &str) -> Option<f64> {
        let metrics = &self.verdict()?.metrics;
        metrics.iter().find(|metric| metric.name == name)?.value
    }

    /// Whether a metric is good enough; `None` where there is none of this name.
    fn passes(&self, name: &str) -> Option<bool> {
        let metrics = &self.verdict()?.metrics;
        Some(metrics.iter().find(|metric| metric.name == name)?.pass)
    }

    /// Why it failed, in one sentence; `None` when it passed.
    pub fn failure(&self) -> Option<&str> {
        match &self.result {
            RunResult::Judged(verdict) if verdict.pass => None,
            RunResult::Judged(verdict) => Some(&verdict.summary),
            RunResult::Broken(reason) => Some(reason),
        }
    }

    fn ending(&self) -> Option<Ending> {
        self.verdict().map(|verdict| verdict.ending)
    }
}

/// All runs of a sweep, by scenario and seed.
#[derive(Clone, Debug)]
pub struct SweepReport {
    rows: Vec<SweepRow>,
}

impl SweepReport {
    /// A report on `rows`, which may come in any order.
    pub fn new(mut rows: Vec<SweepRow>) -> Self {
        rows.sort_by(|a, b| a.scenario.cmp(&b.scenario).then(a.seed.cmp(&b.seed)));
        Self { rows }
    }

    /// The runs, by scenario and seed.
    pub fn rows(&self) -> &[SweepRow] {
        &self.rows
    }

    /// The runs that did not pass, by scenario and seed.
    pub fn failures(&self) -> impl Iterator<Item = &SweepRow> {
        self.rows.iter().filter(|row| !row.passed())
    }

    /// Whether every run was judged and passed.
    pub fn passed(&self) -> bool {
        self.failures().next().is_none()
    }

    /// What the runs of each scenario add up to.
    pub fn scenarios(&self) -> Vec<ScenarioSummary> {
        let groups = self.rows.chunk_by(|a, b| a.scenario == b.scenario);
        groups.map(ScenarioSummary::new).collect()
    }

    /// How often drawn scenarios were rejected, by reason.
    pub fn rejected(&self) -> BTreeMap<&str, u64> {
        let mut sums = BTreeMap::new();
        for (reason, count) in self.rows.iter().flat_map(|row| &row.rejected) {
            *sums.entry(reason.as_str()).or_insert(0) += u64::from(*count);
        }
        sums
    }

    /// One hash over all runs, in order of scenario and seed: equal for any number of threads and on any machine.
    pub fn digest(&self) -> String {
        digest::of(&self.rows)
    }

    /// The wall times of all answers of the decider.
    pub fn cycles(&self) -> CycleTimes {
        let mut sum = CycleTimes::default();
        self.rows.iter().for_each(|row| sum.merge(&row.cycles));
        sum
    }

    /// The sum of the runs' wall times: what one thread would have taken.
    pub fn wall_time(&self) -> Duration {
        self.rows.iter().map(|row| row.wall_time).sum()
    }
}

#[cfg(test)]
mod tests;
