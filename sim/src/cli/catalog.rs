//! `corridor list` and `corridor validate`.

use super::{Gate, message, output, source};
use clap::Args;
use corridor_scenarios::{Family, MapCache, ScenarioError, catalog};
use std::path::Path;

/// Seeds that `validate` draws of a family.
const SEEDS_DRAWN: u64 = 20;

#[derive(Args)]
pub(crate) struct List {}

impl List {
    #[expect(clippy::unused_self, reason = "all verbs are executed alike")]
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        let maps = MapCache::new();
        let entries = || catalog::REGRESSIONS.iter().chain(catalog::ENTRIES);
        let width = entries().map(|entry| entry.name.len()).max().unwrap_or(0);
        for entry in entries() {
            match entry.load(&maps) {
                Ok(family) => {
                    let kind = match (entry.is_regression, family.is_fixed(), entry.is_hard) {
                        (true, ..) => "kept    ",
                        (false, true, _) => "scenario",
                        (false, false, false) => "family  ",
                        (false, false, true) => "hard    ",
                    };
                    output::print(&format!(
                        "{:width$}  {kind}  {}\n",
                        entry.name,
                        family.description()
                    ));
                }
                Err(ScenarioError::SharedMapsAbsent { .. }) => {
                    output::print(&format!(
                        "{:width$}  skipped   its map is not on this machine\n",
                        entry.name
                    ));
                }
                Err(error) => return Err(error.into()),
            }
        }
        Ok(Gate::Passed)
    }
}

#[derive(Args)]
pub(crate) struct Validate {
    /// Scenario files or folders of them.
    #[arg(required = true)]
    files: Vec<String>,
}

impl Validate {
    /// Reads every file and draws some seeds; all mistakes are told, not just the first.
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        let maps = MapCache::new();
        let mut mistakes = 0;
        let mut tell = |result: anyhow::Result<String>| match result {
            Ok(text) => output::print(&text),
            Err(error) => {
                mistakes += 1;
                output::note(&format!("error: {}", message(&error)));
            }
        };
        for given in &self.files {
            match source::files(given) {
                Ok(files) => files.iter().for_each(|file| tell(check(file, &maps))),
                Err(error) => tell(Err(error)),
            }
        }
        anyhow::ensure!(mistakes == 0, "{mistakes} of the files cannot be run");
        Ok(Gate::Passed)
    }
}

fn check(file: &Path, maps: &MapCache) -> anyhow::Result<String> {
    let family = match Family::load_with(file, maps) {
        Err(ScenarioError::SharedMapsAbsent { map, .. }) => {
            return Ok(format!("{}: skipped: {}\n", file.display(), source::absent(&map)));
        }
        family => family?,
    };
    let seeds = if family.is_fixed() { 1 } else { SEEDS_DRAWN };
    let mut rejected = 0;
    for seed in 1..=seeds {
        rejected += family.draw(seed)?.rejected.len();
    }
    let warnings = family.map_warnings().len();
    Ok(format!(
        "{}: good; {seeds} seeds drawn, {rejected} draws rejected, {warnings} warnings of its map\n",
        file.display()
    ))
}
