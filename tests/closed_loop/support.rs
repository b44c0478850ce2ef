//! Scenarios and traces for the tests.

use corridor_scenarios::{Family, MapCache, Scenario, ScenarioError, catalog};
use corridor_sim::run::run_traced;
use corridor_sim::settings::Settings;
use corridor_sim::trace::Trace;
use std::path::Path;

/// Scenarios of all kinds: standing, moving and walking obstacles, every command.
pub(crate) const VARIED: [&str; 8] = [
    "blocked_borrow",
    "cut_in",
    "jaywalker",
    "lane_change_left",
    "narrowing_street",
    "nudge_several",
    "pull_over_between_parked",
    "slow_leader",
];

pub(crate) fn family(name: &str) -> Family {
    catalog::find(name).unwrap().load(&MapCache::new()).unwrap()
}

/// Whether a scenario can be run here: those on shared maps cannot where these are absent and not required.
pub(crate) fn is_here(name: &str) -> bool {
    let loaded = catalog::find(name).unwrap().load(&MapCache::new());
    let is_absent = matches!(loaded, Err(ScenarioError::SharedMapsAbsent { .. }))
        && std::env::var_os("CORRIDOR_REQUIRE_MAPS").is_none();
    if is_absent {
        eprintln!("{name} skipped: no maps");
    }
    !is_absent
}

pub(crate) fn scenario(name: &str) -> Scenario {
    family(name).draw(1).unwrap().scenario
}

pub(crate) fn settings(overrides: &[&str]) -> Settings {
    Settings::with(&owned(overrides)).unwrap()
}

pub(crate) fn owned(overrides: &[&str]) -> Vec<String> {
    overrides.iter().map(|text| (*text).to_owned()).collect()
}

/// The trace of one run, read back from its file. `who` keeps tests of the same scenario apart.
pub(crate) fn trace(who: &str, name: &str, overrides: &[&str]) -> Trace {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{who}-{name}.trace.zst"));
    let family = family(name);
    let drawn = family.draw(1).unwrap();
    run_traced(
        &family,
        &drawn.scenario,
        &owned(overrides),
        &settings(overrides),
        &path,
    )
    .unwrap();
    let trace = Trace::open(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    trace
}
