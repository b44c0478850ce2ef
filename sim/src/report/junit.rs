//! The report as `JUnit` XML: a suite per scenario, a case per seed.
//!
//! A `failure` is a violated property, an `error` is a testbed that could not run. `time` is wall time; the command
//! that runs the case again is in `system-out`.

use super::{ReportError, RunResult, SweepReport, SweepRow};
use crate::verdict::{Metric, Verdict};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use std::fmt::Write;

/// The report as `JUnit` XML.
///
/// # Errors
/// [`ReportError::Junit`] when the writer fails.
pub fn to_junit(report: &SweepReport) -> Result<String, ReportError> {
    let mut document = Report::new("corridor");
    document.set_time(report.wall_time());
    for rows in report.rows().chunk_by(|a, b| a.scenario == b.scenario) {
        document.add_test_suite(suite(rows));
    }
    Ok(document.to_string()?)
}

fn suite(rows: &[SweepRow]) -> TestSuite {
    let mut suite = TestSuite::new(rows.first().map_or("", |row| row.scenario.as_str()));
    suite.set_time(rows.iter().map(|row| row.wall_time).sum());
    suite.add_test_cases(rows.iter().map(case));
    suite
}

fn case(row: &SweepRow) -> TestCase {
    let name = format!("{}[seed={}]", row.scenario, row.seed);
    let mut case = TestCase::new(name, status(row));
    case.set_classname(row.scenario.as_str());
    case.set_time(row.wall_time);
    case.set_system_out(row.replay.as_str());
    case.add_property(("seed", row.seed.to_string().as_str()));
    if let Some(verdict) = row.verdict() {
        case.add_property(("digest", verdict.digest.as_str()));
    }
    case
}

fn status(row: &SweepRow) -> TestCaseStatus {
    let (kind, ty, description) = match &row.result {
        RunResult::Judged(verdict) if verdict.pass => return TestCaseStatus::success(),
        RunResult::Judged(verdict) => (NonSuccessKind::Failure, failed_gate(verdict), details(verdict)),
        RunResult::Broken(reason) => (NonSuccessKind::Error, "infrastructure", reason.clone()),
    };
    let mut status = TestCaseStatus::non_success(kind);
    status
        .set_message(row.failure().unwrap_or_default())
        .set_type(ty)
        .set_description(description);
    status
}

/// Name of the first gate that failed.
fn failed_gate(verdict: &Verdict) -> &str {
    let failed = verdict.metrics.iter().find(|m| m.gate && !m.pass);
    failed.map_or("ending", |metric| metric.name.as_str())
}

/// Every metric that is not good, one a line, gates first.
fn details(verdict: &Verdict) -> String {
    let mut text = verdict.summary.clone();
    for metric in verdict.metrics.iter().filter(|m| !m.pass) {
        // Writing to a string cannot fail.
        let _ = write!(text, "\n{}", line(metric));
    }
    text
}

fn line(metric: &Metric) -> String {
    let number = |v: Option<f64>| v.map_or("-".to_owned(), |v| format!("{v:.3}"));
    let kind = if metric.gate { "gate" } else { "metric" };
    let mut text = format!(
        "{kind} {} = {} (limit {})",
        metric.name,
        number(metric.value),
        number(metric.threshold)
    );
    if let Some(t) = metric.worst_t {
        let _ = write!(text, " at {t:.2} s");
    }
    if let Some(obstacle) = &metric.worst_obstacle {
        let _ = write!(text, " with {obstacle}");
    }
    text
}
