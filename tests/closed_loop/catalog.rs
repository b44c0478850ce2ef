//! Every scenario of the catalog without random numbers ends as it says it should.

use corridor_scenarios::{MapCache, ScenarioError, catalog};
use corridor_sim::run::run;
use corridor_sim::settings::Settings;

#[test]
fn every_fixed_scenario_ends_as_it_should() {
    let maps = MapCache::new();
    let mut failed = Vec::new();
    let mut runs = 0;
    for entry in catalog::ENTRIES {
        let family = match entry.load(&maps) {
            Ok(family) if family.is_fixed() => family,
            Ok(_) => continue,
            Err(ScenarioError::SharedMapsAbsent { .. })
                if std::env::var_os("CORRIDOR_REQUIRE_MAPS").is_none() =>
            {
                eprintln!("{} skipped: no maps", entry.name);
                continue;
            }
            Err(error) => panic!("{error}"),
        };
        let verdict = run(&family.draw(1).unwrap().scenario, &Settings::default());
        runs += 1;
        if !verdict.pass {
            failed.push(format!("{}: {}", entry.name, verdict.summary));
        }
    }
    // Nineteen of them are on the maps that are part of the program.
    assert!(runs >= 19, "{runs}");
    assert!(failed.is_empty(), "{failed:#?}");
}
