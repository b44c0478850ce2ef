//! A failing run made small is still the same failure, on every machine the same file.

use crate::support::{family, settings};
use corridor_scenarios::{Family, MapCache};
use corridor_sim::run::run;
use corridor_sim::shrink::{Demand, ShrinkError, Shrunk, shrink};
use std::path::Path;

/// Obstacles on the wrong side of the line: the row that the kerb should hold stands in the way, unseen.
const BLIND: [&str; 1] = ["fault=mirrored"];

fn shrunk(name: &str, seed: u64, budget: u32) -> Shrunk {
    let (broken, sound) = (settings(&BLIND), settings(&[]));
    let demand = Demand {
        settings: &broken,
        sound: Some(&sound),
        keeps_map: false,
    };
    shrink(&family(name), seed, &demand, budget, &MapCache::new()).unwrap()
}

#[test]
fn what_is_left_fails_in_the_same_way_and_passes_without_the_fault() {
    let found = shrunk("parked_row", 1, 150);
    let [before, after] = found.sizes;
    assert!(
        after.obstacles <= 2 && after.obstacles < before.obstacles,
        "{:?}",
        found.sizes
    );
    assert!(after.duration <= before.duration && after.digits < before.digits);
    let small = Family::parse(&found.text, "small.toml", Path::new("")).unwrap();
    assert!(small.is_fixed(), "{}", found.text);
    let scenario = small.draw(99).unwrap().scenario;
    let verdict = run(&scenario, &settings(&BLIND));
    assert_eq!(verdict.signature, Some(found.signature));
    assert!(run(&scenario, &settings(&[])).pass);
}

#[test]
fn it_is_the_same_again_and_no_larger_with_more_runs() {
    let few = shrunk("parked_row", 1, 25);
    assert_eq!(few.text, shrunk("parked_row", 1, 25).text);
    assert!(few.runs <= 27, "{}", few.runs);
    let more = shrunk("parked_row", 1, 80);
    let size = |found: &Shrunk| (found.sizes[1].obstacles, found.sizes[1].digits);
    assert!(size(&more) <= size(&few), "{:?} {:?}", size(&more), size(&few));
}

#[test]
fn a_run_that_passes_has_nothing_to_shrink() {
    let sound = settings(&[]);
    let demand = Demand {
        settings: &sound,
        sound: None,
        keeps_map: false,
    };
    let error = shrink(&family("empty_road"), 1, &demand, 9, &MapCache::new()).unwrap_err();
    assert!(matches!(error, ShrinkError::Passes), "{error}");
}
