//! Runs a trace again and compares every state hash.

use crate::closed_loop::Sink;
use crate::run;
use crate::settings::{SettingError, Settings};
use crate::trace::{TickRecord, Trace, TraceError};
use corridor_scenarios::{DrawError, Family, MapCache, ScenarioError};
use std::fmt;
use std::path::Path;

/// What came of a replay.
#[derive(Clone, Debug, PartialEq)]
pub enum Replayed {
    /// Every tick that the trace holds came out the same.
    Same {
        /// How many that are.
        ticks: usize,
        /// Whether the trace ends before the run did.
        truncated: bool,
    },
    /// They differ from a tick on.
    Differs {
        /// The first tick that differs.
        tick: u32,
        /// Its time, s.
        time: f64,
        /// The first part of it that differs.
        part: &'static str,
    },
    /// The runs have different numbers of ticks, equal up to the end of the shorter.
    Length {
        /// Ticks in the trace.
        traced: usize,
        /// Ticks now.
        now: usize,
    },
}

/// Why a trace cannot be run again.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReplayError {
    /// Its map cannot be read.
    #[error("the map in the trace: {0}")]
    Map(String),
    /// Its scenario cannot be read.
    #[error("the scenario in the trace: {0}")]
    Scenario(#[from] ScenarioError),
    /// Its seed cannot be drawn.
    #[error("the seed in the trace: {0}")]
    Draw(#[from] DrawError),
    /// Its settings are unknown.
    #[error("the settings in the trace: {0}")]
    Setting(#[from] SettingError),
    /// Comparing failed.
    #[error(transparent)]
    Trace(#[from] TraceError),
}

/// Runs the scenario of a trace again, from what the trace itself holds, and compares tick by tick.
///
/// # Errors
/// [`ReplayError`] when the trace does not hold a scenario that can be run.
pub fn replay(trace: &Trace) -> Result<Replayed, ReplayError> {
    let header = &trace.header;
    let settings = Settings::with(&header.overrides)?;
    let maps = MapCache::holding(&header.map).map_err(ReplayError::Map)?;
    let file = format!("{}.toml", header.scenario);
    let family = Family::parse_with(&header.source, &file, Path::new(""), &maps)?;
    let drawn = family.draw(header.seed)?;
    let mut comparison = Comparison {
        trace,
        ticks: 0,
        difference: None,
    };
    run::run_into(&drawn.scenario, &settings, &mut comparison)?;
    Ok(comparison.result())
}

struct Comparison<'a> {
    trace: &'a Trace,
    ticks: usize,
    difference: Option<Replayed>,
}

impl Sink for Comparison<'_> {
    fn tick(&mut self, now: &TickRecord) -> Result<(), TraceError> {
        if let Some(then) = self.trace.ticks.get(self.ticks)
            && self.difference.is_none()
            && let Some(part) = first_difference(then, now)
        {
            let (tick, time) = (now.frame.tick, now.frame.time);
            self.difference = Some(Replayed::Differs { tick, time, part });
        }
        self.ticks += 1;
        Ok(())
    }
}

impl Comparison<'_> {
    fn result(self) -> Replayed {
        let traced = self.trace.ticks.len();
        match self.difference {
            Some(difference) => difference,
            None if self.ticks == traced || (self.trace.truncated && self.ticks > traced) => Replayed::Same {
                ticks: traced,
                truncated: self.trace.truncated,
            },
            None => Replayed::Length {
                traced,
                now: self.ticks,
            },
        }
    }
}

/// The first part of a tick that differs, in the order in which it comes about.
fn first_difference(then: &TickRecord, now: &TickRecord) -> Option<&'static str> {
    let parts = [
        ("ego in the frame", then.frame.ego == now.frame.ego),
        (
            "obstacles in the frame",
            then.frame.obstacles == now.frame.obstacles,
        ),
        ("controls", then.controls == now.controls),
        ("state hash", then.hash == now.hash),
    ];
    parts.into_iter().find(|(_, same)| !same).map(|(part, _)| part)
}

impl fmt::Display for Replayed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Same {
                ticks,
                truncated: false,
            } => write!(f, "same: all {ticks} ticks, bit for bit"),
            Self::Same {
                ticks,
                truncated: true,
            } => {
                write!(f, "same: the {ticks} ticks of this cut-off trace, bit for bit")
            }
            Self::Differs { tick, time, part } => {
                write!(f, "differs from tick {tick} on (t = {time:.1} s): {part}")
            }
            Self::Length { traced, now } => {
                write!(
                    f,
                    "differs in length: {traced} ticks in the trace, {now} now; equal up to there"
                )
            }
        }
    }
}
