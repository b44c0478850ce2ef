//! `standstill`: how long the ego stands without a reason that the world confirms.
//!
//! A decider may claim any cause for its stop; only one that geometry bears out counts.

use super::measure::{LongestSpan, Measure};
use super::view::Sample;
use corridor_decider::decision::StopCause;
use corridor_decider::frame::Command;
use corridor_decider::reference_line::LineQuery;

/// Below this speed the ego stands, m/s.
const STANDS: f64 = 0.01;

/// How long it may stand for nothing, s.
pub(super) const LIMIT: f64 = 10.0;

/// How near an obstacle must be to be stopped for, m: the longest stop distance of the original, 10 m, and half a car.
const BLOCKER_NEAR: f64 = 15.0;

/// How near one that comes towards or across must be to be yielded to, m: 8 s of a borrow at the original's
/// 5 m/s, met half way by traffic at twice that, rounded down.
const YIELD_NEAR: f64 = 80.0;

/// How near a place must be to have been stopped at, m.
const PLACE_NEAR: f64 = 15.0;

/// Counts standing.
#[derive(Clone, Debug, Default)]
pub(super) struct StandstillWatch {
    idle: LongestSpan,
}

impl StandstillWatch {
    pub(super) fn sample(&mut self, sample: &Sample) {
        let idle = sample.ego().v.abs() < STANDS && !has_reason(sample);
        self.idle.sample(idle, sample.time());
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        vec![self.idle.measure("standstill")]
    }
}

/// Whether the ego has a reason to stand that is there to be seen.
fn has_reason(sample: &Sample) -> bool {
    let Some(plan) = sample.plan else { return false };
    let Some(stop) = plan.stop else { return false };
    let near = |id, limit| sample.gap(id).is_some_and(|gap| gap <= limit);
    match stop.cause {
        StopCause::Blocked(id) | StopCause::Follow(id) => near(id, BLOCKER_NEAR),
        StopCause::Yield(id) => near(id, YIELD_NEAR),
        StopCause::PullOver => plan
            .target
            .is_some_and(|target| (target.position - sample.ego().pose.position()).norm() <= PLACE_NEAR),
        StopCause::Destination => is_near_destination(sample, plan.command),
        StopCause::PathEnd | StopCause::SidePass | StopCause::LaneChangeUrgency => false,
    }
}

fn is_near_destination(sample: &Sample, command: Command) -> bool {
    let line = &sample.scenario.line;
    let mut ends = vec![line.length()];
    if let Some(distance) = sample.scenario.expect.goal() {
        ends.push(line.to_frenet(sample.scenario.ego.pose.position()).s + distance);
    }
    if let Command::PullOver(place) = command {
        ends.push(line.to_frenet(place).s);
    }
    ends.iter().any(|s| (s - sample.at.s).abs() <= PLACE_NEAR)
}
