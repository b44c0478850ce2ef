//! The hunt for planted faults as a table and as JSON: one row per fault.

use super::ReportError;
use super::grid::Grid;
use crate::faults::Spec;
use crate::sweep::hunt::{Caught, Finding, Hunted};
use serde::Serialize;

/// Version of this layout.
const FORMAT: u32 = 1;

/// What stands where there is nothing to say.
const NOTHING: &str = "-";

/// How the hunt for a fault ended, in a word or two. Caught is it by a gate; noticed by a metric that is none.
fn result(finding: &Finding) -> &'static str {
    match &finding.result {
        Hunted::Caught(_) => "caught",
        Hunted::Broken(..) => "broke the testbed",
        Hunted::Escaped if finding.noticed.is_some() => "noticed",
        Hunted::Escaped if finding.fault.unseen().is_some() => "known unseen",
        Hunted::Escaped if finding.seeds == 0 => "no seed suits",
        Hunted::Escaped if finding.changed == 0 => "without effect",
        Hunted::Escaped => "slipped through",
    }
}

/// A row per fault, what there is to say of those that were not caught, and how many there were.
pub fn findings_to_table(findings: &[Finding]) -> String {
    let mut grid = Grid::new([
        "fault",
        "stage",
        "planted on",
        "result",
        "metric",
        "ending",
        "scenario",
        "seed",
        "seeds",
        "changed",
        "obstacles",
        "seconds",
    ]);
    for finding in findings {
        grid.row(cells(finding));
    }
    let mut text = String::new();
    for line in grid.lines() {
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text.push('\n');
    for finding in findings.iter().filter(|finding| result(finding) != "caught") {
        text.push_str(&remark(finding));
        text.push('\n');
    }
    text.push_str(&sum(findings));
    text.push('\n');
    text
}

fn cells(finding: &Finding) -> [String; 12] {
    let Spec {
        name, stage, plant, ..
    } = finding.fault;
    let caught = caught(finding);
    let told = |of: &dyn Fn(&Caught) -> String| caught.map_or_else(|| NOTHING.to_owned(), of);
    let shrunk = finding.shrunk;
    [
        (*name).to_owned(),
        stage.name().to_owned(),
        plant.name().to_owned(),
        result(finding).to_owned(),
        told(&|caught| caught.metric.clone()),
        told(&ending),
        told(&|caught| caught.scenario.clone()),
        told(&|caught| caught.seed.to_string()),
        finding.seeds.to_string(),
        finding.changed.to_string(),
        shrunk.map_or_else(|| NOTHING.to_owned(), |shrunk| shrunk.obstacles.to_string()),
        shrunk.map_or_else(|| NOTHING.to_owned(), |shrunk| format!("{:.1}", shrunk.seconds)),
    ]
}

fn caught(finding: &Finding) -> Option<&Caught> {
    match &finding.result {
        Hunted::Caught(caught) => Some(caught),
        Hunted::Broken(..) | Hunted::Escaped => finding.noticed.as_deref(),
    }
}

/// The name of an ending, as the verdict has it.
fn ending(caught: &Caught) -> String {
    let name = serde_json::to_value(caught.ending).ok();
    name.as_ref()
        .and_then(|name| name.as_str())
        .unwrap_or(NOTHING)
        .to_owned()
}

fn remark(finding: &Finding) -> String {
    let fault = finding.fault;
    let head = format!("{}: {}. {}", fault.name, result(finding), fault.what);
    match (&finding.result, fault.unseen()) {
        (Hunted::Broken(replay, reason), _) => format!("{head} {reason}: {replay}"),
        (Hunted::Escaped, Some(reason)) => format!("{head} {reason}"),
        _ => head,
    }
}

fn sum(findings: &[Finding]) -> String {
    let count = |what: &str| findings.iter().filter(|finding| result(finding) == what).count();
    let kinds = [
        "caught",
        "noticed",
        "slipped through",
        "without effect",
        "no seed suits",
        "broke the testbed",
        "known unseen",
    ];
    let counts = kinds.map(|kind| (kind, count(kind)));
    let told: Vec<String> = counts
        .into_iter()
        .filter(|(kind, count)| *count > 0 || *kind == "caught")
        .map(|(kind, count)| format!("{count} {kind}"))
        .collect();
    format!("{} faults: {}", findings.len(), told.join(", "))
}

#[derive(Serialize)]
struct Document<'a> {
    format: u32,
    passed: bool,
    faults: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct Row<'a> {
    name: &'a str,
    what: &'a str,
    stage: &'a str,
    planted_on: &'a str,
    result: &'a str,
    holds: bool,
    gate: Option<&'a str>,
    ending: Option<String>,
    summary: Option<&'a str>,
    scenario: Option<&'a str>,
    seed: Option<u64>,
    replay: Option<&'a str>,
    error: Option<&'a str>,
    unseen: Option<&'a str>,
    seeds: usize,
    unfit: usize,
    changed: usize,
    obstacles: Option<usize>,
    seconds: Option<f64>,
}

/// The findings as JSON text with a line break at its end.
///
/// # Errors
/// [`ReportError::Json`] when the writer fails.
pub fn findings_to_json(findings: &[Finding]) -> Result<String, ReportError> {
    let document = Document {
        format: FORMAT,
        passed: findings.iter().all(Finding::holds),
        faults: findings.iter().map(row).collect(),
    };
    let mut text = serde_json::to_string_pretty(&document)?;
    text.push('\n');
    Ok(text)
}

fn row(finding: &Finding) -> Row<'_> {
    let fault = finding.fault;
    let caught = caught(finding);
    let (replay, error) = match &finding.result {
        Hunted::Broken(replay, reason) => (Some(replay.as_str()), Some(reason.as_str())),
        _ => (caught.map(|caught| caught.replay.as_str()), None),
    };
    Row {
        name: fault.name,
        what: fault.what,
        stage: fault.stage.name(),
        planted_on: fault.plant.name(),
        result: result(finding),
        holds: finding.holds(),
        gate: caught.map(|caught| caught.metric.as_str()),
        ending: caught.map(ending),
        summary: caught.map(|caught| caught.summary.as_str()),
        scenario: caught.map(|caught| caught.scenario.as_str()),
        seed: caught.map(|caught| caught.seed),
        replay,
        error,
        unseen: fault.unseen(),
        seeds: finding.seeds,
        unfit: finding.unfit,
        changed: finding.changed,
        obstacles: finding.shrunk.map(|shrunk| shrunk.obstacles),
        seconds: finding.shrunk.map(|shrunk| shrunk.seconds),
    }
}
