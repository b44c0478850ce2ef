//! The comparison as tables for a terminal, with the seeds to look at. Everything it says it says in words; colour only
//! repeats it.

use super::super::grid::Grid;
use super::super::{Colour, SweepReport};
use super::outcomes::OutcomeRow;
use super::quantities::QuantityRow;
use super::{ALPHA, Comparison, Harm, Test, harm, is_judged};
use crate::sweep::bootstrap::Mean;
use std::fmt::Write;

/// Pairs listed that only one passes; more are counted. What scrolls away is not read.
const PAIRS_SHOWN: usize = 10;

/// Stands where there is nothing to say.
const NOTHING: &str = "-";

/// What was compared, the tables, the seeds on which only one passes, what was unsafe, and the digests.
pub fn comparison_to_table(comparison: &Comparison, colour: Colour) -> String {
    let reports = &comparison.reports;
    let mut text = head(comparison, &reports[0]);
    text.push_str(&outcomes(comparison, colour));
    text.push_str(&quantities(comparison, colour));
    text.push_str(&scores(comparison));
    text.push_str(&legend(comparison));
    text.push_str(&scenarios(comparison));
    text.push_str(&passed_by_only(comparison, 0, colour));
    text.push_str(&passed_by_only(comparison, 1, colour));
    text.push_str(&safety(comparison, colour));
    for (name, report) in comparison.names.iter().zip(reports) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "digest {name} {}", report.digest());
    }
    text
}

fn head(comparison: &Comparison, first: &SweepReport) -> String {
    let [a, b] = &comparison.names;
    let pairs = first.runs();
    let scenarios = comparison.scenarios().len();
    let mut text = format!("{a} and {b} on the same {pairs} seeds of {scenarios} scenarios");
    let broken = comparison.pairs().filter(|pair| !is_judged(pair)).count();
    if broken > 0 {
        let _ = write!(text, "; {broken} left out: a run could not be made");
    }
    let rejected = first.rejected();
    if !rejected.is_empty() {
        let total: u64 = rejected.values().sum();
        let reasons = rejected.iter().map(|(reason, n)| format!("{n} {reason}"));
        let reasons: Vec<String> = reasons.collect();
        let _ = write!(text, "; {total} draws rejected for both ({})", reasons.join(", "));
    }
    text + "\n\n"
}

fn outcomes(comparison: &Comparison, colour: Colour) -> String {
    let [a, b] = &comparison.names;
    let mut grid = Grid::new([
        "outcome".to_owned(),
        "pairs".to_owned(),
        "both".to_owned(),
        format!("only {a}"),
        format!("only {b}"),
        "neither".to_owned(),
        "p".to_owned(),
        "p Holm".to_owned(),
    ]);
    for OutcomeRow { name, counts, test } in &comparison.outcomes {
        grid.row([
            (*name).to_owned(),
            counts.pairs().to_string(),
            counts.both.to_string(),
            counts.only_first.to_string(),
            counts.only_second.to_string(),
            counts.neither.to_string(),
            probability(test.p),
            probability(test.p_holm),
        ]);
    }
    marked(&grid, comparison.outcomes.iter().map(|row| row.test), colour)
}

fn quantities(comparison: &Comparison, colour: Colour) -> String {
    let [a, b] = &comparison.names;
    let mut grid = Grid::new([
        "metric (median)".to_owned(),
        "pairs".to_owned(),
        a.clone(),
        b.clone(),
        "better".to_owned(),
        "difference".to_owned(),
        "95 % range".to_owned(),
        "p".to_owned(),
        "p Holm".to_owned(),
    ]);
    for row in &comparison.quantities {
        grid.row(cells(row));
    }
    marked(&grid, comparison.quantities.iter().map(|row| row.test), colour)
}

fn scores(comparison: &Comparison) -> String {
    let [a, b] = &comparison.names;
    let headings = ["score (mean)", "pairs", a, b, "difference", "95 % range"];
    let mut grid = Grid::new(headings);
    for row in &comparison.scores {
        let Mean { value, low, high } = row.difference;
        grid.row([
            row.name.to_owned(),
            row.pairs.to_string(),
            number(row.means[0]),
            number(row.means[1]),
            signed(value),
            format!("{} to {}", signed(low), signed(high)),
        ]);
    }
    let lines: Vec<String> = grid.lines().collect();
    if lines.len() < 2 {
        return String::new();
    }
    format!("\n{}\n", lines.join("\n"))
}

fn cells(row: &QuantityRow) -> [String; 9] {
    let name = match row.unit {
        "" => row.name.to_owned(),
        unit => format!("{}, {unit}", row.name),
    };
    let range = row.difference.range;
    [
        name,
        row.pairs.to_string(),
        number(row.medians[0]),
        number(row.medians[1]),
        format!("{} : {}", row.first_better, row.second_better),
        signed(row.difference.value),
        range.map_or(NOTHING.to_owned(), |(low, high)| {
            format!("{} to {}", signed(low), signed(high))
        }),
        probability(row.test.p),
        probability(row.test.p_holm),
    ]
}

/// The lines of a grid, those whose test is significant marked `*`.
fn marked<const N: usize>(grid: &Grid<N>, tests: impl Iterator<Item = Test>, colour: Colour) -> String {
    let mut lines = grid.lines();
    let mut text = lines.next().unwrap_or_default() + "\n";
    for (line, test) in lines.zip(tests) {
        if test.significant {
            text.push_str(&colour.bold(&format!("{line} *")));
        } else {
            text.push_str(&line);
        }
        text.push('\n');
    }
    text + "\n"
}

fn number(value: f64) -> String {
    format!("{value:.3}")
}

/// With its sign, and 0 without one.
fn signed(value: f64) -> String {
    let text = format!("{value:+.3}");
    match text.trim_start_matches(['+', '-']) {
        "0.000" => "0.000".to_owned(),
        _ => text,
    }
}

fn probability(p: f64) -> String {
    if p >= 0.001 {
        format!("{p:.3}")
    } else {
        format!("{p:.0e}")
    }
}

fn legend(comparison: &Comparison) -> String {
    let [a, b] = &comparison.names;
    format!(
        "* significant at {ALPHA} after Holm's correction for {} tests. p: McNemar's exact test of the pairs that differ;\n  \
         Wilcoxon's signed ranks, equal pairs left out. better: pairs in which {a} : {b} is better.\n  \
         difference: median over pairs of {b} minus {a}, with the range of the true one at 95 % confidence.\n  \
         A metric counts where both runs measured it. All this speaks of more seeds of these scenarios, not of others.\n",
        comparison.tests()
    )
}

/// The scenarios of which a run passed under one only.
fn scenarios(comparison: &Comparison) -> String {
    let [a, b] = &comparison.names;
    let mut grid = Grid::new([
        "passed, by scenario".to_owned(),
        "pairs".to_owned(),
        "both".to_owned(),
        format!("only {a}"),
        format!("only {b}"),
        "neither".to_owned(),
    ]);
    let differing = comparison
        .scenarios()
        .into_iter()
        .filter(|(_, passed)| passed.only_first + passed.only_second > 0);
    let mut found = false;
    for (scenario, passed) in differing {
        found = true;
        grid.row([
            scenario.to_owned(),
            passed.pairs().to_string(),
            passed.both.to_string(),
            passed.only_first.to_string(),
            passed.only_second.to_string(),
            passed.neither.to_string(),
        ]);
    }
    if !found {
        return format!("\nno seed passes under {a} or {b} alone\n");
    }
    grid.lines()
        .fold("\n".to_owned(), |text, line| text + &line + "\n")
}

/// The seeds that only one passes: the worst of the other first, each with the command that runs it.
fn passed_by_only(comparison: &Comparison, side: usize, colour: Colour) -> String {
    let pairs = comparison.passed_by_only(side);
    let (name, other) = (&comparison.names[side], &comparison.names[1 - side]);
    if pairs.is_empty() {
        return String::new();
    }
    let mut text = format!("\n{} seeds pass under {name} and not under {other}", pairs.len());
    if pairs.len() > PAIRS_SHOWN {
        let _ = write!(text, "; {PAIRS_SHOWN} of them, the worst first");
    }
    text.push_str(":\n");
    for pair in pairs.into_iter().take(PAIRS_SHOWN) {
        let failed = pair[1 - side];
        let _ = write!(
            text,
            "{} {} seed {}: {}\n  again: {}\n",
            colour.bad("FAILED"),
            failed.scenario,
            failed.seed,
            failed
                .failure()
                .unwrap_or_default()
                .trim_start_matches("failed: "),
            failed.replay
        );
    }
    text
}

/// What fails a comparison.
fn safety(comparison: &Comparison, colour: Colour) -> String {
    if comparison.is_safe() {
        let text = "no collision at fault, no failed decider, no run that could not be made";
        return format!("\n{}\n", colour.good(text));
    }
    let mut text = "\n".to_owned();
    for (side, name) in comparison.names.iter().enumerate() {
        let count = |kind: Harm| comparison.rows(side).filter(|row| harm(row) == kind).count();
        let line = format!(
            "{name}: collisions at fault {}, failed deciders {}, runs that could not be made {}",
            count(Harm::AtFault),
            count(Harm::DeciderFailed),
            count(Harm::Broken)
        );
        text.push_str(&colour.bad(&line));
        text.push('\n');
    }
    text
}
