//! `corridor merge`, `corridor report` and `corridor compare`: what is done with results files.

use super::outputs::Outputs;
use super::{Gate, output};
use clap::Args;
use corridor_sim::report::{
    Colour, Comparison, SweepReport, comparison_to_json, comparison_to_table, to_table,
};
use corridor_sim::sweep::SweepRow;
use corridor_sim::sweep::results::{Results, merge};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

#[derive(Args)]
pub(crate) struct Merge {
    /// The results file to write.
    out: PathBuf,
    /// The results files of all parts of one sweep, in any order.
    #[arg(required = true)]
    parts: Vec<PathBuf>,
}

impl Merge {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        output::check(&self.out)?;
        let report = merge(&self.out, &self.parts)?;
        output::print(&to_table(&report, Colour::from_env()));
        Ok(gate(&report))
    }
}

#[derive(Args)]
pub(crate) struct Report {
    /// A finished results file.
    file: PathBuf,
    #[command(flatten)]
    outputs: Outputs,
}

impl Report {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        anyhow::ensure!(
            !self.outputs.has_results(),
            "`--results` is what this command reads: `corridor report FILE`"
        );
        self.outputs.check()?;
        let results = Results::open(&self.file)?;
        output::print(&to_table(results.report(), Colour::from_env()));
        self.outputs.write(&self.file, results.report())?;
        Ok(gate(results.report()))
    }
}

fn gate(report: &SweepReport) -> Gate {
    if report.passed() {
        Gate::Passed
    } else {
        Gate::Failed
    }
}

#[derive(Args)]
pub(crate) struct Compare {
    /// The results of one sweep.
    first: PathBuf,
    /// The results of another, of the same scenarios and seeds.
    second: PathBuf,
    /// Write the comparison as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

impl Compare {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        self.json.as_deref().map_or(Ok(()), output::check)?;
        let (first, second) = (Results::open(&self.first)?, Results::open(&self.second)?);
        let (pairs, alone) = pairs(&first, &second)?;
        anyhow::ensure!(
            !pairs.is_empty(),
            "the two sweeps have no scenario and seed in common"
        );
        if first.header().content != second.header().content {
            output::note(
                "the two sweeps read different scenarios or maps: of the same name and seed they may not be the same scene",
            );
        }
        if alone > 0 {
            output::note(&format!(
                "{alone} runs are left out: the other sweep has no such scenario and seed"
            ));
        }
        let comparison = Comparison::new(names(&self.first, &self.second), pairs);
        if let Some(path) = &self.json {
            output::write(path, &comparison_to_json(&comparison)?)?;
        }
        output::print(&comparison_to_table(&comparison, Colour::from_env()));
        Ok(if comparison.is_safe() {
            Gate::Passed
        } else {
            Gate::Failed
        })
    }
}

/// The rows of the same scenario and seed, and how many are alone.
fn pairs(first: &Results, second: &Results) -> anyhow::Result<(Vec<[SweepRow; 2]>, usize)> {
    let mut waiting = BTreeMap::new();
    for row in first.rows()? {
        let row = row?;
        waiting.insert((row.scenario.clone(), row.seed), row);
    }
    let (mut pairs, mut alone) = (Vec::new(), 0);
    for row in second.rows()? {
        let row = row?;
        match waiting.remove(&(row.scenario.clone(), row.seed)) {
            Some(partner) => pairs.push([partner, row]),
            None => alone += 1,
        }
    }
    Ok((pairs, alone + waiting.len()))
}

/// What tells the two files apart: their names, or where these are the same, their paths.
fn names(first: &Path, second: &Path) -> [String; 2] {
    let stem = |path: &Path| path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let whole = |path: &Path| path.display().to_string();
    match (stem(first), stem(second)) {
        (Some(a), Some(b)) if a != b => [a, b],
        _ => [whole(first), whole(second)],
    }
}
