//! Reports on many runs: what their rows add up to, in forms for people and machines.
//!
//! A report takes its rows in one after the other and keeps none: it is as large after a million as after a hundred. It
//! is a pure function of them in any order; wall times are kept beside what is hashed or compared, never in it.

mod comparison;
mod coverage;
mod csv;
mod digest;
mod faults;
mod grid;
mod groups;
mod histogram;
mod html;
mod json;
mod junit;
mod shares;
mod summary;
mod table;
mod times;

pub use comparison::{Comparison, comparison_to_json, comparison_to_table};
pub use coverage::{Bins, Coverage, Decided, Situation};
pub use csv::Csv;
pub use faults::{findings_to_json, findings_to_table};
pub use groups::{Example, Group};
pub use html::to_html;
pub use json::to_json;
pub use junit::{Junit, Totals};
pub use summary::{PullOvers, ScenarioSummary};
pub use table::{Colour, to_table};
pub use times::times_to_table;

use crate::sweep::{CycleTimes, SweepRow};
use digest::Digest;
use groups::Groups;
use histogram::{Histogram, Histograms};
use std::collections::BTreeMap;
use std::time::Duration;
use summary::Sums;

/// Why a report could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// The JSON writer failed.
    #[error("cannot write the report as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

/// What the rows of a sweep add up to.
#[derive(Clone, Debug, Default)]
pub struct SweepReport {
    scenarios: BTreeMap<String, Sums>,
    rejected: BTreeMap<String, u64>,
    groups: Groups,
    histograms: Histograms,
    coverage: Coverage,
    digest: Digest,
    cycles: CycleTimes,
    wall_time: Duration,
}

impl SweepReport {
    /// Takes in one more row.
    pub fn add(&mut self, row: &SweepRow) {
        self.scenarios.entry(row.scenario.clone()).or_default().add(row);
        for (reason, count) in &row.rejected {
            *self.rejected.entry(reason.clone()).or_insert(0) += u64::from(*count);
        }
        self.groups.add(row);
        self.histograms.add(row);
        if let Some(tried) = &row.tried {
            self.coverage
                .add(&row.scenario, &tried.parameters, &tried.situation, &tried.decided);
        }
        self.digest.add(row);
        self.cycles.merge(&row.cycles);
        self.wall_time += row.wall_time;
    }

    /// How many runs there were.
    pub fn runs(&self) -> u64 {
        self.scenarios.values().map(|sums| sums.runs).sum()
    }

    /// How many of them did not pass.
    pub fn failures(&self) -> u64 {
        self.scenarios.values().map(|sums| sums.runs - sums.passed).sum()
    }

    /// How many could not be judged.
    pub fn broken(&self) -> u64 {
        self.scenarios.values().map(|sums| sums.broken).sum()
    }

    /// Whether every run was judged and passed.
    pub fn passed(&self) -> bool {
        self.failures() == 0
    }

    /// What the runs of each scenario add up to.
    pub fn scenarios(&self) -> Vec<ScenarioSummary> {
        let summary = |(name, sums): (&String, &Sums)| sums.summary(name);
        self.scenarios.iter().map(summary).collect()
    }

    /// The failures by what kind of failure they are: the most frequent first.
    pub fn groups(&self) -> Vec<&Group> {
        self.groups.by_count()
    }

    /// What was tried, and what was not.
    pub fn coverage(&self) -> &Coverage {
        &self.coverage
    }

    fn histograms(&self) -> impl Iterator<Item = &Histogram> {
        self.histograms.filled()
    }

    /// How often drawn scenarios were rejected, by reason.
    pub fn rejected(&self) -> &BTreeMap<String, u64> {
        &self.rejected
    }

    /// One hash over all runs, whatever their order: equal for any number of threads and on any machine.
    pub fn digest(&self) -> String {
        self.digest.to_string()
    }

    /// The wall times of all answers of the decider.
    pub fn cycles(&self) -> &CycleTimes {
        &self.cycles
    }

    /// The sum of the runs' wall times: what one thread would have taken.
    pub fn wall_time(&self) -> Duration {
        self.wall_time
    }
}

impl<'a> FromIterator<&'a SweepRow> for SweepReport {
    fn from_iter<I: IntoIterator<Item = &'a SweepRow>>(rows: I) -> Self {
        let mut report = Self::default();
        rows.into_iter().for_each(|row| report.add(row));
        report
    }
}

#[cfg(test)]
mod tests;
