//! Whose fault a bad run is.
//!
//! A run that failed is asked four things. Was the ego to blame by nuPlan's rule: the monitor knows. Could it have been
//! avoided: a search over motions of the car ([`search`]) that knows the true futures and nothing of the decider.
//! Until when, and by what. And by whom: the same seed is run again with one link of the chain replaced, and the first
//! whose replacement saves the run is named, in the order of [`Link`].
//!
//! * [`Link::Scenario`]: no motion within the car's limits survives, and no replacement did.
//! * [`Link::Perception`]: it is saved by true futures in the place of predictions.
//! * [`Link::Tracker`]: it is saved by a car that follows without error.
//! * [`Link::Bound`], [`Link::Path`], [`Link::Speed`]: neither saves it, so it is the decision. Which part of it is told
//!   by the decision in force at the last moment from which the end could still be avoided, see [`inspect`].
//! * [`Link::Decider`]: it gave no answer, or none that is one.
//!
//! The other planner is run too: that it does better shows that better was possible. "Saved" means for a collision
//! and for leaving the road that neither happens, for every other failure that the run passes.

pub mod avoidance;
pub mod car;
pub mod inspect;
pub mod recorder;
pub mod search;
#[cfg(test)]
mod tests;
pub mod tracks;
pub mod witness;

use crate::agents;
use crate::run;
use crate::settings::{Prediction, Settings, Tracking};
use crate::verdict::{CollisionClass, Ending, Verdict};
use avoidance::{Avoidable, Inquest};
use car::{CarState, Limits};
use corridor_decider::config::PlannerKind;
use corridor_scenarios::Scenario;
use inspect::Inspection;
use recorder::Recording;
use search::Grid;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Time between two looks at the edge of the road, s: the monitor's.
const ROAD_PERIOD: f64 = 0.1;

/// A link of the chain from the road to the wheels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Link {
    /// Nobody could have done it.
    Scenario,
    /// What was expected of the others.
    Perception,
    /// Where the car was allowed to be.
    Bound,
    /// The path inside.
    Path,
    /// The speed along it.
    Speed,
    /// How it was followed.
    Tracker,
    /// The decider as a whole: it gave no answer.
    Decider,
}

/// What went wrong.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Failure {
    /// The ego met an obstacle.
    Collision {
        /// Its name.
        with: String,
        /// How, by nuPlan's classes.
        class: CollisionClass,
        /// Whether the ego is to blame, by nuPlan's rule.
        at_fault: bool,
    },
    /// It left the road.
    OffRoad,
    /// The decider gave no answer or none that is one.
    DeciderFailed,
    /// It ended in a way that was not expected.
    Ending(Ending),
    /// It ended as expected, but this gate failed.
    Gate(String),
}

/// What is replaced in a run of the same seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Replaced {
    /// Predictions by the true futures.
    Prediction,
    /// The tracker by one without error.
    Tracker,
    /// The planner by the other one.
    Planner,
}

/// A run of the same seed with one link replaced.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Replacement {
    /// What was replaced.
    pub replaced: Replaced,
    /// Whether that saves it.
    pub saves: bool,
    /// How it ended, in one sentence.
    pub summary: String,
}

/// The answer for one run that failed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Blame {
    /// What went wrong.
    pub failure: Failure,
    /// When, s.
    pub time: f64,
    /// Whether it could have been avoided.
    pub avoidable: Avoidable,
    /// The link that is to blame.
    pub whose: Link,
    /// The runs that were made to find out.
    pub runs: Vec<Replacement>,
}

/// Finds out whose fault the run of a scenario is; `None` when it passes.
pub fn blame(scenario: &Scenario, settings: &Settings) -> Option<Blame> {
    let recording = Recording::of(scenario, settings);
    if recording.verdict.pass {
        return None;
    }
    let (failure, event) = failure_of(&recording);
    let runs = replacements(scenario, settings, &failure);
    let avoidable = avoidable(&recording, settings, &failure, event, &runs);
    let whose = whose(&recording, &failure, event, avoidable, &runs);
    Some(Blame {
        time: recording.time_of(event),
        failure,
        avoidable,
        whose,
        runs,
    })
}

/// What went wrong first, and the sample at which it did.
fn failure_of(recording: &Recording) -> (Failure, usize) {
    let verdict = &recording.verdict;
    let last = recording.ego.len() - 1;
    let collision = verdict.collisions.first();
    let hit = collision.map(|c| recording.sample_at(c.time).min(last));
    if let Some(off) = first_off_road(recording).filter(|off| hit.is_none_or(|hit| *off < hit)) {
        return (Failure::OffRoad, off);
    }
    if let Some((collision, hit)) = collision.zip(hit) {
        let failure = Failure::Collision {
            with: collision.obstacle.clone(),
            class: collision.class,
            at_fault: collision.at_fault,
        };
        return (failure, hit);
    }
    let failed = verdict
        .metrics
        .iter()
        .find(|m| m.gate && !m.pass && m.name != "scenario_completed");
    let failure = match (verdict.ending, failed) {
        (Ending::DeciderFailed, _) => Failure::DeciderFailed,
        (_, Some(gate)) => {
            let at = gate.worst_t.map_or(last, |t| recording.sample_at(t).min(last));
            return (Failure::Gate(gate.name.clone()), at);
        }
        (ending, None) => Failure::Ending(ending),
    };
    (failure, last)
}

/// The first sample at which a corner is off the road, if that fails the run.
fn first_off_road(recording: &Recording) -> Option<usize> {
    let failed = |m: &&crate::verdict::Metric| m.name == "drivable_area" && !m.pass;
    recording.verdict.metrics.iter().find(failed)?;
    let surroundings = &recording.surroundings;
    let vehicle = &surroundings.scenario.vehicle;
    let limits = Limits::of(vehicle, 0.0, 0.0);
    let period = search::samples_in(ROAD_PERIOD, surroundings.dt);
    let mut samples = (0..recording.ego.len()).step_by(period);
    samples.find(|k| {
        let car = CarState::of(&recording.ego[*k], &limits);
        !surroundings.is_on_road_within(&car, tracks::OFF_ROAD)
    })
}

/// The runs of the same seed with one link replaced, those in which that changes anything.
fn replacements(scenario: &Scenario, settings: &Settings, failure: &Failure) -> Vec<Replacement> {
    let all = [Replaced::Prediction, Replaced::Tracker, Replaced::Planner];
    let changed = all.map(|replaced| (replaced, replaced.in_settings(settings)));
    // Where everybody stands or moves as recorded, predictions are the true futures already.
    let is_open = scenario.obstacles.iter().any(|o| !agents::is_predicted_truly(o));
    let new = changed
        .into_iter()
        .filter(|(replaced, changed)| changed != settings && (is_open || *replaced != Replaced::Prediction));
    new.map(|(replaced, changed)| {
        let verdict = run::run(scenario, &changed);
        Replacement {
            replaced,
            saves: is_saved(&verdict, failure),
            summary: verdict.summary,
        }
    })
    .collect()
}

impl Replaced {
    /// The settings with the link replaced.
    pub fn in_settings(self, settings: &Settings) -> Settings {
        let mut changed = settings.clone();
        match self {
            Self::Prediction => changed.prediction = Prediction::TrueFuture,
            Self::Tracker => changed.tracker = Tracking::Perfect,
            Self::Planner => {
                changed.decider.planner = match settings.decider.planner {
                    PlannerKind::LaneFollow => PlannerKind::Lattice,
                    _ => PlannerKind::LaneFollow,
                }
            }
        }
        changed
    }
}

/// Whether a failure does not happen in another run.
fn is_saved(verdict: &Verdict, failure: &Failure) -> bool {
    match failure {
        Failure::Collision { .. } | Failure::OffRoad => {
            let on_road = |m: &crate::verdict::Metric| m.name != "drivable_area" || m.pass;
            verdict.collisions.is_empty()
                && verdict.ending != Ending::DeciderFailed
                && verdict.metrics.iter().all(on_road)
        }
        _ => verdict.pass,
    }
}

/// Whether it could have been avoided. Another run that was saved shows that it could, whatever a search says.
fn avoidable(
    recording: &Recording,
    settings: &Settings,
    failure: &Failure,
    event: usize,
    runs: &[Replacement],
) -> Avoidable {
    let grid = Grid::default();
    let found = match failure {
        Failure::Collision { with, .. } => {
            let obstacles = &recording.surroundings.scenario.obstacles;
            let place = obstacles.iter().position(|o| o.name == *with);
            Inquest::new(recording, &grid, event, place, settings.tick).answer()
        }
        Failure::OffRoad => Inquest::new(recording, &grid, event, None, settings.tick).answer(),
        Failure::DeciderFailed | Failure::Ending(_) | Failure::Gate(_) => Avoidable::Unasked,
    };
    let shown = runs.iter().any(|run| run.saves);
    if shown && !found.is_yes() {
        return Avoidable::Yes {
            until: None,
            by: None,
        };
    }
    found
}

fn whose(
    recording: &Recording,
    failure: &Failure,
    event: usize,
    avoidable: Avoidable,
    runs: &[Replacement],
) -> Link {
    let saved_by = |replaced: Replaced| runs.iter().any(|run| run.replaced == replaced && run.saves);
    if *failure == Failure::DeciderFailed {
        Link::Decider
    } else if avoidable == Avoidable::No {
        Link::Scenario
    } else if saved_by(Replaced::Prediction) {
        Link::Perception
    } else if saved_by(Replaced::Tracker) {
        Link::Tracker
    } else {
        inspected(recording, failure, event, avoidable)
    }
}

/// The part of the decision that let it happen: of the last one that could still have been a better one.
fn inspected(recording: &Recording, failure: &Failure, event: usize, avoidable: Avoidable) -> Link {
    let time = match avoidable {
        Avoidable::Yes {
            until: Some(until), ..
        } => until,
        _ => recording.time_of(event),
    };
    let is_later = |(frame, _): &&(corridor_decider::frame::Frame, _)| frame.time > time + 1e-6;
    let ticks = &recording.ticks;
    let place = ticks
        .iter()
        .position(|tick| is_later(&tick))
        .unwrap_or(ticks.len());
    let Some((frame, decision)) = ticks.get(place.saturating_sub(1)) else {
        return Link::Decider;
    };
    let surroundings = &recording.surroundings;
    let inspection = Inspection {
        scenario: &surroundings.scenario,
        frame,
        decision,
    };
    match failure {
        Failure::Collision { with, .. } => {
            let known = surroundings.scenario.obstacles.iter().find(|o| o.name == *with);
            known.map_or(Link::Speed, |obstacle| {
                let met = surroundings.outline(obstacle.id, event);
                inspection.of_collision(obstacle.id, &met)
            })
        }
        Failure::OffRoad => inspection.of_road(),
        Failure::Gate(name) if name.contains("bound") || name.contains("block") => Link::Bound,
        Failure::Gate(name) if name.starts_with("path") || name.starts_with("driving") => Link::Path,
        Failure::DeciderFailed | Failure::Ending(_) | Failure::Gate(_) => inspection.of_standing(),
    }
}

impl fmt::Display for Link {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Scenario => "scenario",
            Self::Perception => "perception",
            Self::Bound => "bound",
            Self::Path => "path",
            Self::Speed => "speed",
            Self::Tracker => "tracker",
            Self::Decider => "decider",
        })
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Collision {
                with,
                class,
                at_fault,
            } => {
                let how = match class {
                    CollisionClass::StoppedEgo => "hit while standing by",
                    CollisionClass::StoppedTrack => "hit the standing",
                    CollisionClass::ActiveFront => "hit with its front",
                    CollisionClass::ActiveRear => "hit from behind by",
                    CollisionClass::ActiveLateral => "side by side with",
                };
                let fault = if *at_fault { "at fault" } else { "not at fault" };
                write!(f, "{how} `{with}`, {fault}")
            }
            Self::OffRoad => f.write_str("left the road"),
            Self::DeciderFailed => f.write_str("the decider failed"),
            Self::Ending(ending) => write!(f, "{}", ending_in_words(*ending)),
            Self::Gate(name) => write!(f, "`{name}` failed"),
        }
    }
}

fn ending_in_words(ending: Ending) -> &'static str {
    match ending {
        Ending::GoalReached => "reached the goal, which was not expected",
        Ending::PulledOver => "pulled over, which was not expected",
        Ending::LaneChanged => "changed lanes, which was not expected",
        Ending::Refused => "refused, which was not expected",
        Ending::StoodStill => "stood still, which was not expected",
        Ending::PulledOverBadly => "pulled over badly",
        Ending::Collision => "collided",
        Ending::Timeout => "ran out of time",
        Ending::DeciderFailed => "the decider failed",
    }
}

impl fmt::Display for Blame {
    /// One line for reports.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: {} at {:.1} s, {}",
            self.whose, self.failure, self.time, self.avoidable
        )
    }
}
