//! `corridor sweep`: many runs, one report.

mod compare;

use super::planner::{self, PlannerChoice};
use super::{Gate, output, source};
use clap::{Args, value_parser};
use corridor_scenarios::MapCache;
use corridor_sim::report::{Colour, SweepReport, to_json, to_junit, to_table};
use corridor_sim::run;
use corridor_sim::sweep::{Plan, Variant, find, sweep};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// Failing runs of which `--out` keeps a trace. One shows a cause; hundreds fill a disk.
const TRACES_KEPT: usize = 20;

/// Runs that one report still holds in memory.
const MOST_RUNS: i64 = 1_000_000;

/// Threads that any system can start.
const MOST_THREADS: i64 = 1024;

#[derive(Args)]
pub(crate) struct Sweep {
    /// Scenario files, folders of them, catalog names, `catalog` for all of it, or `hard` for its hard families.
    #[arg(required = true)]
    scenarios: Vec<String>,
    /// How many runs in all, with `--compare` of each planner; scenarios without random numbers are run once.
    #[arg(long, default_value_t = 200, value_parser = value_parser!(u32).range(1..=MOST_RUNS))]
    count: u32,
    /// The first seed.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Threads; 0: one per core. Does not change results.
    #[arg(long, default_value_t = 0, value_parser = value_parser!(u16).range(0..=MOST_THREADS))]
    jobs: u16,
    /// Write a `JUnit` report. Not of a comparison, which is no list of cases.
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write a JSON report; with `--compare`, of the comparison.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write both reports, the table and traces of failing runs into this folder; with `--compare`, the comparison, and
    /// below it a folder of these for each planner.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Change a setting of all runs.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<String>,
    #[command(flatten)]
    planner: PlannerChoice,
    /// Run the same seeds under two planners, as in `lane_follow,lattice`, and test what differs.
    ///
    /// Which is better is a question and no gate: the exit code is 1 only if either has a collision at fault or a decider
    /// that fails, or a run could not be made.
    #[arg(long, value_name = "FIRST,SECOND", value_parser = planner::pair, conflicts_with = "planner")]
    compare: Option<[planner::Name; 2]>,
}

impl Sweep {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        match self.compare {
            Some(planners) => self.compare(planners),
            None => self.sweep(),
        }
    }

    fn sweep(&self) -> anyhow::Result<Gate> {
        let variant = Variant::new("sweep", self.planner.with(&self.settings))?;
        let plan = self.plan()?;
        self.check_outputs()?;
        let bar = progress_bar(plan.jobs().len());
        let report = sweep(
            &plan,
            &variant.settings,
            &variant.overrides,
            usize::from(self.jobs),
            &|row| {
                bar.inc(1);
                if let Some(failure) = row.failure() {
                    bar.println(format!("{} seed {}: {failure}", row.scenario, row.seed));
                }
            },
        )?;
        bar.finish_and_clear();
        output::print(&to_table(&report, Colour::from_env()));
        self.write(&plan, &variant, &report)?;
        Ok(if report.passed() {
            Gate::Passed
        } else {
            Gate::Failed
        })
    }

    /// The runs to make, of the scenarios that can be run on this machine.
    fn plan(&self) -> anyhow::Result<Plan> {
        let selection = source::select(&self.scenarios, &MapCache::new())?;
        for skipped in &selection.skipped {
            output::note(&format!("skipped {skipped}"));
        }
        anyhow::ensure!(
            !selection.families.is_empty(),
            "nothing to run: every scenario was skipped"
        );
        Ok(Plan::new(selection.families, self.count as usize, self.seed))
    }

    /// What cannot be written must be known before hours of work.
    fn check_outputs(&self) -> anyhow::Result<()> {
        for path in self.json.iter().chain(&self.junit) {
            output::check(path)?;
        }
        self.out.as_deref().map_or(Ok(()), output::make_folder)
    }

    fn write(&self, plan: &Plan, variant: &Variant, report: &SweepReport) -> anyhow::Result<()> {
        if let Some(path) = &self.json {
            output::write(path, &to_json(report)?)?;
        }
        if let Some(path) = &self.junit {
            output::write(path, &to_junit(report)?)?;
        }
        match &self.out {
            Some(folder) => fill(folder, plan, variant, report),
            None => Ok(()),
        }
    }
}

/// Writes all there is to tell of a sweep into a folder.
fn fill(folder: &Path, plan: &Plan, variant: &Variant, report: &SweepReport) -> anyhow::Result<()> {
    output::write(&folder.join("report.json"), &to_json(report)?)?;
    output::write(&folder.join("report.xml"), &to_junit(report)?)?;
    output::write(&folder.join("report.txt"), &to_table(report, Colour::Never))?;
    keep_traces(folder, plan, variant, report)
}

/// Runs the first failures again, with traces.
fn keep_traces(folder: &Path, plan: &Plan, variant: &Variant, report: &SweepReport) -> anyhow::Result<()> {
    for row in report.failures().take(TRACES_KEPT) {
        let Some(Ok(drawn)) = find(plan, row).map(|family| family.draw(row.seed)) else {
            continue;
        };
        let path = folder.join(format!(
            "{}-{}.trace.zst",
            row.scenario.replace(['/', '\\'], "_"),
            row.seed
        ));
        let family = find(plan, row).expect("it was found a line ago");
        run::run_traced(
            family,
            &drawn.scenario,
            &variant.overrides,
            &variant.settings,
            &path,
        )?;
    }
    Ok(())
}

fn progress_bar(length: usize) -> ProgressBar {
    let target = if std::io::stderr().is_terminal() {
        ProgressDrawTarget::stderr()
    } else {
        ProgressDrawTarget::hidden()
    };
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} runs, {per_sec}, {eta} left")
        .expect("the template is well-formed");
    ProgressBar::with_draw_target(Some(length as u64), target).with_style(style)
}
