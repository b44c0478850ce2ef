//! `corridor blame`: one run that failed, and whose fault it is.

use super::planner::PlannerChoice;
use super::{Gate, output, source};
use clap::Args;
use corridor_scenarios::MapCache;
use corridor_sim::blame::{self, Replaced};
use corridor_sim::settings::Settings;
use std::fmt::Write as _;

#[derive(Args)]
pub(crate) struct Blame {
    /// A scenario file, or the name of one in the catalog.
    scenario: String,
    /// Which scenario of a family.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Which planning problem of a `CommonRoad` file, by its number there.
    #[arg(long, value_name = "ID", conflicts_with = "seed")]
    problem: Option<i64>,
    /// Print it as JSON.
    #[arg(long)]
    json: bool,
    /// Change a setting of the run.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<String>,
    #[command(flatten)]
    planner: PlannerChoice,
}

impl Blame {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        let settings = Settings::with(&self.planner.with(&self.settings))?;
        let family = source::family(&self.scenario, &MapCache::new())?;
        let seed = match self.problem {
            Some(id) => family.seed_of_problem(id)?,
            None => self.seed,
        };
        let drawn = family.draw(seed)?;
        let blame = blame::blame(&drawn.scenario, &settings);
        let text = if self.json {
            serde_json::to_string_pretty(&blame)? + "\n"
        } else {
            blame
                .as_ref()
                .map_or("passed: nothing to blame\n".to_owned(), text)
        };
        output::print(&text);
        Ok(if blame.is_none() {
            Gate::Passed
        } else {
            Gate::Failed
        })
    }
}

/// For a terminal.
fn text(blame: &blame::Blame) -> String {
    let mut text = format!(
        "{} at {:.2} s\n{}\nwhose: {}\n",
        blame.failure, blame.time, blame.avoidable, blame.whose
    );
    for run in &blame.runs {
        let with = match run.replaced {
            Replaced::Prediction => "with the true futures",
            Replaced::Tracker => "with a perfect tracker",
            Replaced::Planner => "with the other planner",
        };
        let saves = if run.saves { "saved" } else { "not saved" };
        let _ = writeln!(text, "  {with:24} {saves:10} {}", run.summary);
    }
    text
}
