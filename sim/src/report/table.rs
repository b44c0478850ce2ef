//! The report as a table for a terminal. Everything it says it says in words; colour only repeats it.

use super::grid::Grid;
use super::{Group, ScenarioSummary, SweepReport};
use crate::sweep::statistics::{CONFIDENCE, failure_rate_bound};
use std::fmt::Write;
use std::io::IsTerminal;

/// Kinds of failures shown; more are counted. What scrolls away is not read.
const GROUPS_SHOWN: usize = 20;

/// Scenarios named in a kind of failure.
const NAMES_SHOWN: usize = 4;

const RED: &str = "\u{1b}[31m";
const GREEN: &str = "\u{1b}[32m";
const BOLD: &str = "\u{1b}[1m";
const PLAIN: &str = "\u{1b}[0m";

/// Whether to colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// With ANSI codes.
    Always,
    /// Plain text.
    Never,
}

impl Colour {
    /// Colour where standard output is a terminal and `NO_COLOR` is not set (no-color.org).
    pub fn from_env() -> Self {
        let forbidden = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        if forbidden || !std::io::stdout().is_terminal() {
            Self::Never
        } else {
            Self::Always
        }
    }

    pub(super) fn good(self, text: &str) -> String {
        self.paint(GREEN, text)
    }

    pub(super) fn bad(self, text: &str) -> String {
        self.paint(RED, text)
    }

    pub(super) fn bold(self, text: &str) -> String {
        self.paint(BOLD, text)
    }

    fn paint(self, code: &str, text: &str) -> String {
        match self {
            Self::Always => format!("{code}{text}{PLAIN}"),
            Self::Never => text.to_owned(),
        }
    }
}

/// Headings of the columns; the first is left-aligned, the others right-aligned.
const HEADINGS: [&str; 14] = [
    "scenario",
    "runs",
    "passed",
    "broken",
    "collisions",
    "at fault",
    "off road",
    "progress",
    "nuplan_cls",
    "ext_cls",
    "pulled over",
    "failures <",
    "worst seed",
    "slowest seed",
];

/// The table, the failures with the commands that repeat them, and the digest.
pub fn to_table(report: &SweepReport, colour: Colour) -> String {
    let scenarios = report.scenarios();
    let mut text = grid(&scenarios, colour);
    text.push_str(&failures(report, colour));
    text.push_str(&totals(report, colour));
    text
}

fn cells(summary: &ScenarioSummary) -> [String; 14] {
    let seed = |seed: Option<u64>| seed.map_or("-".to_owned(), |s| s.to_string());
    let score = |score: Option<f64>| score.map_or("-".to_owned(), |s| format!("{s:.3}"));
    let pull_overs = &summary.pull_overs;
    [
        summary.scenario.clone(),
        summary.runs.to_string(),
        summary.passed.to_string(),
        summary.broken.to_string(),
        summary.collisions.to_string(),
        summary.at_fault.to_string(),
        summary.off_road.to_string(),
        summary
            .progress
            .map_or("-".to_owned(), |p| format!("{:.0} %", p * 100.0)),
        score(summary.nuplan_cls),
        score(summary.ext_cls),
        if pull_overs.asked == 0 {
            "-".to_owned()
        } else {
            format!("{}/{}", pull_overs.done, pull_overs.asked)
        },
        percentage(summary.failure_rate_bound),
        seed(summary.worst_seed),
        seed(summary.slowest_seed),
    ]
}

/// A share in percent with two significant digits; a bound is rounded up.
pub(super) fn percentage(share: f64) -> String {
    let percent = share * 100.0;
    let digits = if percent >= 10.0 {
        0
    } else if percent >= 1.0 {
        1
    } else if percent >= 0.1 {
        2
    } else {
        3
    };
    let scale = [1.0, 10.0, 100.0, 1000.0][digits];
    // Rounding up must not lift what is exact but for its last bit.
    let up = (percent * scale - 1e-9).ceil() / scale;
    format!("{up:.digits$} %")
}

fn grid(scenarios: &[ScenarioSummary], colour: Colour) -> String {
    let mut grid = Grid::new(HEADINGS);
    for summary in scenarios {
        grid.row(cells(summary));
    }
    let mut lines = grid.lines();
    let mut text = lines.next().unwrap_or_default() + "\n";
    for (line, summary) in lines.zip(scenarios) {
        let code = if summary.passed == summary.runs {
            GREEN
        } else {
            RED
        };
        text.push_str(&colour.paint(code, &line));
        text.push('\n');
    }
    text
}

/// The failures by kind, each with its smallest example.
fn failures(report: &SweepReport, colour: Colour) -> String {
    let groups = report.groups();
    let mut text = String::new();
    for group in groups.iter().take(GROUPS_SHOWN) {
        let word = if group.signature.is_some() {
            "FAILED"
        } else {
            "BROKEN"
        };
        let example = &group.smallest;
        let _ = write!(
            text,
            "\n{} {} x {}\n  of {}\n  as {} seed {}: {}\n  again: {}\n",
            colour.paint(RED, word),
            group.count,
            group.kind,
            scenarios(group),
            example.scenario,
            example.seed,
            example.failure.trim_start_matches("failed: "),
            example.replay
        );
    }
    let hidden = groups.len().saturating_sub(GROUPS_SHOWN);
    if hidden > 0 {
        let _ = write!(text, "\n{hidden} more kinds of failures are in the JSON report\n");
    }
    text
}

/// The scenarios of a kind of failure, those with most of it first.
fn scenarios(group: &Group) -> String {
    let mut counts: Vec<(&String, &u64)> = group.scenarios.iter().collect();
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    let shown = counts.iter().take(NAMES_SHOWN);
    let names: Vec<String> = shown.map(|(name, count)| format!("{name} ({count})")).collect();
    let more = counts.len().saturating_sub(NAMES_SHOWN);
    if more > 0 {
        format!("{} and {more} more scenarios", names.join(", "))
    } else {
        names.join(", ")
    }
}

fn totals(report: &SweepReport, colour: Colour) -> String {
    let runs = report.runs();
    let failed = report.failures();
    let result = if failed == 0 {
        colour.paint(GREEN, &format!("all {runs} runs passed"))
    } else {
        colour.paint(RED, &format!("{failed} of {runs} runs did not pass"))
    };
    let mut text = format!("\n{result}");
    let rejected = report.rejected();
    if !rejected.is_empty() {
        let total: u64 = rejected.values().sum();
        let reasons: Vec<String> = rejected
            .iter()
            .map(|(reason, n)| format!("{n} {reason}"))
            .collect();
        let _ = write!(text, "; {total} draws rejected ({})", reasons.join(", "));
    }
    let judged = runs - report.broken();
    let bound = failure_rate_bound(failed - report.broken(), judged, CONFIDENCE);
    let _ = write!(
        text,
        "\nat 95 % confidence fewer than {} of all such runs fail; \"failures <\" is the same of one scenario\ndigest {}\n",
        percentage(bound),
        report.digest()
    );
    text
}
