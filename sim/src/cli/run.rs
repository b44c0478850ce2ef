//! `corridor run`: one scenario, one verdict.

use super::{Gate, source};
use clap::Args;
use corridor_scenarios::MapCache;
use corridor_sim::run;
use corridor_sim::settings::Settings;
use corridor_sim::verdict::Verdict;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Run {
    /// A scenario file, or the name of one in the catalog.
    scenario: String,
    /// Which scenario of a family.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write a trace to this file.
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Change a setting, as in `decider.path_bounds.obstacle_lat_buffer=0.3` or `profile=apollo`.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<String>,
}

impl Run {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        let settings = Settings::with(&self.settings)?;
        let family = source::family(&self.scenario, &MapCache::new())?;
        let drawn = family.draw(self.seed)?;
        let verdict = match &self.trace {
            Some(path) => run::run_traced(&family, &drawn.scenario, &self.settings, &settings, path)?,
            None => run::run(&drawn.scenario, &settings),
        };
        print(&verdict);
        Ok(if verdict.pass { Gate::Passed } else { Gate::Failed })
    }
}

fn print(verdict: &Verdict) {
    println!(
        "{} {}",
        if verdict.pass { "PASS" } else { "FAIL" },
        verdict.summary
    );
    for metric in &verdict.metrics {
        let value = metric.value.map_or("-".to_owned(), |value| format!("{value:.3}"));
        let threshold = metric
            .threshold
            .map_or(String::new(), |threshold| format!(" (threshold {threshold})"));
        let mark = if metric.pass {
            " "
        } else if metric.gate {
            "!"
        } else {
            "*"
        };
        let worst = metric.worst_t.map_or(String::new(), |t| format!(" at {t:.1} s"));
        let whom = metric
            .worst_obstacle
            .as_ref()
            .map_or(String::new(), |name| format!(" `{name}`"));
        println!("{mark} {:28} {value}{threshold}{worst}{whom}", metric.name);
    }
    println!("digest {}", verdict.digest);
}
