//! Deciders and defects that are off by default, where they are on.

use crate::support::{scenario, settings, trace};
use corridor_decider::decision::{Stop, StopCause};
use corridor_sim::run::run;
use corridor_sim::trace::TickRecord;

/// Speed at which the car has stopped, m/s.
const STOPPED: f64 = 0.5;

/// Offset at which a car in the middle of its lane begins to leave it, m.
const OUT_OF_LANE: f64 = 0.8;

#[test]
fn the_car_stops_and_looks_before_it_goes_out_where_it_is_asked_to() {
    let name = "borrow_with_oncoming";
    // Whatever is seen within 40 m hides something.
    let overrides = [
        "decider.rule_based_stop.enable_side_pass_stop=true",
        "decider.rule_based_stop.search_beam_length=40",
        "decider.rule_based_stop.is_block_angle_threshold=0.05",
    ];
    let verdict = run(&scenario(name), &settings(&overrides));
    assert!(verdict.pass, "{}", verdict.summary);
    let looks = |overrides: &[&str]| {
        let trace = trace("looks", name, overrides);
        let is_look = |stop: Stop| stop.cause == StopCause::SidePass;
        let first = trace
            .ticks
            .iter()
            .position(|tick| tick.decision.stop.is_some_and(is_look))?;
        let is_inside =
            |tick: &&TickRecord| tick.frame.ego.pose.y - trace.ticks[0].frame.ego.pose.y < OUT_OF_LANE;
        let speeds = trace.ticks[first..].iter().take_while(is_inside);
        Some(speeds.map(|tick| tick.frame.ego.v).fold(f64::MAX, f64::min))
    };
    let speed = looks(&overrides).expect("it has looked");
    assert!(speed <= STOPPED, "it went out at {speed} m/s");
    assert_eq!(looks(&overrides[1..]), None, "off by default");
}

/// Without the product of neighbours the jerk's weight falls on curvature and acceleration: the car drives on, otherwise.
#[test]
fn the_diagonal_jerk_of_the_original_drives_otherwise() {
    for name in ["nudge_parked_car", "curve_parked_car", "stopped_leader"] {
        let sound = run(&scenario(name), &settings(&[]));
        let defect = run(
            &scenario(name),
            &settings(&["decider.quirks.diagonal_jerk_hessian=true"]),
        );
        assert!(defect.collisions.is_empty(), "{name}: {}", defect.summary);
        assert_ne!(sound.digest, defect.digest, "{name}");
    }
}
