//! `corridor sweep`: many runs, one report.

use super::planner::PlannerChoice;
use super::{Gate, output, source};
use clap::{Args, value_parser};
use corridor_scenarios::MapCache;
use corridor_sim::report::{Colour, SweepReport, to_json, to_junit, to_table};
use corridor_sim::run;
use corridor_sim::settings::Settings;
use corridor_sim::sweep::{Plan, find, sweep};
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
    /// Scenario files, folders of them, catalog names, or `catalog` for all of it.
    #[arg(required = true)]
    scenarios: Vec<String>,
    /// How many runs in all; scenarios without random numbers are run once.
    #[arg(long, default_value_t = 200, value_parser = value_parser!(u32).range(1..=MOST_RUNS))]
    count: u32,
    /// The first seed.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Threads; 0: one per core. Does not change results.
    #[arg(long, default_value_t = 0, value_parser = value_parser!(u16).range(0..=MOST_THREADS))]
    jobs: u16,
    /// Write a `JUnit` report.
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write a JSON report.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write both reports, the table and traces of failing runs into this folder.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Change a setting of all runs.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<String>,
    #[command(flatten)]
    planner: PlannerChoice,
}

impl Sweep {
    /// The settings that are not the defaults.
    fn overrides(&self) -> Vec<String> {
        self.planner.with(&self.settings)
    }

    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        let settings = Settings::with(&self.overrides())?;
        let selection = source::select(&self.scenarios, &MapCache::new())?;
        for skipped in &selection.skipped {
            output::note(&format!("skipped {skipped}"));
        }
        anyhow::ensure!(
            !selection.families.is_empty(),
            "nothing to run: every scenario was skipped"
        );
        self.check_outputs()?;
        let plan = Plan::new(selection.families, self.count as usize, self.seed);
        let bar = progress_bar(plan.jobs().len());
        let report = sweep(
            &plan,
            &settings,
            &self.overrides(),
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
        self.write(&plan, &settings, &report)?;
        Ok(if report.passed() {
            Gate::Passed
        } else {
            Gate::Failed
        })
    }

    /// What cannot be written must be known before hours of work.
    fn check_outputs(&self) -> anyhow::Result<()> {
        for path in self.json.iter().chain(&self.junit) {
            output::check(path)?;
        }
        self.out.as_deref().map_or(Ok(()), output::make_folder)
    }

    fn write(&self, plan: &Plan, settings: &Settings, report: &SweepReport) -> anyhow::Result<()> {
        if let Some(path) = &self.json {
            output::write(path, &to_json(report)?)?;
        }
        if let Some(path) = &self.junit {
            output::write(path, &to_junit(report)?)?;
        }
        let Some(folder) = &self.out else { return Ok(()) };
        output::write(&folder.join("report.json"), &to_json(report)?)?;
        output::write(&folder.join("report.xml"), &to_junit(report)?)?;
        output::write(&folder.join("report.txt"), &to_table(report, Colour::Never))?;
        self.keep_traces(folder, plan, settings, report)
    }

    /// Runs the first failures again, with traces.
    fn keep_traces(
        &self,
        folder: &Path,
        plan: &Plan,
        settings: &Settings,
        report: &SweepReport,
    ) -> anyhow::Result<()> {
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
            run::run_traced(family, &drawn.scenario, &self.overrides(), settings, &path)?;
        }
        Ok(())
    }
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
