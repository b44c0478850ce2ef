//! The simple planners in the loop: each can do what it is there for, and no more.

use crate::support::{VARIED, scenario, settings, trace};
use corridor_sim::replay::{Replayed, replay};
use corridor_sim::run::run;
use corridor_sim::verdict::{Ending, Verdict};

fn driven(planner: &str, name: &str) -> Verdict {
    let choice = format!("decider.planner={planner}");
    run(&scenario(name), &settings(&[&choice]))
}

#[test]
fn all_drive_along_a_free_road() {
    for planner in ["blind", "idm", "pdm_closed"] {
        for name in ["empty_road", "curve_empty"] {
            let verdict = driven(planner, name);
            assert!(verdict.pass, "{planner}, {name}: {}", verdict.summary);
        }
    }
}

#[test]
fn the_blind_one_drives_into_what_stands_and_the_others_do_not() {
    let blind = driven("blind", "stopped_leader");
    assert_eq!(blind.ending, Ending::Collision, "{}", blind.summary);
    for planner in ["idm", "pdm_closed"] {
        let verdict = driven(planner, "stopped_leader");
        assert!(verdict.pass, "{planner}: {}", verdict.summary);
    }
}

#[test]
fn pdm_closed_gets_past_a_parked_car() {
    let verdict = driven("pdm_closed", "nudge_parked_car");
    assert!(verdict.pass, "{}", verdict.summary);
}

#[test]
fn their_answers_are_sound_and_their_traces_replay_to_the_bit() {
    for planner in ["blind", "idm", "pdm_closed"] {
        for name in VARIED {
            let trace = trace(planner, name, &[&format!("decider.planner={planner}")]);
            let (ticks, truncated) = (trace.ticks.len(), false);
            let verdict = trace.verdict.as_ref().unwrap();
            assert!(verdict.ending != Ending::DeciderFailed, "{planner}, {name}");
            assert_eq!(
                replay(&trace).unwrap(),
                Replayed::Same { ticks, truncated },
                "{planner}, {name}"
            );
        }
    }
}
