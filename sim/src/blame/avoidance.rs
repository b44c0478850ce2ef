//! Until when a bad end could still have been avoided, and by what.

use super::car::{CarState, Limits};
use super::recorder::Recording;
use super::search::{Answer, Grid, Question};
use super::witness::{Manoeuvre, Witness};
use crate::perception::SENSOR_RANGE;
use serde::{Deserialize, Serialize};
use std::fmt;

/// How long after the bad end a motion must survive, s: full braking from 60 km/h ends within it.
pub const AFTERMATH: f64 = 3.0;

/// By how much the car's body is drawn in on all sides in the search that calls a run unavoidable, m. What a
/// finer grid of motions would still find lies within this of a motion of the coarse one.
pub const SLACK: f64 = 0.1;

/// Steps of motions that one search may try: about a third of a second.
const BUDGET: usize = 60_000;

/// The same for the searches that decide whether a run was avoidable at all.
const LAST_BUDGET: usize = 300_000;

/// The first look back from the bad end, s. Each further one is half as far again.
const FIRST_LOOK: f64 = 0.2;
const FARTHER: f64 = 1.5;

/// Whether a bad end could have been avoided.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Avoidable {
    /// Yes.
    Yes {
        /// Until when, as far as is known, s; `None` when only another run shows it.
        until: Option<f64>,
        /// By what, from then on.
        by: Option<Manoeuvre>,
    },
    /// No motion within the car's limits survives.
    No,
    /// The search was ended after so many steps of motions.
    Unknown(usize),
    /// No motion survives, but one for a body smaller by [`SLACK`] does: too close to call.
    Narrow,
    /// Not a question of motions, and no other run shows that it could.
    Unasked,
}

impl Avoidable {
    /// Whether it certainly could.
    pub fn is_yes(&self) -> bool {
        matches!(self, Self::Yes { .. })
    }
}

impl fmt::Display for Avoidable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Yes {
                until: Some(until),
                by: Some(by),
            } => write!(f, "avoidable until {until:.1} s by {by}"),
            Self::Yes { .. } => f.write_str("avoidable, as another run shows"),
            Self::No => f.write_str("unavoidable"),
            Self::Unknown(tried) => write!(f, "unknown whether avoidable: {tried} steps of motions tried"),
            Self::Narrow => f.write_str("unknown whether avoidable: too close to call"),
            Self::Unasked => f.write_str("unknown whether avoidable"),
        }
    }
}

/// The question of one recorded run that ended badly at one sample.
#[derive(Clone, Copy, Debug)]
pub struct Inquest<'a> {
    recording: &'a Recording,
    grid: &'a Grid,
    limits: Limits,
    /// The bad end.
    event: usize,
    /// The first sample at which anything could have been done about it.
    earliest: usize,
    /// Samples of a planning tick.
    tick: usize,
}

impl<'a> Inquest<'a> {
    /// The inquest on a bad end at sample `event`, in which the obstacle at place `with` took part.
    pub fn new(
        recording: &'a Recording,
        grid: &'a Grid,
        event: usize,
        with: Option<usize>,
        period: f64,
    ) -> Self {
        let scenario = &recording.surroundings.scenario;
        let tick = super::search::samples_in(period, recording.surroundings.dt);
        let seen = |sample: &usize| {
            with.is_none_or(|obstacle| {
                let other = recording.surroundings.tracks[obstacle].pose(*sample).place;
                (other - recording.ego[*sample].pose.position()).norm() <= SENSOR_RANGE
            })
        };
        let mut ticks = (0..event.min(recording.ego.len())).step_by(tick);
        let fastest = recording.ego.iter().fold(0.0, |v: f64, ego| v.max(ego.v));
        Self {
            earliest: ticks.find(seen).unwrap_or(0),
            limits: Limits::of(&scenario.vehicle, fastest, scenario.cruise_speed),
            recording,
            grid,
            event,
            tick,
        }
    }

    /// The car's limits.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// A search for a motion that begins as the ego was at a sample.
    pub fn search(&self, from: usize, budget: usize, drawn_in: f64) -> Answer {
        let surroundings = &self.recording.surroundings;
        let aftermath = super::search::samples_in(AFTERMATH, surroundings.dt);
        let question = Question {
            surroundings,
            limits: &self.limits,
            grid: self.grid,
            body: surroundings.body().drawn_in(drawn_in),
            start: CarState::of(&self.recording.ego[from], &self.limits),
            samples: (from, self.event + aftermath),
            budget,
        };
        question.answer()
    }

    /// The answer: whether, until when and by what.
    pub fn answer(&self) -> Avoidable {
        match self.latest() {
            Some(witness) => self.avoidable_by(&witness),
            None => self.searched_to_the_end(),
        }
    }

    fn avoidable_by(&self, witness: &Witness) -> Avoidable {
        let surroundings = &self.recording.surroundings;
        debug_assert_eq!(witness.check(surroundings, &self.limits), Ok(()));
        // One sample earlier: a collision has already changed how the ego moves.
        let before = self.event.saturating_sub(1);
        let driven = &self.recording.ego[before];
        Avoidable::Yes {
            until: Some(self.recording.time_of(witness.first)),
            by: Some(witness.manoeuvre(surroundings, before, driven)),
        }
    }

    /// The motion that begins latest of those found. It looks back in growing strides until there is one, and then
    /// halves the last stride: who can be saved late can be saved earlier, by driving as in the run until then.
    pub fn latest(&self) -> Option<Witness> {
        let last_tick = self.event.saturating_sub(1) / self.tick * self.tick;
        let mut too_late = last_tick + self.tick;
        let mut back = FIRST_LOOK;
        loop {
            let ticks = super::search::samples_in(back, self.recording.time_of(self.tick)) * self.tick;
            let from = (last_tick + self.tick).saturating_sub(ticks).max(self.earliest);
            if let Answer::Survives(found) = self.search(from, BUDGET, 0.0) {
                return Some(self.between(found, too_late));
            }
            if from == self.earliest {
                return None;
            }
            too_late = from;
            back *= FARTHER;
        }
    }

    /// The latest motion found between one that survives and a sample that is too late.
    fn between(&self, mut found: Witness, mut too_late: usize) -> Witness {
        while too_late - found.first > self.tick {
            let middle = found.first + (too_late - found.first) / (2 * self.tick) * self.tick;
            match self.search(middle, BUDGET, 0.0) {
                Answer::Survives(later) => found = later,
                _ => too_late = middle,
            }
        }
        found
    }

    /// What can be said when no motion was found: the earliest moment is searched to the end, and then once more
    /// with a smaller body.
    fn searched_to_the_end(&self) -> Avoidable {
        match self.search(self.earliest, LAST_BUDGET, 0.0) {
            Answer::Survives(witness) => self.avoidable_by(&witness),
            Answer::Exhausted(tried) => Avoidable::Unknown(tried),
            Answer::Dies => match self.search(self.earliest, LAST_BUDGET, SLACK) {
                Answer::Dies => Avoidable::No,
                Answer::Survives(_) => Avoidable::Narrow,
                Answer::Exhausted(tried) => Avoidable::Unknown(tried),
            },
        }
    }
}
