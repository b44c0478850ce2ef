//! The same run, from the same seed, gives the same bits.

use crate::support::{VARIED, family, owned, scenario, settings, trace};
use corridor_sim::replay::{Replayed, replay};
use corridor_sim::report::SweepReport;
use corridor_sim::run::run;
use corridor_sim::sweep::{Plan, SweepRow, Variant, rows};

#[test]
fn replaying_a_trace_gives_the_same_states() {
    for name in VARIED {
        let trace = trace("repeat", name, &[]);
        let ticks = trace.ticks.len();
        assert!(ticks > 20, "{name}: {ticks} ticks");
        let truncated = false;
        assert_eq!(
            replay(&trace).unwrap(),
            Replayed::Same { ticks, truncated },
            "{name}"
        );
    }
}

#[test]
fn a_replay_makes_the_settings_of_its_trace() {
    let trace = trace(
        "settings",
        "nudge_several",
        &["decider.path_bounds.obstacle_lat_buffer=0.25"],
    );
    assert!(matches!(replay(&trace).unwrap(), Replayed::Same { .. }));
    let mut forgotten = trace;
    forgotten.header.overrides.clear();
    assert!(matches!(replay(&forgotten).unwrap(), Replayed::Differs { .. }));
}

fn runs(threads: usize, overrides: &[&str]) -> Vec<SweepRow> {
    let families = ["cut_in", "nudge_sweep", "pull_over_gap_sweep", "nudge_parked_car"];
    let families = families.map(|name| (family(name), name.to_owned())).into();
    let plan = Plan::new(families, 13, 1);
    rows(&plan, &Variant::new("", owned(overrides)).unwrap(), threads).unwrap()
}

fn digest(rows: &[SweepRow]) -> String {
    rows.iter().collect::<SweepReport>().digest()
}

#[test]
fn a_sweep_has_one_digest_for_any_number_of_threads_and_in_repeat() {
    let one = runs(1, &[]);
    assert_eq!(one.len(), 13);
    for threads in [2, 1, 3] {
        let other = runs(threads, &[]);
        assert_eq!(digest(&other), digest(&one), "{threads} threads");
        for (a, b) in one.iter().zip(&other) {
            assert_eq!(a.verdict(), b.verdict(), "{} seed {}", a.scenario, a.seed);
        }
    }
}

#[test]
fn a_setting_that_matters_changes_the_digest() {
    let usual = digest(&runs(2, &[]));
    for setting in [
        "decider.path_bounds.obstacle_lat_buffer=0.35",
        "physics.dynamics.steer_lag=0.3",
        "tick=0.2",
    ] {
        assert_ne!(digest(&runs(2, &[setting])), usual, "{setting}");
    }
}

#[test]
fn seeds_of_a_family_are_different_runs() {
    let family = family("nudge_sweep");
    let digest = |seed| run(&family.draw(seed).unwrap().scenario, &settings(&[])).digest;
    assert_ne!(digest(1), digest(2));
    assert_eq!(digest(1), run(&scenario("nudge_sweep"), &settings(&[])).digest);
}
