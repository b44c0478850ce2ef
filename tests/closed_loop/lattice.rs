//! The lattice planner in the loop: it comes to no harm, gets on where a way is free, and repeats to the bit.

use crate::support::{VARIED, family, owned, scenario, settings, trace};
use corridor_sim::replay::{Replayed, replay};
use corridor_sim::report::SweepReport;
use corridor_sim::run::run;
use corridor_sim::sweep::{Plan, SweepRow, Variant, rows};
use corridor_sim::verdict::{Ending, Verdict};

const LATTICE: [&str; 1] = ["decider.planner=lattice"];

fn value(verdict: &Verdict, name: &str) -> f64 {
    let metric = verdict.metrics.iter().find(|metric| metric.name == name);
    metric.and_then(|metric| metric.value).unwrap()
}

/// It neither borrows lanes nor pulls over, so not every one of these can end as it should; none may end badly.
#[test]
fn it_comes_to_no_harm() {
    for name in VARIED
        .into_iter()
        .chain(["curve_cyclist", "cone_in_lane", "hard_braking_leader"])
    {
        let verdict = run(&scenario(name), &settings(&LATTICE));
        let bad = matches!(verdict.ending, Ending::Collision | Ending::DeciderFailed);
        assert!(!bad, "{name}: {}", verdict.summary);
        for gate in ["no_collision", "drivable_area", "decider_ok"] {
            let metric = verdict.metrics.iter().find(|metric| metric.name == gate).unwrap();
            assert!(metric.pass, "{name}: {gate}");
        }
    }
}

#[test]
fn it_arrives_where_its_lane_is_free() {
    for name in [
        "empty_road",
        "curve_empty",
        "cut_in",
        "slow_leader",
        "nudge_parked_car",
    ] {
        let verdict = run(&scenario(name), &settings(&LATTICE));
        assert!(verdict.pass, "{name}: {}", verdict.summary);
        assert!(value(&verdict, "fallback_ratio") < 0.05, "{name}");
    }
}

#[test]
fn its_traces_replay_to_the_bit() {
    for name in VARIED {
        let trace = trace("lattice", name, &LATTICE);
        let (ticks, truncated) = (trace.ticks.len(), false);
        assert!(ticks > 20, "{name}: {ticks} ticks");
        assert_eq!(
            replay(&trace).unwrap(),
            Replayed::Same { ticks, truncated },
            "{name}"
        );
    }
    let mut forgotten = trace("lattice-forgotten", "nudge_several", &LATTICE);
    forgotten.header.overrides.clear();
    assert!(matches!(replay(&forgotten).unwrap(), Replayed::Differs { .. }));
}

#[test]
fn its_sweeps_have_one_digest_for_any_number_of_threads() {
    let runs = |threads: usize| {
        let families = ["cut_in", "nudge_sweep", "pull_over_gap_sweep", "nudge_parked_car"];
        let families = families.map(|name| (family(name), name.to_owned())).into();
        let plan = Plan::new(families, 9, 1);
        rows(&plan, &Variant::new("", owned(&LATTICE)).unwrap(), threads).unwrap()
    };
    let digest = |rows: &[SweepRow]| rows.iter().collect::<SweepReport>().digest();
    let one = runs(1);
    for row in &one {
        // Every answer was timed, and nothing else.
        let answers = &row.verdict().unwrap().outcomes;
        let answers: u32 = answers.iter().map(|(_, ticks)| ticks).sum();
        assert_eq!(row.cycles.count(), u64::from(answers), "{}", row.scenario);
    }
    for threads in [2, 3] {
        let other = runs(threads);
        assert_eq!(digest(&other), digest(&one), "{threads} threads");
        for (a, b) in one.iter().zip(&other) {
            assert_eq!(a.verdict(), b.verdict(), "{} seed {}", a.scenario, a.seed);
        }
    }
}
