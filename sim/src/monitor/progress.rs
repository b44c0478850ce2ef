//! `progress`, `progress_min`, `distance`: how far along the route the ego came.
//!
//! Metres along the scenario's line from the start. The wanted distance is the expectation's, else what is left of
//! the line.

use super::measure::Measure;
use super::view::Sample;
use corridor_decider::reference_line::LineQuery;
use corridor_scenarios::Scenario;

/// Floor under both distances, m: with nuPlan's 2 m a parked ego would pass on every route up to 10 m.
const FLOOR: f64 = 0.1;

/// Smallest share of the wanted distance (nuPlan).
const MINIMUM: f64 = 0.2;

/// How near to the goal counts as there, m.
const GOAL_TOLERANCE: f64 = 3.0;

/// Half a lane, m: farther from the middle of the destination's lane the ego is in another one.
const LANE_REACH: f64 = 1.75;

/// Watches the way made.
#[derive(Clone, Copy, Debug)]
pub(super) struct ProgressWatch {
    start: f64,
    wanted: f64,
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
        let wanted = goal.unwrap_or(scenario.line.length() - start);
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
        self.is_goal && self.made >= self.wanted - GOAL_TOLERANCE && self.off <= self.reach
    }

    fn ratio(&self) -> f64 {
        if self.made < -FLOOR {
            return 0.0;
        }
        (self.made.max(FLOOR) / self.wanted.max(FLOOR)).min(1.0)
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        let ratio = Some(self.ratio());
        let minimum = Measure::new("progress_min", ratio);
        vec![
            if self.is_required {
                minimum.at_least(MINIMUM).gate()
            } else {
                minimum
            },
            Measure::new("progress", ratio),
            Measure::new("distance", Some(self.made)),
        ]
    }
}
