//! The report as JSON. Everything but `timing` is the same on every machine.

use super::{ReportError, RunResult, ScenarioSummary, SweepReport, SweepRow};
use crate::verdict::Verdict;
use serde::Serialize;
use std::collections::BTreeMap;

/// Version of this layout.
const FORMAT: u32 = 1;

#[derive(Serialize)]
struct Document<'a> {
    format: u32,
    passed: bool,
    digest: String,
    runs: usize,
    failures: usize,
    rejected: BTreeMap<&'a str, u64>,
    scenarios: Vec<ScenarioSummary>,
    rows: Vec<Row<'a>>,
    timing: Timing<'a>,
}

#[derive(Serialize)]
struct Row<'a> {
    scenario: &'a str,
    seed: u64,
    passed: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    verdict: Option<&'a Verdict>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
    rejected: &'a BTreeMap<String, u32>,
    replay: &'a str,
}

/// Wall times, s: they differ from machine to machine and from run to run.
#[derive(Serialize)]
struct Timing<'a> {
    total: f64,
    /// How long the decider took for an answer.
    cycle: CycleTiming,
    rows: Vec<(&'a str, u64, f64)>,
}

#[derive(Serialize)]
struct CycleTiming {
    count: u64,
    median: f64,
    p99: f64,
    longest: f64,
}

/// The report as JSON text with a line break at its end.
///
/// # Errors
/// [`ReportError::Json`] when the writer fails.
pub fn to_json(report: &SweepReport) -> Result<String, ReportError> {
    let seconds = |row: &SweepRow| row.wall_time.as_secs_f64();
    let cycles = report.cycles();
    let document = Document {
        format: FORMAT,
        passed: report.passed(),
        digest: report.digest(),
        runs: report.rows().len(),
        failures: report.failures().count(),
        rejected: report.rejected(),
        scenarios: report.scenarios(),
        rows: report.rows().iter().map(row).collect(),
        timing: Timing {
            total: report.wall_time().as_secs_f64(),
            cycle: CycleTiming {
                count: cycles.count(),
                median: cycles.quantile(0.5).as_secs_f64(),
                p99: cycles.quantile(0.99).as_secs_f64(),
                longest: cycles.longest().as_secs_f64(),
            },
            rows: report
                .rows()
                .iter()
                .map(|row| (row.scenario.as_str(), row.seed, seconds(row)))
                .collect(),
        },
    };
    let mut text = serde_json::to_string_pretty(&document)?;
    text.push('\n');
    Ok(text)
}

fn row(row: &SweepRow) -> Row<'_> {
    Row {
        scenario: &row.scenario,
        seed: row.seed,
        passed: row.passed(),
        verdict: row.verdict(),
        error: match &row.result {
            RunResult::Judged(_) => None,
            RunResult::Broken(reason) => Some(reason),
        },
        rejected: &row.rejected,
        replay: &row.replay,
    }
}
