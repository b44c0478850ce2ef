//! Which planner drives: a setting with a flag of its own.

use clap::{Args, ValueEnum};

/// The setting behind the flag.
const SETTING: &str = "decider.planner";

#[derive(Args)]
pub(crate) struct PlannerChoice {
    /// The planner that drives; the same as `--set decider.planner=…`.
    #[arg(long, value_enum)]
    planner: Option<Name>,
}

/// Names of planners as settings have them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub(crate) enum Name {
    LaneFollow,
    Lattice,
    Blind,
    Idm,
    PdmClosed,
}

impl Name {
    /// As settings and the command line have it.
    pub(crate) fn text(self) -> &'static str {
        match self {
            Self::LaneFollow => "lane_follow",
            Self::Lattice => "lattice",
            Self::Blind => "blind",
            Self::Idm => "idm",
            Self::PdmClosed => "pdm_closed",
        }
    }

    /// The settings with the choice behind them, as a trace keeps them.
    pub(crate) fn with(self, settings: &[String]) -> Vec<String> {
        let choice = format!("{SETTING}={}", self.text());
        settings.iter().cloned().chain([choice]).collect()
    }
}

impl PlannerChoice {
    /// The settings with the choice behind them, if one was made.
    pub(crate) fn with(&self, settings: &[String]) -> Vec<String> {
        self.planner
            .map_or_else(|| settings.to_vec(), |name| name.with(settings))
    }
}

/// Two planners to compare, as in `lane_follow,lattice`.
pub(crate) fn pair(text: &str) -> Result<[Name; 2], String> {
    let names = text.split(',').map(|name| {
        let name = name.trim();
        Name::from_str(name, false).map_err(|_| format!("`{name}`: no such planner; there are {}", known()))
    });
    match names.collect::<Result<Vec<Name>, String>>()?[..] {
        [first, second] if first == second => {
            Err(format!("`{}` is named twice: name two planners", first.text()))
        }
        [first, second] => Ok([first, second]),
        _ => Err("two planners are wanted, as in `lane_follow,lattice`".to_owned()),
    }
}

/// The names of all planners.
fn known() -> String {
    let names = Name::value_variants()
        .iter()
        .map(|name| format!("`{}`", name.text()));
    names.collect::<Vec<String>>().join(", ")
}

/// Whether this is the setting that chooses the planner.
pub(crate) fn is_choice(setting: &str) -> bool {
    setting
        .split_once('=')
        .is_some_and(|(key, _)| key.trim() == SETTING)
}
