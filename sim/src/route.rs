//! What the router tells the decider: the command of the moment and the lines to plan along.

use corridor_decider::frame::{Command, EgoState, FrameLine};
use corridor_decider::reference_line::{LineQuery, ReferenceLine};
use corridor_scenarios::Scenario;
use std::sync::Arc;

/// A scenario's route while it is driven.
#[derive(Clone, Debug)]
pub(crate) struct Route {
    line: Arc<ReferenceLine>,
    target: Option<Arc<ReferenceLine>>,
    command: Command,
    command_time: f64,
    cruise_speed: f64,
    /// Whether the ego has reached the lane to change to; it is its own lane from then on.
    changed: bool,
}

impl Route {
    pub(crate) fn new(scenario: &Scenario) -> Self {
        Self {
            line: Arc::clone(&scenario.line),
            target: scenario.target_line.clone(),
            command: scenario.command,
            command_time: scenario.command_time,
            cruise_speed: scenario.cruise_speed,
            changed: false,
        }
    }

    /// All lines that frames may hold, in the order that [`Route::places`] refers to.
    pub(crate) fn all_lines(&self) -> Vec<Arc<ReferenceLine>> {
        std::iter::once(&self.line).chain(&self.target).cloned().collect()
    }

    pub(crate) fn cruise_speed(&self) -> f64 {
        self.cruise_speed
    }

    /// The command, once it has been given.
    pub(crate) fn command(&self, time: f64) -> Command {
        if time >= self.command_time && !self.changed {
            self.command
        } else {
            Command::Cruise
        }
    }

    /// The ego's line and, while a change of lane is wanted and not done, the one to change to.
    pub(crate) fn lines(&mut self, ego: &EgoState, time: f64) -> Vec<FrameLine> {
        let own = |line: &Arc<ReferenceLine>| FrameLine {
            line: Arc::clone(line),
            is_change_lane: false,
        };
        let Some(target) = &self.target else {
            return vec![own(&self.line)];
        };
        self.changed |= is_in_lane(target, ego);
        match self.command(time) {
            _ if self.changed => vec![own(target)],
            Command::ChangeLane(_) => {
                vec![
                    own(&self.line),
                    FrameLine {
                        line: Arc::clone(target),
                        is_change_lane: true,
                    },
                ]
            }
            _ => vec![own(&self.line)],
        }
    }

    /// Places of a frame's lines among all lines, and whether each is a change of lane.
    pub(crate) fn places(&self, lines: &[FrameLine]) -> Vec<(usize, bool)> {
        let place = |line: &FrameLine| usize::from(!Arc::ptr_eq(&line.line, &self.line));
        lines
            .iter()
            .map(|line| (place(line), line.is_change_lane))
            .collect()
    }
}

/// Whether the ego's reference point is in the lane of a line.
fn is_in_lane(line: &ReferenceLine, ego: &EgoState) -> bool {
    let at = line.to_frenet(ego.pose.position());
    line.lane_width(at.s)
        .is_some_and(|(left, right)| at.l <= left && at.l >= -right)
}
