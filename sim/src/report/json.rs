//! What a sweep adds up to as JSON; its rows are in the results file. Everything but `timing` is the same on every machine.

use super::{Group, ReportError, ScenarioSummary, SweepReport};
use crate::sweep::statistics::{CONFIDENCE, failure_rate_bound};
use serde::Serialize;
use std::collections::BTreeMap;

/// Version of this layout.
const FORMAT: u32 = 2;

#[derive(Serialize)]
struct Document<'a> {
    format: u32,
    passed: bool,
    digest: String,
    runs: u64,
    failures: u64,
    /// Upper bound of the failure rate at 95 %, of all judged runs.
    failure_rate_bound: f64,
    rejected: &'a BTreeMap<String, u64>,
    scenarios: Vec<ScenarioSummary>,
    /// Failures by signature.
    groups: Vec<&'a Group>,
    timing: Timing,
}

/// Wall times, s: they differ from machine to machine and from run to run.
#[derive(Serialize)]
struct Timing {
    total: f64,
    /// How long the decider took for an answer.
    cycle: CycleTiming,
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
    let cycles = report.cycles();
    let judged = report.runs() - report.broken();
    let document = Document {
        format: FORMAT,
        passed: report.passed(),
        digest: report.digest(),
        runs: report.runs(),
        failures: report.failures(),
        failure_rate_bound: failure_rate_bound(report.failures() - report.broken(), judged, CONFIDENCE),
        rejected: report.rejected(),
        scenarios: report.scenarios(),
        groups: report.groups(),
        timing: Timing {
            total: report.wall_time().as_secs_f64(),
            cycle: CycleTiming {
                count: cycles.count(),
                median: cycles.quantile(0.5).as_secs_f64(),
                p99: cycles.quantile(0.99).as_secs_f64(),
                longest: cycles.longest().as_secs_f64(),
            },
        },
    };
    let mut text = serde_json::to_string_pretty(&document)?;
    text.push('\n');
    Ok(text)
}
