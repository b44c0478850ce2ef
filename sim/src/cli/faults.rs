//! `corridor faults`: plants faults one by one and tells which of them a sweep catches.

use super::planner::PlannerChoice;
use super::{Gate, output, source};
use clap::{Args, value_parser};
use corridor_scenarios::MapCache;
use corridor_sim::faults::{self, Fault, Spec};
use corridor_sim::report::{findings_to_json, findings_to_table};
use corridor_sim::settings::Settings;
use corridor_sim::sweep::Plan;
use corridor_sim::sweep::hunt::{Finding, Hunt, hunt};
use std::path::PathBuf;

/// Most seeds for one fault: a night's work for all of them.
const MOST_SEEDS: i64 = 100_000;

/// Threads that any system can start.
const MOST_THREADS: i64 = 1024;

#[derive(Args)]
pub(crate) struct Faults {
    /// The faults to plant; all of them if none is named.
    names: Vec<String>,
    /// Tell what faults there are, and run nothing.
    #[arg(long)]
    list: bool,
    /// Scenarios to look in: files, folders, catalog names, or `catalog` for all of it; several with commas.
    #[arg(long, value_name = "SCENARIOS", value_delimiter = ',', default_value = source::CATALOG)]
    on: Vec<String>,
    /// Most seeds for each fault.
    #[arg(long, default_value_t = 120, value_parser = value_parser!(u32).range(1..=MOST_SEEDS))]
    budget: u32,
    /// The first seed.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Threads; 0: one per core. Does not change results.
    #[arg(long, default_value_t = 0, value_parser = value_parser!(u16).range(0..=MOST_THREADS))]
    jobs: u16,
    /// Most runs to make the run that shows a fault small; 0 leaves it as it is.
    #[arg(long, default_value_t = 150, value_parser = value_parser!(u32).range(0..=1_000_000), value_name = "RUNS")]
    shrink: u32,
    /// Write a JSON report.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Change a setting of all runs.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<String>,
    #[command(flatten)]
    planner: PlannerChoice,
}

impl Faults {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        let faults = self.faults()?;
        if self.list {
            output::print(&list(&faults));
            return Ok(Gate::Passed);
        }
        let overrides = self.planner.with(&self.settings);
        let settings = Settings::with(&overrides)?;
        anyhow::ensure!(
            settings.fault == Fault::NONE,
            "`fault={}`: faults are named without `--set` here",
            settings.fault.name()
        );
        if let Some(path) = &self.json {
            output::check(path)?;
        }
        let selection = source::select(&self.on, &MapCache::new())?;
        for skipped in &selection.skipped {
            output::note(&format!("skipped {skipped}"));
        }
        let plan = Plan::new(selection.families, 0, self.seed);
        let what = Hunt {
            plan: &plan,
            settings: &settings,
            overrides: &overrides,
            seed: self.seed,
            budget: self.budget as usize,
            shrink: self.shrink,
        };
        let findings = hunt(&what, &faults, usize::from(self.jobs), &mut |_| {})?;
        output::print(&findings_to_table(&findings));
        if let Some(path) = &self.json {
            output::write(path, &findings_to_json(&findings)?)?;
        }
        Ok(if findings.iter().all(Finding::holds) {
            Gate::Passed
        } else {
            Gate::Failed
        })
    }

    /// The faults that are asked for, in the order of all.
    fn faults(&self) -> anyhow::Result<Vec<&'static Spec>> {
        for name in &self.names {
            let fault = Fault::named(name)?;
            anyhow::ensure!(fault != Fault::NONE, "`none` is no fault: nothing to catch");
        }
        let is_asked =
            |fault: &&Spec| self.names.is_empty() || self.names.iter().any(|name| name == fault.name);
        Ok(faults::all().filter(is_asked).collect())
    }
}

fn list(faults: &[&Spec]) -> String {
    let line = |fault: &&Spec| {
        let Spec {
            name,
            what,
            stage,
            plant,
            ..
        } = fault;
        format!("{name:<38} {:<11} {:<15} {what}\n", stage.name(), plant.name())
    };
    faults.iter().map(line).collect()
}
