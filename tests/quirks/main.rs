//! Planted faults: seeds that pass with the decider as it is must fail with a broken one. A testbed that stays green
//! with a broken decider is broken itself.
//!
//! Where a later layer covers for a fault, the monitor judges the earlier answer itself: the decided bound by
//! `bound_obstacle_clearance` and `missed_block`, the path by `path_obstacle_clearance`, whatever the car then does.
//!
//! The whole set, in release, is `corridor faults`; here are a few of it by hand, and what the hunt itself promises.

mod hunted;

use corridor_scenarios::{MapCache, catalog};
use corridor_sim::run::run;
use corridor_sim::settings::Settings;
use corridor_sim::verdict::{Ending, Verdict};
use std::ops::RangeInclusive;

const FALLBACK: &str = "decider.path_bounds.quirks.fallback_ignores_obstacles=true";
const CORNERS: &str = "decider.path.corner_collision_check=true";

/// Verdicts of these seeds that did not pass.
fn failures(scenario: &str, seeds: impl IntoIterator<Item = u64>, overrides: &[&str]) -> Vec<Verdict> {
    let entry = catalog::find(scenario).unwrap_or_else(|| panic!("no scenario `{scenario}`"));
    let family = entry
        .load(&MapCache::new())
        .unwrap_or_else(|error| panic!("{error}"));
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let settings = Settings::with(&overrides).unwrap_or_else(|error| panic!("{error}"));
    let verdict = |seed| {
        let drawn = family.draw(seed).unwrap_or_else(|error| panic!("{error}"));
        run(&drawn.scenario, &settings)
    };
    seeds
        .into_iter()
        .map(verdict)
        .filter(|verdict| !verdict.pass)
        .collect()
}

/// Checks that all seeds pass, and that at least `least` of them fail with the fault. Returns those.
fn caught(scenario: &str, seeds: RangeInclusive<u64>, fault: &[&str], least: usize) -> Vec<Verdict> {
    let without: Vec<String> = failures(scenario, seeds.clone(), &[])
        .into_iter()
        .map(|v| v.summary)
        .collect();
    assert!(without.is_empty(), "{scenario} without a fault: {without:#?}");
    let with = failures(scenario, seeds, fault);
    assert!(
        with.len() >= least,
        "{fault:?} was caught in {} runs of {scenario}, not in {least}",
        with.len()
    );
    with
}

fn collisions(verdicts: &[Verdict]) -> usize {
    verdicts
        .iter()
        .filter(|verdict| verdict.ending == Ending::Collision)
        .count()
}

/// How many of the verdicts fail a gate of this name.
fn failing(verdicts: &[Verdict], name: &str) -> usize {
    let fails = |verdict: &&Verdict| {
        verdict
            .metrics
            .iter()
            .any(|metric| metric.name == name && metric.gate && !metric.pass)
    };
    verdicts.iter().filter(fails).count()
}

/// It takes the first cone on its right and finds no room; the way left of both stays unused.
#[test]
fn greedy_sides_stop_before_an_open_way() {
    caught(
        "two_cones",
        1..=12,
        &["decider.path_bounds.quirks.greedy_sides=true"],
        3,
    );
}

/// Where the road leaves room they are passed, and touched by the bound: the car is let as near as it fits.
#[test]
fn a_bound_without_a_buffer_touches_what_it_passes() {
    let fault = ["decider.path_bounds.obstacle_lat_buffer=0"];
    let failed = caught("off_centre_beside_parked", 1..=6, &fault, 5);
    assert!(failing(&failed, "bound_obstacle_clearance") >= 5);
}

#[test]
fn a_mirrored_world_is_driven_into() {
    let failed = caught("blocked_sweep", 2..=5, &["fault=mirrored"], 3);
    assert!(collisions(&failed) >= 3);
    assert!(failing(&failed, "bound_obstacle_clearance") >= 3);
}

/// The speed layer stops for the blocker all the same; the bound says that the car may be inside it.
#[test]
fn a_bound_padded_through_its_blocker_is_wrong_by_itself() {
    let fault = ["decider.path_bounds.quirks.pad_through_blocker=true"];
    for (scenario, seeds) in [("two_cones", 1..=4), ("bollard_between_walls", 1..=4)] {
        let failed = caught(scenario, seeds, &fault, 4);
        assert_eq!(failing(&failed, "bound_obstacle_clearance"), 4, "{scenario}");
        assert_eq!(collisions(&failed), 0, "{scenario}");
    }
}

/// Rare, because a bound that knows the obstacles leaves little to check: three of two thousand runs of the catalog, in
/// which the car follows a path that no corner objects to until there is none.
#[test]
fn a_path_checked_at_its_corners_gets_stuck_between_bollards() {
    for seed in [17, 35, 44] {
        caught("bollards_askew", seed..=seed, &[CORNERS], 1);
    }
}

/// Too near to the bollard for any bound that knows it, the fallback leads on.
#[test]
fn a_fallback_that_ignores_obstacles_creeps_on() {
    let failed = caught("bollard_between_walls", 1..=8, &[FALLBACK], 3);
    assert!(failing(&failed, "bound_obstacle_clearance") >= 3);
    assert!(failing(&failed, "missed_block") >= 3);
}

/// With nothing but the corners checked against it, the path leads over the bollard.
#[test]
fn a_bollard_between_the_corners_is_run_over() {
    let failed = caught("bollard_between_walls", 1..=8, &[FALLBACK, CORNERS], 3);
    assert!(collisions(&failed) >= 3);
}

#[test]
fn the_original_with_all_its_defects_is_caught() {
    let failed = caught("bollard_between_walls", 1..=6, &["profile=apollo"], 6);
    assert!(failing(&failed, "bound_obstacle_clearance") >= 6);
    caught("cone_gate", 1..=7, &["profile=apollo"], 3);
}
