//! `progress`, `progress_min`, `distance`: how far along the route the ego came.
//!
//! Metres along the scenario's line from the start. The wanted distance is the expectation's, the one to the place to
//! pull over at, or, for a goal given as a region, what is left of the line.

use super::measure::Measure;
use super::view::Sample;
use corridor_decider::frame::Command;
use corridor_decider::reference_line::LineQuery;
use corridor_scenarios::Scenario;
use corridor_scenarios::scenario::Expectation;

/// Floor under both distances, m: with nuPlan's 2 m a parked ego would pass on every route up to 10 m.
const FLOOR: f64 = 0.1;

/// Smallest share of the wanted distance (nuPlan).
pub(super) const MINIMUM: f64 = 0.2;

/// How near to the goal counts as there, m.
const GOAL_TOLERANCE: f64 = 3.0;

/// Half a lane, m: farther from the middle of the destination's lane the ego is in another one.
const LANE_REACH: f64 = 1.75;

/// Watches the way made.
#[derive(Clone, Copy, Debug)]
pub(super) struct ProgressWatch {
    start: f64,
    /// What there is to make, m; `None` where no place is given.
    wanted: Option<f64>,
    is_goal: bool,
    is_required: bool,
    /// Farthest from the line at which a goal at its end counts, m: a route leads to a lane, not beside it.
    reach: f64,
    made: f64,
    off: f64,
}

impl ProgressWatch {
    pub(super) fn new(scenario: &Scenario) -> Self {
        let start = scenario.line.to_frenet(scenario.ego.pose.position()).s;
        let goal = scenario.expect.goal();
        let wanted = wanted(scenario, start);
        Self {
            start,
            wanted,
            is_goal: goal.is_some(),
            is_required: goal.is_some() && !scenario.expect.allows_standstill(),
            reach: if scenario.provider.is_some() {
                LANE_REACH
            } else {
                f64::MAX
            },
            made: 0.0,
            off: 0.0,
        }
    }

    pub(super) fn sample(&mut self, sample: &Sample) {
        self.made = sample.at.s - self.start;
        self.off = sample.at.l.abs();
    }

    /// Metres made since the start.
    pub(super) fn made(&self) -> f64 {
        self.made
    }

    pub(super) fn is_at_goal(&self) -> bool {
        self.is_goal
            && self
                .wanted
                .is_some_and(|wanted| self.made >= wanted - GOAL_TOLERANCE)
            && self.off <= self.reach
    }

    fn ratio(&self) -> Option<f64> {
        let wanted = self.wanted?.max(FLOOR);
        if self.made < -FLOOR {
            return Some(0.0);
        }
        Some((self.made.max(FLOOR) / wanted).min(1.0))
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        let ratio = self.ratio();
        vec![
            Measure::new("progress_min", ratio).only_if(self.is_required),
            Measure::new("progress", ratio),
            Measure::new("distance", Some(self.made)),
        ]
    }
}

/// Metres to the place to get to, if one is given: a standstill, a refusal or a change of lanes has none.
fn wanted(scenario: &Scenario, start: f64) -> Option<f64> {
    let line = &scenario.line;
    match (&scenario.expect, scenario.command) {
        (Expectation::Progress(distance) | Expectation::ProgressOrStandstill(distance), _) => Some(*distance),
        (Expectation::Goal(_), _) => Some(line.length() - start),
        (Expectation::PulledOver | Expectation::PulledOverOrRefusal, Command::PullOver(place)) => {
            Some(line.to_frenet(place).s - start)
        }
        _ => None,
    }
}
