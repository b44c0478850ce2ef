//! `corridor shrink`: a failing run made small.

use super::planner::PlannerChoice;
use super::{Gate, output, source};
use anyhow::Context;
use clap::{Args, value_parser};
use corridor_scenarios::{Family, MapCache};
use corridor_sim::settings::Settings;
use corridor_sim::shrink::{Demand, Shrunk, Size, shrink};
use corridor_sim::trace::Trace;
use std::path::{Path, PathBuf};

#[derive(Args)]
pub(crate) struct Shrink {
    /// A scenario file, a name in the catalog, or the trace of a failed run.
    scenario: String,
    /// The seed that fails; that of the trace.
    #[arg(long)]
    seed: Option<u64>,
    /// How many runs it may take. More make it smaller, never larger.
    #[arg(long, default_value_t = 300, value_parser = value_parser!(u32).range(1..=1_000_000))]
    budget: u32,
    /// Keep it a run that passes without this setting, given to it by `--set`: what fails must be the setting's doing.
    #[arg(long, value_name = "KEY")]
    blames: Option<String>,
    /// Where to put the small scenario; standard output when absent. Those in `scenarios/regressions` run first in every
    /// sweep of the catalog.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Change a setting.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<String>,
    #[command(flatten)]
    planner: PlannerChoice,
}

/// What is to be shrunk.
struct Failed {
    family: Family,
    seed: u64,
    maps: MapCache,
    overrides: Vec<String>,
    /// Whether the map is only in the trace: no other can take its place.
    keeps_map: bool,
}

impl Shrink {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        self.output.as_deref().map_or(Ok(()), output::check)?;
        let failed = self.failed()?;
        let settings = Settings::with(&failed.overrides)?;
        let sound = self.sound(&failed.overrides)?;
        let demand = Demand {
            settings: &settings,
            sound: sound.as_ref(),
            keeps_map: failed.keeps_map,
        };
        let shrunk = shrink(&failed.family, failed.seed, &demand, self.budget, &failed.maps)?;
        let text = format!("{}\n{}", Self::head(&failed, &shrunk), shrunk.text);
        match &self.output {
            Some(path) => output::write(path, &text)?,
            None => output::print(&text),
        }
        output::note(&told(&shrunk));
        Ok(Gate::Passed)
    }

    fn failed(&self) -> anyhow::Result<Failed> {
        let path = Path::new(&self.scenario);
        let given = self.planner.with(&self.settings);
        if path.extension().is_none_or(|extension| extension != "zst") {
            let maps = MapCache::new();
            return Ok(Failed {
                family: source::family(&self.scenario, &maps)?,
                seed: self.seed.unwrap_or(1),
                maps,
                overrides: given,
                keeps_map: false,
            });
        }
        let header = Trace::open(path)?.header;
        let broken = || format!("`{}`: the map in the trace", path.display());
        let maps = MapCache::holding(&header.map)
            .map_err(anyhow::Error::msg)
            .with_context(broken)?;
        let name = format!("{}.toml", header.scenario);
        Ok(Failed {
            family: Family::parse_with(&header.source, &name, Path::new(""), &maps)?,
            seed: self.seed.unwrap_or(header.seed),
            maps,
            overrides: [header.overrides, given].concat(),
            keeps_map: true,
        })
    }

    /// The settings without the one that is blamed.
    fn sound(&self, overrides: &[String]) -> anyhow::Result<Option<Settings>> {
        let Some(key) = &self.blames else { return Ok(None) };
        let is_other = |setting: &&String| setting.split_once('=').is_none_or(|(name, _)| name.trim() != key);
        let others: Vec<String> = overrides.iter().filter(is_other).cloned().collect();
        anyhow::ensure!(
            others.len() < overrides.len(),
            "`--blames {key}`: no such setting is made by `--set`"
        );
        Ok(Some(Settings::with(&others)?))
    }

    /// Where the small scenario comes from, as comments.
    fn head(failed: &Failed, shrunk: &Shrunk) -> String {
        let settings: Vec<String> = failed
            .overrides
            .iter()
            .map(|setting| format!(" --set {setting}"))
            .collect();
        let settings = settings.concat();
        format!(
            "# Shrunk from seed {} of {}.\n# Fails by: {}\n# Run with: corridor run FILE{settings}",
            failed.seed,
            failed.family.name(),
            shrunk.signature
        )
    }
}

fn told(shrunk: &Shrunk) -> String {
    let size = |size: &Size| {
        format!(
            "{} obstacles, {:.1} s, {} digits",
            size.obstacles, size.duration, size.digits
        )
    };
    let [before, after] = &shrunk.sizes;
    format!(
        "{} -> {}, in {} runs; fails by: {}",
        size(before),
        size(after),
        shrunk.runs,
        shrunk.signature
    )
}
