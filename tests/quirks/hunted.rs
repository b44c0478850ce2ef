//! The hunt itself: a quick part of the set is caught, the same for any number of threads, and what changes nothing is
//! never called caught.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use corridor_scenarios::{MapCache, catalog};
use corridor_sim::faults::{Fault, Spec};
use corridor_sim::report::{findings_to_json, findings_to_table};
use corridor_sim::settings::Settings;
use corridor_sim::sweep::Plan;
use corridor_sim::sweep::hunt::{Finding, Hunt, Hunted, hunt};
use corridor_sim::verdict::Ending;

fn specs(names: &[&str]) -> Vec<&'static Spec> {
    let spec = |name: &&str| Fault::named(name).unwrap().spec().unwrap();
    names.iter().map(spec).collect()
}

fn hunted(names: &[&str], on: &[&str], budget: usize, threads: usize) -> Vec<Finding> {
    let maps = MapCache::new();
    let family = |name: &&str| {
        (
            catalog::find(name).unwrap().load(&maps).unwrap(),
            (*name).to_owned(),
        )
    };
    let plan = Plan::new(on.iter().map(family).collect(), 0, 1);
    let settings = Settings::default();
    let what = Hunt {
        plan: &plan,
        settings: &settings,
        overrides: &[],
        seed: 1,
        shrink: 0,
        budget,
    };
    hunt(&what, &specs(names), threads, &mut |_| {}).unwrap()
}

#[test]
fn a_breakdown_is_caught_in_the_first_run_and_named() {
    let names = [
        "panic",
        "answers_never",
        "nan",
        "empty_answer",
        "bound_stations_unordered",
    ];
    for finding in hunted(&names, &["empty_road"], 1, 1) {
        let Hunted::Caught(caught) = &finding.result else {
            panic!("{}: {:?}", finding.fault.name, finding.result)
        };
        let is_broken = caught.ending == Ending::DeciderFailed && caught.metric == "decider_ok";
        assert!(is_broken && finding.holds(), "{caught:?}");
        assert!(
            caught.replay.ends_with(&format!("fault={}", finding.fault.name)),
            "{}",
            caught.replay
        );
    }
}

#[test]
fn what_shows_is_found_in_the_same_seed_for_any_number_of_threads() {
    let names = ["mirrored", "steering_sign", "obstacles_unseen"];
    let on = ["nudge_parked_car", "blocked_sweep"];
    let [one, two] = [1, 2].map(|threads| hunted(&names, &on, 6, threads));
    let caught = |finding: &Finding| matches!(finding.result, Hunted::Caught(_));
    assert!(one.iter().all(caught), "{}", findings_to_table(&one));
    assert_eq!(findings_to_json(&one).unwrap(), findings_to_json(&two).unwrap());
    assert_eq!(findings_to_table(&one), findings_to_table(&two));
}

/// On an empty road nobody sees whether obstacles are forgotten: the runs are the same to the bit.
#[test]
fn what_changes_nothing_is_not_called_caught() {
    let findings = hunted(&["last_obstacle_dropped"], &["empty_road"], 3, 1);
    let finding = &findings[0];
    assert!(matches!(finding.result, Hunted::Escaped) && !finding.holds());
    assert_eq!(
        (finding.seeds, finding.changed),
        (1, 0),
        "a scenario without random numbers is run once"
    );
    let table = findings_to_table(&findings);
    assert!(
        table.contains("without effect") && table.contains("0 caught"),
        "{table}"
    );
}
