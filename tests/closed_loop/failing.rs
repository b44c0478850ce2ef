//! A decider that fails is an outcome of its run, and the sweep goes on.

use crate::support::{family, owned, scenario, settings, trace};
use corridor_sim::replay::{Replayed, replay};
use corridor_sim::run::run;
use corridor_sim::sweep::{Plan, Variant, rows};
use corridor_sim::verdict::Ending;

#[test]
fn a_panic_and_a_number_that_is_none_end_the_run() {
    for (fault, said) in [("fault=panic", "a planted fault"), ("fault=nan", "not finite")] {
        let verdict = run(&scenario("nudge_parked_car"), &settings(&[fault]));
        assert_eq!(verdict.ending, Ending::DeciderFailed, "{fault}");
        assert!(
            !verdict.pass && verdict.summary.contains(said),
            "{}",
            verdict.summary
        );
        assert!(
            verdict.duration > 0.9 && verdict.duration < 1.2,
            "{fault}: {} s",
            verdict.duration
        );
    }
}

#[test]
fn the_trace_of_a_failed_decider_is_whole_and_replays() {
    for fault in ["fault=panic", "fault=nan"] {
        let trace = trace(&fault["fault=".len()..], "nudge_parked_car", &[fault]);
        assert_eq!(trace.verdict.as_ref().unwrap().ending, Ending::DeciderFailed);
        assert!(
            matches!(replay(&trace).unwrap(), Replayed::Same { truncated: false, .. }),
            "{fault}"
        );
    }
}

#[test]
fn every_run_of_a_sweep_with_a_panicking_decider_is_judged() {
    let families = ["nudge_sweep", "cut_in"].map(|name| (family(name), name.to_owned()));
    let plan = Plan::new(families.into(), 6, 1);
    let rows = rows(&plan, &Variant::new("", owned(&["fault=panic"])).unwrap(), 2).unwrap();
    assert_eq!(rows.len(), 6);
    for row in &rows {
        assert_eq!(
            row.verdict().unwrap().ending,
            Ending::DeciderFailed,
            "{}",
            row.scenario
        );
    }
}
