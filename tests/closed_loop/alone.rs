//! A trace holds all that the decider knew: its frames, decided again outside the loop, give its decisions.

use crate::support::{VARIED, trace};
use corridor_decider::config::Config;
use corridor_decider::context::Context;
use corridor_decider::decision::Decision;
use corridor_decider::frame::Frame;
use corridor_decider::planner::{LatticePlanner, Planner};
use corridor_sim::trace::{Trace, TraceWriter};
use std::path::Path;

/// The decisions on the frames of a trace, as its writer rounds them.
fn decide_again(
    trace: &Trace,
    name: &str,
    decide: impl Fn(&Frame, &mut Context) -> Decision,
) -> Vec<Decision> {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("again-{name}.trace.zst"));
    let mut writer = TraceWriter::create(&path, &trace.header).unwrap();
    let mut context = Context::default();
    for (k, tick) in trace.ticks.iter().enumerate() {
        let mut again = tick.clone();
        again.decision = decide(&trace.frame(k).unwrap(), &mut context);
        writer.tick(&again).unwrap();
    }
    writer.finish(trace.verdict.as_ref().unwrap()).unwrap();
    let again = Trace::open(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    again.ticks.into_iter().map(|tick| tick.decision).collect()
}

fn assert_same(name: &str, again: &[Decision], trace: &Trace) {
    assert_eq!(again.len(), trace.ticks.len(), "{name}");
    for (k, (now, tick)) in again.iter().zip(&trace.ticks).enumerate() {
        let then = &tick.decision;
        assert_eq!(now.outcome, then.outcome, "{name}, tick {k}");
        assert_eq!(now.stop, then.stop, "{name}, tick {k}");
        assert!(
            now.trajectory == then.trajectory,
            "{name}, tick {k}: another trajectory"
        );
        assert!(
            now == then,
            "{name}, tick {k}: the same trajectory, other bounds or another path"
        );
    }
}

#[test]
fn frames_decided_again_alone_give_the_same_decisions() {
    for name in VARIED {
        let trace = trace("alone", name, &[]);
        let planner = Planner::new(Config::default(), trace.header.vehicle);
        let again = decide_again(&trace, name, |frame, context| planner.decide(frame, context));
        assert_same(name, &again, &trace);
    }
}

#[test]
fn the_lattice_planner_decides_the_same_again_alone() {
    for name in VARIED {
        let trace = trace("alone-lattice", name, &["decider.planner=lattice"]);
        let planner = LatticePlanner::new(Config::default(), trace.header.vehicle);
        let again = decide_again(&trace, &format!("lattice-{name}"), |frame, context| {
            planner.decide(frame, context)
        });
        assert_same(name, &again, &trace);
    }
}
