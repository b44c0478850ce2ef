//! `corridor run`: one scenario, one verdict.

use super::export::Export;
use super::planner::PlannerChoice;
use super::{Gate, output, source};
use clap::Args;
use corridor_scenarios::{Family, MapCache, Scenario};
use corridor_sim::report::times_to_table;
use corridor_sim::settings::Settings;
use corridor_sim::sweep::Stopwatch;
use corridor_sim::trace::Trace;
use corridor_sim::verdict::Verdict;
use corridor_sim::{run, view};
use std::path::PathBuf;

/// What a newcomer is shown: parked cars to pass and a place at the kerb between two of them.
const DEFAULT: &str = "pull_over_between_parked";

#[derive(Args)]
pub(crate) struct Run {
    /// A scenario file, or the name of one in the catalog.
    #[arg(default_value = DEFAULT)]
    scenario: String,
    /// Which scenario of a family.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Which planning problem of a `CommonRoad` file, by its number there.
    #[arg(long, value_name = "ID", conflicts_with = "seed")]
    problem: Option<i64>,
    /// Write a trace to this file.
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Write a page that shows the run to this file.
    #[arg(long, value_name = "FILE")]
    view: Option<PathBuf>,
    /// Run it once more and print how long each task of the planner takes.
    #[arg(long)]
    times: bool,
    /// Change a setting, as in `decider.path_bounds.obstacle_lat_buffer=0.3` or `profile=apollo`.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<String>,
    /// Write the scenario of this seed to a file in which no number is random any more.
    #[arg(long, value_name = "FILE")]
    fix: Option<PathBuf>,
    #[command(flatten)]
    planner: PlannerChoice,
    #[command(flatten)]
    export: Export,
}

impl Run {
    /// The settings that are not the defaults.
    fn overrides(&self) -> Vec<String> {
        self.planner.with(&self.settings)
    }

    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        let settings = Settings::with(&self.overrides())?;
        let family = source::family(&self.scenario, &MapCache::new())?;
        self.export.check(&family)?;
        let seed = match self.problem {
            Some(id) => family.seed_of_problem(id)?,
            None => self.seed,
        };
        if family.is_recorded() {
            // What a scene of other people holds is not always what one expects.
            family
                .map_warnings()
                .iter()
                .for_each(|warning| output::note(&format!("note: {warning}")));
        }
        if let Some(path) = &self.fix {
            output::write(path, &family.fixed(seed)?)?;
        }
        let drawn = family.draw(seed)?;
        let verdict = self.run(&family, &drawn.scenario, &settings)?;
        output::print(&text(&verdict));
        if let Some(page) = &self.view {
            output::print(&format!("page {}\n", page.display()));
        }
        if self.times {
            // A run of its own: writing a trace beside it would be timed too.
            let mut watch = Stopwatch::default();
            run::run_into(&drawn.scenario, &settings, &mut watch)?;
            output::print(&times_to_table(&watch));
        }
        Ok(if verdict.pass { Gate::Passed } else { Gate::Failed })
    }

    fn run(&self, family: &Family, scenario: &Scenario, settings: &Settings) -> anyhow::Result<Verdict> {
        if self.view.is_none() && !self.export.is_wanted() {
            return Ok(match &self.trace {
                Some(path) => run::run_traced(family, scenario, &self.overrides(), settings, path)?,
                None => run::run(scenario, settings),
            });
        }
        if let Some(page) = &self.view {
            anyhow::ensure!(
                self.trace.as_ref() != Some(page),
                "`--trace` and `--view` both name `{}`: give each its own file",
                page.display()
            );
            output::check(page)?;
        }
        let trace = match &self.trace {
            Some(path) => {
                run::run_traced(family, scenario, &self.overrides(), settings, path)?;
                Trace::open(path)?
            }
            None => run::run_recorded(family, scenario, &self.overrides(), settings),
        };
        if let Some(page) = &self.view {
            output::write(page, &view::page(&trace))?;
        }
        if self.export.is_wanted() {
            self.export.write(family, scenario, &trace)?;
        }
        Ok(trace.verdict.expect("a trace that was finished has a verdict"))
    }
}

/// What a run is compared with others by, in one line.
fn scores(verdict: &Verdict) -> String {
    let number = |name: &str, digits: usize| {
        let value = verdict.metric(name).and_then(|metric| metric.value);
        value.map_or("-".to_owned(), |value| format!("{value:.digits$}"))
    };
    format!(
        "  nuplan_cls {}, ext_cls {}, progress {}, collisions {}\n",
        number("nuplan_cls", 3),
        number("ext_cls", 3),
        number("progress", 3),
        number("no_collision", 0)
    )
}

/// The verdict for a terminal: gates that failed are marked `!`, other metrics beyond their threshold `*`.
fn text(verdict: &Verdict) -> String {
    let mut text = format!(
        "{} {}\n",
        if verdict.pass { "PASS" } else { "FAIL" },
        verdict.summary
    );
    text.push_str(&scores(verdict));
    for metric in &verdict.metrics {
        let value = metric.value.map_or("-".to_owned(), |value| format!("{value:.3}"));
        let threshold = metric
            .threshold
            .map_or(String::new(), |threshold| format!(" (threshold {threshold:.3})"));
        let mark = match (metric.pass, metric.gate) {
            (true, _) => ' ',
            (false, true) => '!',
            (false, false) => '*',
        };
        let worst = metric.worst_t.map_or(String::new(), |t| format!(" at {t:.1} s"));
        let whom = metric
            .worst_obstacle
            .as_ref()
            .map_or(String::new(), |name| format!(" `{name}`"));
        let name = &metric.name;
        let line = [
            mark.to_string(),
            format!(" {name:28} "),
            value,
            threshold,
            worst,
            whom,
            "\n".to_owned(),
        ];
        text.extend(line);
    }
    text + &format!("digest {}\n", verdict.digest)
}
