//! Where the results of a sweep go, and in which forms.

use super::output;
use anyhow::Context;
use clap::Args;
use corridor_scenarios::{Drawn, Family, MapCache};
use corridor_sim::blame::blame;
use corridor_sim::report::{Colour, Csv, Group, Junit, SweepReport, Totals, to_html, to_json, to_table};
use corridor_sim::run;
use corridor_sim::shrink::{Demand, shrink};
use corridor_sim::sweep::results::Results;
use corridor_sim::sweep::{Plan, Variant};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

/// Kinds of failures of which `--out` keeps a trace. One shows a cause; hundreds fill a disk.
const TRACES_KEPT: usize = 20;

/// Runs that making a failure small may take in an inquest.
const SHRINK_RUNS: u32 = 150;

/// Files to write.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct Outputs {
    /// Append every run to this file as it ends: JSON lines, which `--resume`, `merge`, `compare` and `report` read.
    #[arg(long, value_name = "FILE")]
    results: Option<PathBuf>,
    /// Write a `JUnit` report. Not of a comparison, which is no list of cases.
    #[arg(long, value_name = "FILE")]
    pub(super) junit: Option<PathBuf>,
    /// Write a table of all runs as CSV.
    #[arg(long, value_name = "FILE")]
    pub(super) csv: Option<PathBuf>,
    /// Write a JSON report; with `--compare`, of the comparison.
    #[arg(long, value_name = "FILE")]
    pub(super) json: Option<PathBuf>,
    /// Write a page with plots, of one file.
    #[arg(long, value_name = "FILE")]
    pub(super) html: Option<PathBuf>,
    /// Write the results and all reports into this folder, and traces of failing runs; with `--compare`, the comparison,
    /// and below it a folder of these for each planner.
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Of each kind of failure, make its example small and find out whose fault it is: seconds for each.
    #[arg(long, requires = "out")]
    inquest: bool,
}

/// Where the results file is: where the user wants it, or out of the way for as long as the reports need it.
pub(crate) enum Place {
    Kept(PathBuf),
    Passing(tempfile::NamedTempFile),
}

impl Place {
    pub(crate) fn path(&self) -> &Path {
        match self {
            Self::Kept(path) => path,
            Self::Passing(file) => file.path(),
        }
    }
}

impl Outputs {
    /// All in one folder.
    pub(super) fn folder(path: PathBuf) -> Self {
        Self {
            out: Some(path),
            ..Self::default()
        }
    }

    /// What cannot be written must be known before hours of work.
    pub(super) fn check(&self) -> anyhow::Result<()> {
        for path in [&self.results, &self.junit, &self.csv, &self.json, &self.html]
            .into_iter()
            .flatten()
        {
            output::check(path)?;
        }
        self.out.as_deref().map_or(Ok(()), output::make_folder)
    }

    /// Whether the results shall be kept in a file of their own.
    pub(super) fn has_results(&self) -> bool {
        self.results.is_some()
    }

    /// Where the results go; `None` where no report needs any.
    pub(super) fn results_place(&self) -> anyhow::Result<Option<Place>> {
        if let Some(path) = &self.results {
            return Ok(Some(Place::Kept(path.clone())));
        }
        if let Some(folder) = &self.out {
            return Ok(Some(Place::Kept(folder.join("results.jsonl"))));
        }
        if self.junit.is_none() && self.csv.is_none() {
            return Ok(None);
        }
        let file = tempfile::NamedTempFile::new().context("cannot make a file for the results")?;
        Ok(Some(Place::Passing(file)))
    }

    /// Every report that is wanted, of the results at `place`, which come to `report`.
    pub(super) fn write(&self, place: &Path, report: &SweepReport) -> anyhow::Result<()> {
        self.write_json(report)?;
        let files = |given: &Option<PathBuf>, name: &str| {
            let inside = self.out.as_ref().map(|folder| folder.join(name));
            given.clone().into_iter().chain(inside).collect::<Vec<_>>()
        };
        for path in files(&self.junit, "report.xml") {
            write_junit(&path, place, report)?;
        }
        for path in files(&self.csv, "report.csv") {
            write_csv(&path, place)?;
        }
        if let Some(folder) = &self.out {
            output::write(&folder.join("report.txt"), &to_table(report, Colour::Never))?;
            output::write(&folder.join("coverage.txt"), &report.coverage().to_table())?;
        }
        Ok(())
    }

    /// The reports that need no row.
    pub(super) fn write_json(&self, report: &SweepReport) -> anyhow::Result<()> {
        let inside = |name: &str| self.out.as_ref().map(|folder| folder.join(name));
        for path in self.json.iter().chain(&inside("report.json")) {
            output::write(path, &to_json(report)?)?;
        }
        for path in self.html.iter().chain(&inside("report.html")) {
            output::write(path, &to_html(report))?;
        }
        Ok(())
    }

    /// Runs the smallest example of each kind of failure again, with a trace.
    pub(super) fn keep_failures(
        &self,
        plan: &Plan,
        variant: &Variant,
        report: &SweepReport,
    ) -> anyhow::Result<()> {
        let Some(folder) = &self.out else { return Ok(()) };
        let mut told = String::new();
        for group in report.groups().into_iter().take(TRACES_KEPT) {
            let example = &group.smallest;
            let Some(family) = plan.find(&example.scenario) else {
                continue;
            };
            let Ok(drawn) = family.draw(example.seed) else {
                continue;
            };
            let name = format!("{}-{}", example.scenario.replace(['/', '\\'], "_"), example.seed);
            let trace = folder.join(format!("{name}.trace.zst"));
            run::run_traced(
                family,
                &drawn.scenario,
                &variant.overrides,
                &variant.settings,
                &trace,
            )?;
            if self.inquest {
                told.push_str(&inquest(folder, &name, (family, &drawn), group, variant)?);
            }
        }
        if self.inquest {
            output::write(&folder.join("inquest.txt"), &told)?;
        }
        Ok(())
    }
}

/// Makes the example of a kind of failure small, and tells whose fault it is.
fn inquest(
    folder: &Path,
    name: &str,
    (family, drawn): (&Family, &Drawn),
    group: &Group,
    variant: &Variant,
) -> anyhow::Result<String> {
    let mut text = format!("{} x {}\n  {}\n", group.count, group.kind, group.smallest.replay);
    if let Some(blame) = blame(&drawn.scenario, &variant.settings) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {blame}");
    }
    let demand = Demand {
        settings: &variant.settings,
        sound: None,
        keeps_map: false,
    };
    // A recorded scene has no file that could be made small.
    if let Ok(shrunk) = shrink(
        family,
        group.smallest.seed,
        &demand,
        SHRINK_RUNS,
        &MapCache::new(),
    ) {
        let [before, after] = &shrunk.sizes;
        output::write(&folder.join(format!("{name}.toml")), &shrunk.text)?;
        let _ = writeln!(
            text,
            "  {name}.toml: {} of {} obstacles, {:.1} of {:.1} s",
            after.obstacles, before.obstacles, after.duration, before.duration
        );
    }
    Ok(text + "\n")
}

fn write_junit(path: &Path, place: &Path, report: &SweepReport) -> anyhow::Result<()> {
    let results = Results::open(place)?;
    let totals = Totals {
        runs: report.runs(),
        failures: report.failures() - report.broken(),
        errors: report.broken(),
    };
    output::write_with(path, |file| {
        let mut junit = Junit::begin(BufWriter::new(file), totals)?;
        for row in results.rows()? {
            junit.case(&row?)?;
        }
        Ok(junit
            .end()?
            .into_inner()
            .map(drop)
            .map_err(io::IntoInnerError::into_error)?)
    })
}

fn write_csv(path: &Path, place: &Path) -> anyhow::Result<()> {
    let results = Results::open(place)?;
    let mut names = BTreeSet::new();
    for row in results.rows()? {
        let row = row?;
        let measured = row
            .verdict()
            .into_iter()
            .flat_map(|verdict| verdict.metrics.keys());
        for name in measured {
            if !names.contains(name) {
                names.insert(name.clone());
            }
        }
    }
    output::write_with(path, |file| {
        let mut csv = Csv::begin(BufWriter::new(file), names)?;
        for row in results.rows()? {
            csv.row(&row?)?;
        }
        Ok(csv
            .end()
            .into_inner()
            .map(drop)
            .map_err(io::IntoInnerError::into_error)?)
    })
}
