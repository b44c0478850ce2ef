//! Which planner drives: a setting with a flag of its own.

use clap::{Args, ValueEnum};

#[derive(Args)]
pub(crate) struct PlannerChoice {
    /// The planner that drives; the same as `--set decider.planner=…`.
    #[arg(long, value_enum)]
    planner: Option<Name>,
}

/// Names of planners as settings have them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
enum Name {
    LaneFollow,
    Lattice,
}

impl PlannerChoice {
    /// The settings with the choice behind them, as a trace keeps them.
    pub(crate) fn with(&self, settings: &[String]) -> Vec<String> {
        let choice = self.planner.map(|name| match name {
            Name::LaneFollow => "decider.planner=lane_follow".to_owned(),
            Name::Lattice => "decider.planner=lattice".to_owned(),
        });
        settings.iter().cloned().chain(choice).collect()
    }
}
