//! A failing run made small: fewer obstacles, a shorter and simpler road, rounder numbers, and still the same failure.
//!
//! Delta debugging (Zeller, Hildebrandt 2002) on the scenario's own file: a step takes something away, and stays if the run
//! of what is left fails with the same signature. Steps are tried in a fixed order, the ones that gain most first, over
//! and over until none helps or the budget of runs is used up; so the same call gives the same file on every machine, and
//! a larger budget one that is at least as small. What no longer is a possible scenario costs no run.

mod document;
mod steps;
#[cfg(test)]
mod tests;

pub use document::Document;

use crate::run::run;
use crate::settings::Settings;
use crate::signature::Signature;
use corridor_scenarios::{DrawError, Family, MapCache, ScenarioError};
use std::path::Path;
use steps::Step;

/// Why a run cannot be shrunk.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ShrinkError {
    /// The seed gives no scenario.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The scenario with fixed numbers cannot be read.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// There is nothing to keep.
    #[error("the run passes: there is no failure to shrink")]
    Passes,
    /// The written-down scenario does something else.
    #[error("written down with fixed numbers, the run ends differently: {0}")]
    Differs(String),
}

/// What is asked of a smaller run.
#[derive(Clone, Debug)]
pub struct Demand<'a> {
    /// The settings under which it has to fail.
    pub settings: &'a Settings,
    /// Settings under which it has to pass, if any: a planted fault is only shown by a run that is sound without it.
    pub sound: Option<&'a Settings>,
    /// Whether the map stays: the one that a trace holds has no name that could be exchanged.
    pub keeps_map: bool,
}

/// How large a failing run is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Obstacles in it.
    pub obstacles: usize,
    /// Simulated time until it is over, s.
    pub duration: f64,
    /// Digits of all its numbers.
    pub digits: usize,
}

/// A failing run and what became of it.
#[derive(Clone, Debug)]
pub struct Shrunk {
    /// The scenario file.
    pub text: String,
    /// What failure it is.
    pub signature: Signature,
    /// Its size before and after.
    pub sizes: [Size; 2],
    /// How many runs it took.
    pub runs: u32,
}

/// Makes the run of `seed` small with at most `budget` runs.
///
/// # Errors
/// [`ShrinkError`] when it does not fail, or has no file of its own.
pub fn shrink(
    family: &Family,
    seed: u64,
    demand: &Demand,
    budget: u32,
    maps: &MapCache,
) -> Result<Shrunk, ShrinkError> {
    let document = Document::parse(&family.fixed(seed)?);
    let original = run(&family.draw(seed)?.scenario, demand.settings);
    let signature = original.signature.ok_or(ShrinkError::Passes)?;
    let mut search = Search {
        demand,
        maps,
        signature: &signature,
        left: budget,
    };
    let Some(start) = search.look(document)? else {
        return Err(ShrinkError::Differs(original.summary));
    };
    let before = start.size();
    let smallest = search.smallest_from(start);
    Ok(Shrunk {
        text: smallest.document.text(),
        sizes: [before, smallest.size()],
        runs: budget - search.left,
        signature,
    })
}

/// A scenario that fails as it should, and when.
#[derive(Clone, Debug)]
pub(crate) struct Failing {
    pub(crate) document: Document,
    pub(crate) duration: f64,
    /// How far along the route the ego is at the end, m from its start.
    pub(crate) driven: f64,
}

impl Failing {
    fn size(&self) -> Size {
        Size {
            obstacles: self.document.obstacles().len(),
            duration: self.duration,
            digits: self.document.digits(),
        }
    }
}

/// The runs that are made.
struct Search<'a> {
    demand: &'a Demand<'a>,
    maps: &'a MapCache,
    signature: &'a Signature,
    left: u32,
}

impl Search<'_> {
    /// Takes step after step until none helps.
    fn smallest_from(&mut self, mut best: Failing) -> Failing {
        loop {
            let mut has_gained = false;
            for step in Step::ALL {
                // The attempts of a step follow from what is there: after a gain they are made anew, from where they were.
                let mut place = 0;
                let is_kept = self.demand.keeps_map && step == Step::PlainMap;
                while let Some(attempt) = step.attempt(&best, self.signature, place).filter(|_| !is_kept) {
                    if self.left == 0 {
                        return best;
                    }
                    match self.look(attempt) {
                        Ok(Some(smaller)) => {
                            best = smaller;
                            has_gained = true;
                            place = step.after_gain(place);
                        }
                        _ => place += 1,
                    }
                }
            }
            if !has_gained {
                return best;
            }
        }
    }

    /// Runs a scenario; `None` when it is no longer the same failure.
    fn look(&mut self, document: Document) -> Result<Option<Failing>, ShrinkError> {
        let family = Family::parse_with(&document.text(), "shrunk.toml", Path::new(""), self.maps)?;
        let scenario = family.draw(0)?.scenario;
        self.left = self.left.saturating_sub(1);
        let verdict = run(&scenario, self.demand.settings);
        if verdict.signature.as_ref() != Some(self.signature) {
            return Ok(None);
        }
        if let Some(sound) = self.demand.sound {
            self.left = self.left.saturating_sub(1);
            if !run(&scenario, sound).pass {
                return Ok(None);
            }
        }
        let distance = verdict.metrics.iter().find(|metric| metric.name == "distance");
        Ok(Some(Failing {
            document,
            duration: verdict.duration,
            driven: distance.and_then(|metric| metric.value).unwrap_or(0.0),
        }))
    }
}
