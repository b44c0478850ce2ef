//! What each expectation asks for, from both sides.

use super::fixture::*;
use crate::verdict::Ending;
use corridor_decider::decision::{Decision, PullOverTarget, Stop, StopCause};
use corridor_decider::frame::{Command, ObstacleId};
use corridor_decider::geometry::{Pose, Vec2};
use corridor_decider::hd_map::HdMap;
use corridor_decider::reference_line::LineProvider;
use corridor_decider::road::{LaneId, Side};
use corridor_decider::routing::{BlackList, LaneGraph, Position, RoutingConfig, WayPoint};
use corridor_decider::tasks::path_bounds::Label;
use corridor_scenarios::goal::{GoalArea, GoalRegion, GoalState};
use corridor_scenarios::scenario::Expectation;
use std::sync::Arc;

fn pull_over_run(expect: Expectation) -> Run {
    let mut scenario = scenario(&[], expect);
    scenario.command = Command::PullOver(Vec2::new(60.0, 0.0));
    Run::new(scenario)
}

fn aimed() -> Decision {
    let target = PullOverTarget {
        position: Vec2::new(60.0, 0.0),
        theta: 0.0,
    };
    Decision {
        pull_over: Some(target),
        stop: Some(Stop {
            distance: 0.0,
            cause: StopCause::PullOver,
        }),
        ..decision(bound(Label::PullOver, -1.0, 1.0), 20.0)
    }
}

/// How a pull-over to (60, 0) ends for an ego that stands at a place.
fn stand_at(x: f64, y: f64, theta: f64, v: f64) -> Option<Ending> {
    let mut run = pull_over_run(Expectation::PulledOver);
    run.tick(&aimed());
    run.drive(2.0, |_| ego(x, y, theta, v), |_| Vec::new());
    assert_eq!(run.verdict().pass, run.ending() == Some(Ending::PulledOver));
    run.ending()
}

/// How a run towards a place that counts from 1.0 to 1.2 s ends for an ego that drives there at `v` m/s and then stands.
fn drive_to_region(v: f64) -> Run {
    let goal = GoalState {
        time: (1.0, 1.2),
        areas: vec![GoalArea::Circle {
            center: Vec2::new(10.0, 0.0),
            radius: 1.0,
        }],
        heading: None,
        speed: None,
    };
    let mut scenario = scenario(
        &[],
        Expectation::Goal(GoalRegion {
            time_step: 0.1,
            alternatives: vec![goal],
        }),
    );
    scenario.timeout = 3.0;
    let to_middle = scenario.vehicle.center(Pose::new(0.0, 0.0, 0.0)).x;
    let mut run = Run::new(scenario);
    run.drive(
        3.5,
        |t| {
            ego(
                (v * t).min(v) - to_middle,
                0.0,
                0.0,
                if t < 1.0 { v } else { 0.0 },
            )
        },
        |_| Vec::new(),
    );
    run
}

/// How a run of 30 m ends for an ego that drives `l` metres beside its line, with a route or without one.
fn drive_beside(l: f64, is_routed: bool) -> Option<Ending> {
    let mut scenario = scenario(&[], Expectation::Progress(30.0));
    if is_routed {
        let at = |s| WayPoint::OnLane(Position { lane: LaneId(0), s });
        let graph = LaneGraph::new(&scenario.map, RoutingConfig::default());
        let route = graph
            .route(&scenario.map, &[at(0.0), at(40.0)], &BlackList::default())
            .unwrap();
        let hd_map = Arc::new(HdMap::of_roads(&scenario.map).unwrap());
        scenario.provider = Some(LineProvider::new(Arc::clone(&scenario.map), hd_map, route).unwrap());
    }
    let mut run = Run::new(scenario);
    run.drive(5.0, |t| ego(10.0 + 8.0 * t, l, 0.0, 8.0), |_| Vec::new());
    run.ending()
}

/// A route leads to a lane: beside it is not there.
#[test]
fn a_destination_is_reached_in_its_lane() {
    assert_eq!(drive_beside(0.5, true), Some(Ending::GoalReached));
    assert_eq!(drive_beside(3.5, true), None);
    assert_eq!(drive_beside(3.5, false), Some(Ending::GoalReached));
}

#[test]
fn a_region_is_reached_in_its_time_or_stood_before() {
    let reached = drive_to_region(9.5);
    assert_eq!(reached.ending(), Some(Ending::GoalReached));
    let is_completed = |run: &Run| run.value("scenario_completed") > 0.5;
    assert!(is_completed(&reached) && (reached.verdict().duration - 1.0).abs() < 0.011);
    let short = drive_to_region(8.0);
    assert_eq!(
        short.ending(),
        Some(Ending::StoodStill),
        "only when the time is out"
    );
    assert!(!is_completed(&short) && short.verdict().duration > 2.9);
}

#[test]
fn a_pull_over_is_complete_by_the_original_numbers() {
    let done = Some(Ending::PulledOver);
    assert_eq!(stand_at(59.9, 0.0, 0.0, 0.0), done);
    for (inside, outside) in [
        ((59.51, 0.0, 0.0, 0.0), (59.49, 0.0, 0.0, 0.0)),
        ((59.999, 0.0, 0.0, 0.0), (60.001, 0.0, 0.0, 0.0)),
        ((59.9, 0.99, 0.0, 0.0), (59.9, 1.01, 0.0, 0.0)),
        ((59.9, -0.99, 0.0, 0.0), (59.9, -1.01, 0.0, 0.0)),
        ((59.9, 0.0, 0.199, 0.0), (59.9, 0.0, 0.201, 0.0)),
        ((59.9, 0.0, -0.199, 0.0), (59.9, 0.0, -0.201, 0.0)),
        ((59.9, 0.0, 0.0, 0.2), (59.9, 0.0, 0.0, 0.201)),
    ] {
        let at = |(x, y, theta, v)| stand_at(x, y, theta, v);
        assert_eq!(at(inside), done, "{inside:?}");
        assert_eq!(at(outside), None, "{outside:?}");
    }
}

#[test]
fn the_gap_to_the_edge_is_reported_at_the_stop() {
    let mut run = pull_over_run(Expectation::PulledOver);
    run.tick(&aimed());
    run.drive(2.0, |_| ego(59.9, -0.5, 0.0, 0.0), |_| Vec::new());
    assert!((run.value("pull_over_edge_gap") - (1.75 - 0.5 - 1.055)).abs() < 1e-9);
    assert!((run.value("pull_over_s_error") - 0.1).abs() < 1e-9);
    assert!((run.value("pull_over_success") - 1.0).abs() < 1e-12);
}

#[test]
fn a_lane_change_must_settle() {
    let change = |y: f64, theta: f64, duration: f64| {
        let mut scenario = scenario(&[], Expectation::LaneChanged);
        scenario.command = Command::ChangeLane(Side::Left);
        let mut run = Run::new(scenario);
        run.tick(&decision(bound(Label::LaneChange, -1.0, 1.0), 20.0));
        run.drive(duration, |t| ego(20.0 + 8.0 * t, y, theta, 8.0), |_| Vec::new());
        run.ending()
    };
    let done = Some(Ending::LaneChanged);
    assert_eq!((change(0.49, 0.0, 1.2), change(0.51, 0.0, 1.2)), (done, None));
    assert_eq!((change(0.0, 0.099, 1.2), change(0.0, 0.101, 1.2)), (done, None));
    assert_eq!(change(0.0, 0.0, 1.0), None, "not for a second yet");
}

#[test]
fn a_refusal_must_last_and_never_waver() {
    let mut refused = pull_over_run(Expectation::Refusal);
    refused.tick(&decision(bound(OWN, -1.0, 1.0), 20.0));
    refused.drive(60.0, |t| ego(10.0 + 8.0 * t, 0.0, 0.0, 8.0), |_| Vec::new());
    assert_eq!(refused.ending(), Some(Ending::Refused), "drove past the place");
    assert!(refused.verdict().pass && refused.time < 7.0);

    let mut accepted = pull_over_run(Expectation::Refusal);
    accepted.tick(&aimed());
    accepted.tick(&decision(bound(OWN, -1.0, 1.0), 20.0));
    accepted.drive(61.0, |t| ego(10.0 + t, 0.0, 0.0, 1.0), |_| Vec::new());
    assert_eq!(accepted.ending(), Some(Ending::Timeout));
    assert!(!accepted.verdict().pass);

    let mut idle = pull_over_run(Expectation::Refusal);
    idle.tick(&decision(bound(OWN, -1.0, 1.0), 20.0));
    idle.drive(61.0, |_| ego(10.0, 0.0, 0.0, 0.0), |_| Vec::new());
    assert_eq!(idle.ending(), Some(Ending::Refused));
    assert!(
        !idle.verdict().pass && idle.verdict().summary.contains("standstill"),
        "stood for nothing"
    );
}

#[test]
fn standing_behind_a_blocker_needs_an_approach_and_a_decent_gap() {
    let stand = |approach: f64, gap: f64, v: f64, duration: f64| {
        let mut run = Run::new(scenario(&[Pose::new(0.0, 0.0, 0.0)], Expectation::Standstill));
        let answer = decision(bound(OWN, -1.0, 1.0), 20.0);
        let cause = StopCause::Blocked(ObstacleId(0));
        run.tick(&Decision {
            stop: Some(Stop { distance: 0.0, cause }),
            ..answer
        });
        let x = 10.0 + approach;
        let car = motion(x + 3.89 + gap + 2.25, 1.0, 0.0, 0.0);
        run.drive(duration, |_| ego(x, 0.0, 0.0, v), |_| vec![car]);
        run.ending()
    };
    let done = Some(Ending::StoodStill);
    assert_eq!(stand(30.0, 6.0, 0.0, 3.3), done);
    assert_eq!(stand(30.0, 6.0, 0.0, 2.9), None, "not for 3 s yet");
    assert_eq!(stand(30.0, 6.0, 0.051, 4.0), None, "still rolls");
    assert_eq!(
        (stand(30.0, 1.01, 0.0, 4.0), stand(30.0, 0.99, 0.0, 4.0)),
        (done, None)
    );
    assert_eq!(
        (stand(30.0, 9.99, 0.0, 4.0), stand(30.0, 10.01, 0.0, 4.0)),
        (done, None)
    );
    assert_eq!(
        (stand(5.01, 6.0, 0.0, 4.0), stand(4.99, 6.0, 0.0, 4.0)),
        (done, None)
    );
}

#[test]
fn time_runs_out() {
    let mut run = Run::new(scenario(&[], Expectation::Progress(1000.0)));
    run.tick(&decision(bound(OWN, -1.0, 1.0), 20.0));
    run.drive(100.0, |t| ego(10.0 + t, 0.0, 0.0, 1.0), |_| Vec::new());
    assert_eq!(run.ending(), Some(Ending::Timeout));
    assert!((run.time - 60.0).abs() < 0.011 && !run.verdict().pass);
    assert!(
        run.verdict().summary.starts_with("failed: "),
        "{}",
        run.verdict().summary
    );
}
