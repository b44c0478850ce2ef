//! `corridor search`: looks for failures of a family.

use super::planner::PlannerChoice;
use super::{Gate, output, source};
use clap::{Args, value_parser};
use corridor_scenarios::MapCache;
use corridor_sim::search::{Found, Method, Search as Looking};
use corridor_sim::settings::Settings;
use corridor_sim::sweep::statistics::percentile;
use std::fmt::Write;
use std::path::PathBuf;

/// Threads that any system can start.
const MOST_THREADS: i64 = 1024;

#[derive(Args)]
pub(crate) struct Search {
    /// A scenario file with laws in it, or a name in the catalog.
    scenario: String,
    /// Most runs.
    #[arg(long, default_value_t = 200, value_parser = value_parser!(u32).range(1..=1_000_000))]
    budget: u32,
    /// Where the random numbers begin.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Threads; 0: one per core. Does not change results.
    #[arg(long, default_value_t = 0, value_parser = value_parser!(u16).range(0..=MOST_THREADS))]
    jobs: u16,
    /// Hold the search against random draws: this many times each, with seeds of their own, until the first failure.
    #[arg(long, value_name = "TIMES", value_parser = value_parser!(u16).range(1..=1000))]
    against_random: Option<u16>,
    /// Where to put the worst scenario that was found, with fixed numbers.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Change a setting.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<String>,
    #[command(flatten)]
    planner: PlannerChoice,
}

impl Search {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        self.output.as_deref().map_or(Ok(()), output::check)?;
        let settings = Settings::with(&self.planner.with(&self.settings))?;
        let family = source::family(&self.scenario, &MapCache::new())?;
        anyhow::ensure!(
            !family.is_fixed(),
            "`{}` draws no number: there is nothing to search in",
            self.scenario
        );
        let search = Looking {
            family: &family,
            settings: &settings,
            method: Method::CrossEntropy,
            budget: self.budget,
            seed: self.seed,
            until_found: false,
        };
        if let Some(times) = self.against_random {
            output::print(&self.duel(&search, times)?);
            return Ok(Gate::Passed);
        }
        let found = search.look(usize::from(self.jobs))?;
        output::print(&told(&found));
        if let (Some(path), Some(worst)) = (&self.output, &found.worst) {
            output::write(path, &family.fixed_at(self.seed, &worst.quantiles)?)?;
        }
        Ok(if found.failures == 0 {
            Gate::Passed
        } else {
            Gate::Failed
        })
    }

    /// How many runs both take to the first failure, pair by pair.
    fn duel(&self, search: &Looking, times: u16) -> anyhow::Result<String> {
        let mut text = String::new();
        let mut medians = Vec::new();
        for (name, method) in [("search", Method::CrossEntropy), ("random", Method::Random)] {
            let mut runs = Vec::new();
            let mut hits = 0;
            for k in 0..u64::from(times) {
                let one = Looking {
                    method,
                    seed: self.seed.wrapping_add(k),
                    until_found: true,
                    ..search.clone()
                };
                let found = one.look(usize::from(self.jobs))?;
                hits += u16::from(found.first_failure.is_some());
                runs.push(f64::from(found.first_failure.unwrap_or(self.budget)));
            }
            let median = percentile(&runs, 50.0).unwrap_or_default();
            medians.push(median);
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{name}: found in {hits} of {times} tries of at most {} runs; first failure after {median:.0} runs (median)",
                self.budget
            );
        }
        let _ = writeln!(
            text,
            "random takes {:.1} times as many runs",
            medians[1] / medians[0].max(1.0)
        );
        Ok(text)
    }
}

fn told(found: &Found) -> String {
    let mut text = format!(
        "{} runs, {} failures, {} places that make no possible scenario\n",
        found.runs, found.failures, found.impossible
    );
    if let Some(first) = found.first_failure {
        let _ = writeln!(text, "the first failure came with run {first}");
    }
    if let Some(worst) = &found.worst
        && let Some(verdict) = &worst.verdict
    {
        let _ = writeln!(text, "worst, margin {:.3}: {}", worst.margin, verdict.summary);
        for (key, quantile) in &worst.quantiles {
            let _ = writeln!(text, "  {key} at {:.1} % of its law", quantile * 100.0);
        }
    }
    text
}
