//! Every file of the catalog is in the program, can be read, and gives a scenario for every seed.

use corridor_decider::reference_line::LineQuery;
use corridor_scenarios::catalog::{self, ENTRIES, REGRESSIONS};
use corridor_scenarios::scenario::Expectation;
use corridor_scenarios::{Family, MapCache, ScenarioError};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const SEEDS: u64 = 20;

/// All families whose maps are here. The shared ones may be absent, unless the environment requires them.
pub(crate) fn families() -> Vec<(&'static str, Family)> {
    let maps = MapCache::new();
    let mut families = Vec::new();
    for entry in REGRESSIONS.iter().chain(ENTRIES) {
        match entry.load(&maps) {
            Ok(family) => families.push((entry.name, family)),
            Err(ScenarioError::SharedMapsAbsent { .. })
                if entry.needs_shared_maps && std::env::var_os("CORRIDOR_REQUIRE_MAPS").is_none() =>
            {
                eprintln!("{} skipped: no maps", entry.name);
            }
            Err(error) => panic!("{error}"),
        }
    }
    families
}

fn names_in(folder: &str) -> BTreeSet<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let files = std::fs::read_dir(folder)
        .unwrap()
        .map(|file| file.unwrap().path());
    let toml = files.filter(|path| path.extension().is_some_and(|e| e == "toml"));
    toml.map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
        .collect()
}

#[test]
fn the_program_holds_exactly_the_files_of_the_folder() {
    for folder in ["catalog", "catalog/real", "catalog/hard", "catalog/hard/real"] {
        let entries = ENTRIES.iter().filter(|entry| entry.folder() == folder);
        let listed: BTreeSet<String> = entries.map(|entry| entry.name.to_owned()).collect();
        assert_eq!(listed, names_in(folder));
    }
    let kept: BTreeSet<String> = REGRESSIONS.iter().map(|entry| entry.name.to_owned()).collect();
    assert_eq!(kept, names_in("regressions"));
    assert!(
        families()
            .iter()
            .filter(|(name, _)| kept.contains(*name))
            .all(|(_, family)| family.is_fixed())
    );
    let mut sorted = ENTRIES.to_vec();
    sorted.sort_by_key(|entry| (entry.is_hard, entry.needs_shared_maps, entry.name));
    assert_eq!(sorted, ENTRIES);
    let names: BTreeSet<&str> = ENTRIES.iter().map(|entry| entry.name).collect();
    assert_eq!(names.len(), ENTRIES.len(), "a name is a name");
    assert!(ENTRIES.iter().filter(|entry| entry.is_hard).count() >= 30);
    assert_eq!(catalog::find("cut_in").unwrap().name, "cut_in");
    assert!(catalog::find("no such scenario").is_none());
}

#[test]
fn every_file_gives_a_scenario_for_every_seed() {
    let mut broken = Vec::new();
    for (name, family) in families() {
        let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
        let mut ends: BTreeMap<String, usize> = BTreeMap::new();
        for seed in 0..SEEDS {
            match family.draw(seed) {
                Ok(drawn) => {
                    for rejection in drawn.rejected {
                        *reasons.entry(rejection.reason()).or_default() += 1;
                    }
                    let end = format!("{:?}", drawn.scenario.expect);
                    *ends.entry(end.split('(').next().unwrap().to_owned()).or_default() += 1;
                }
                Err(error) => {
                    broken.push(format!("{name}: {error}"));
                    break;
                }
            }
        }
        eprintln!(
            "{name}: {ends:?}, rejected {reasons:?}, fixed {}, route {:.0} m",
            family.is_fixed(),
            family.draw(0).map_or(0.0, |d| d.scenario.line.length())
        );
    }
    assert!(broken.is_empty(), "{broken:#?}");
}

#[test]
fn enough_of_them_are_families_and_the_sweeps_reach_every_end() {
    let families = families();
    let random = families.iter().filter(|(_, family)| !family.is_fixed()).count();
    assert!(random >= 10, "{random}");
    let ends = |name: &str| -> BTreeSet<&'static str> {
        let family = &families.iter().find(|(n, _)| *n == name).unwrap().1;
        let drawn = (0..200).map(|seed| family.draw(seed).unwrap().scenario.expect);
        drawn
            .map(|end| match end {
                Expectation::Progress(_) => "progress",
                Expectation::Standstill => "standstill",
                Expectation::ProgressOrStandstill(_) => "either",
                Expectation::PulledOver => "pulled over",
                Expectation::Refusal => "refusal",
                Expectation::PulledOverOrRefusal => "either pull-over",
                Expectation::LaneChanged => "lane changed",
                Expectation::Goal(_) => "goal",
            })
            .collect()
    };
    for name in ["double_parked", "cone_gate", "blocked_sweep"] {
        assert_eq!(
            ends(name).into_iter().collect::<Vec<_>>(),
            ["either", "progress", "standstill"],
            "{name}"
        );
    }
    assert_eq!(
        ends("pull_over_gap_sweep").into_iter().collect::<Vec<_>>(),
        ["either pull-over", "pulled over", "refusal"]
    );
}

#[test]
fn a_catalog_file_on_disk_is_the_one_in_the_program() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("catalog/parked_row.toml");
    let (disk, program) = (Family::load(&path).unwrap(), catalog::find("parked_row").unwrap());
    let program = program.load(&MapCache::new()).unwrap();
    assert_eq!(disk.name(), program.name());
    for seed in 0..5 {
        let (a, b) = (
            disk.draw(seed).unwrap().scenario,
            program.draw(seed).unwrap().scenario,
        );
        assert_eq!(a.ego, b.ego);
        assert_eq!(a.obstacles.len(), b.obstacles.len());
    }
}
