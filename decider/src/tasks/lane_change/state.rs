//! From when to when the ego changes lanes (the state machine of the original's `LANE_CHANGE_DECIDER`).
//!
//! `I` names a line from tick to tick; times are those of the frames, s.

use serde::{Deserialize, Serialize};

/// How far a change of lanes has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Under way.
    Changing,
    /// Given up. Nothing in this task gives up.
    Failed,
    /// Done, or never begun.
    Finished,
}

/// What is remembered of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Status<I> {
    /// How far it has come.
    pub phase: Phase,
    /// The line of the lane in which the ego was then, if there was one.
    pub line: Option<I>,
    /// Time of the last change of this, s.
    pub since: f64,
    /// Time at which a change last succeeded, if known, s.
    pub last_success: Option<f64>,
}

/// Settings; names are the original's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StateConfig {
    /// Whether the line to plan along first is chosen here.
    pub enable_prioritize_change_lane: bool,
    /// Whether lanes are always changed at once.
    pub reckless_change_lane: bool,
    /// After a success no other change begins for so long, s.
    pub change_lane_success_freeze_time: f64,
    /// After a failure no other change begins for so long, s.
    pub change_lane_fail_freeze_time: f64,
}

impl Default for StateConfig {
    fn default() -> Self {
        Self {
            enable_prioritize_change_lane: false,
            reckless_change_lane: false,
            change_lane_success_freeze_time: 1.5,
            change_lane_fail_freeze_time: 1.0,
        }
    }
}

/// A line offered in this tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line<I> {
    /// Which.
    pub id: I,
    /// Whether it leads into another lane.
    pub is_change_lane: bool,
}

/// Why no state follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LaneChangeError {
    /// There is no line.
    #[error("no reference line")]
    NoLine,
    /// All of several lines lead into other lanes.
    #[error("no reference line follows the lane of the ego")]
    NoOwnLine,
}

/// Takes the state on by one tick. Answers with the place of the line to plan along first, where that changes.
///
/// # Errors
///
/// When no line is the ego's own; the status stays as it was.
pub fn advance<I: Clone + PartialEq>(
    config: &StateConfig,
    status: &mut Option<Status<I>>,
    lines: &[Line<I>],
    now: f64,
) -> Result<Option<usize>, LaneChangeError> {
    let Some(first) = lines.first() else {
        return Err(LaneChangeError::NoLine);
    };
    let prioritize = |change: bool| {
        let place = lines.iter().position(|line| line.is_change_lane == change);
        place.filter(|_| config.enable_prioritize_change_lane)
    };
    if config.reckless_change_lane {
        return Ok(prioritize(true));
    }
    let own = || {
        lines
            .iter()
            .find(|line| !line.is_change_lane)
            .map(|line| &line.id)
    };
    let Some(status) = status else {
        *status = Some(Status {
            phase: Phase::Finished,
            line: own().cloned(),
            since: now,
            last_success: Some(now),
        });
        return Ok(None);
    };
    if lines.len() == 1 {
        if status.phase == Phase::Changing {
            status.enter(Phase::Finished, &first.id, now);
        }
        return Ok(None);
    }
    let own = own().ok_or(LaneChangeError::NoOwnLine)?;
    let waited = now - status.since;
    Ok(match status.phase {
        Phase::Changing if status.line.as_ref() == Some(own) => prioritize(true),
        Phase::Changing => {
            status.enter(Phase::Finished, own, now);
            prioritize(false)
        }
        Phase::Failed if waited < config.change_lane_fail_freeze_time => prioritize(false),
        // As in the original the order of the lines follows in the next tick.
        Phase::Failed => {
            status.enter(Phase::Changing, own, now);
            None
        }
        Phase::Finished if waited < config.change_lane_success_freeze_time => prioritize(false),
        Phase::Finished => {
            status.enter(Phase::Changing, own, now);
            prioritize(true)
        }
    })
}

impl<I: Clone> Status<I> {
    fn enter(&mut self, phase: Phase, line: &I, now: f64) {
        self.phase = phase;
        self.line = Some(line.clone());
        self.since = now;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OWN: Line<u8> = Line {
        id: 0,
        is_change_lane: false,
    };
    const TARGET: Line<u8> = Line {
        id: 1,
        is_change_lane: true,
    };

    #[test]
    fn a_change_begins_after_the_freeze_and_ends_in_the_other_lane() {
        let config = StateConfig {
            enable_prioritize_change_lane: true,
            ..StateConfig::default()
        };
        let mut status = None;
        let mut step = |lines: &[Line<u8>], now: f64| {
            let first = advance(&config, &mut status, lines, now).unwrap();
            (first, status.clone().unwrap().phase)
        };
        let both = [OWN, TARGET];
        assert_eq!(step(&both, 0.0), (None, Phase::Finished));
        assert_eq!(step(&both, 1.4), (Some(0), Phase::Finished));
        assert_eq!(step(&both, 1.5), (Some(1), Phase::Changing));
        assert_eq!(step(&both, 9.0), (Some(1), Phase::Changing));
        let there = [
            Line {
                id: 1,
                is_change_lane: false,
            },
            Line {
                id: 0,
                is_change_lane: true,
            },
        ];
        assert_eq!(step(&there, 9.1), (Some(0), Phase::Finished));
        assert_eq!(step(&there[..1], 20.0), (None, Phase::Finished));
    }

    #[test]
    fn without_an_own_line_nothing_changes() {
        let mut status = Some(Status {
            phase: Phase::Failed,
            line: Some(0),
            since: 0.0,
            last_success: None,
        });
        let before = status.clone();
        let config = StateConfig::default();
        assert_eq!(
            advance(&config, &mut status, &[TARGET, TARGET], 9.0),
            Err(LaneChangeError::NoOwnLine)
        );
        assert_eq!(
            advance(&config, &mut status, &[], 9.0),
            Err(LaneChangeError::NoLine)
        );
        assert_eq!(status, before);
    }
}
