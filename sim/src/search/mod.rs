//! Looks for failures of a family instead of waiting for them: where the last runs came close, the next ones look nearer.
//!
//! The family's own laws are searched in: a scenario is a place in the unit cube, the quantile of each of its numbers, so
//! what is found is as possible as what a seed draws. The place moves by the cross-entropy method (Rubinstein 1999): of a
//! generation the runs with the least margin shape the next. Generations are run side by side and taken in order; the same
//! call finds the same on every machine.

mod cross_entropy;
mod margin;

pub use margin::margin;

use crate::run::run;
use crate::settings::Settings;
use crate::sweep::{SweepError, in_order};
use crate::verdict::Verdict;
use corridor_scenarios::{Family, Scenario};
use cross_entropy::CrossEntropy;
use std::collections::BTreeMap;
use std::ops::ControlFlow;

/// How places are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Evenly, whatever was found: as a sweep does.
    Random,
    /// By the cross-entropy method.
    CrossEntropy,
}

/// What is searched, and how long.
#[derive(Clone, Debug)]
pub struct Search<'a> {
    /// The family.
    pub family: &'a Family,
    /// Under which settings.
    pub settings: &'a Settings,
    /// How places are chosen.
    pub method: Method,
    /// Most runs.
    pub budget: u32,
    /// Where the random numbers begin.
    pub seed: u64,
    /// Whether the first failure ends it.
    pub until_found: bool,
}

/// One scenario that was looked at.
#[derive(Clone, Debug)]
pub struct Look {
    /// The quantile of each number of the family, by key path.
    pub quantiles: BTreeMap<String, f64>,
    /// How it ended; none where these numbers make no possible scenario.
    pub verdict: Option<Verdict>,
    /// How near it came to a failure: 0 and below it is one.
    pub margin: f64,
}

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// Runs that were made.
    pub runs: u32,
    /// Places that make no possible scenario.
    pub impossible: u32,
    /// Runs that failed.
    pub failures: u32,
    /// How many runs it took until the first of them.
    pub first_failure: Option<u32>,
    /// The run with the least margin: the first one that failed, else the one that came nearest.
    pub worst: Option<Look>,
}

impl Search<'_> {
    /// Looks. On `threads` threads (0: one per core), which does not change what is found.
    ///
    /// # Errors
    /// [`SweepError`] when the threads cannot be started.
    #[expect(clippy::missing_panics_doc, reason = "a place of a list has its number in it")]
    pub fn look(&self, threads: usize) -> Result<Found, SweepError> {
        let keys = self.keys();
        let mut chooser = CrossEntropy::new(keys.len(), self.seed);
        let mut found = Found::default();
        while found.runs + found.impossible < self.budget && !(self.until_found && found.failures > 0) {
            let left = self.budget - found.runs - found.impossible;
            let places = match self.method {
                Method::CrossEntropy => chooser.generation(),
                Method::Random => chooser.evenly(),
            };
            let places = &places[..places.len().min(left as usize)];
            let mut looks = Vec::new();
            in_order(
                threads,
                places.len() as u64,
                |nth| {
                    self.at(
                        &keys,
                        &places[usize::try_from(nth).expect("a place in a generation")],
                    )
                },
                |_, look| {
                    found.add(&look);
                    looks.push(look);
                    ControlFlow::Continue(())
                },
            )?;
            let margins: Vec<f64> = looks.iter().map(|look| look.margin).collect();
            chooser.learn(places, &margins);
        }
        Ok(found)
    }

    /// The numbers of the family that can be moved.
    fn keys(&self) -> Vec<String> {
        let drawn = self.family.draw(self.seed);
        let parameters = drawn.map(|drawn| drawn.parameters).unwrap_or_default();
        parameters.into_iter().map(|parameter| parameter.key).collect()
    }

    fn at(&self, keys: &[String], place: &[f64]) -> Look {
        let quantiles: BTreeMap<String, f64> = keys.iter().cloned().zip(place.iter().copied()).collect();
        let drawn = self.family.draw_at(self.seed, &quantiles);
        let judge = |scenario: &Scenario| run(scenario, self.settings);
        let verdict = drawn.ok().map(|drawn| judge(&drawn.scenario));
        Look {
            margin: verdict.as_ref().map_or(f64::INFINITY, margin),
            quantiles,
            verdict,
        }
    }
}

impl Found {
    fn add(&mut self, look: &Look) {
        let Some(verdict) = &look.verdict else {
            self.impossible += 1;
            return;
        };
        self.runs += 1;
        if !verdict.pass {
            self.failures += 1;
            self.first_failure.get_or_insert(self.runs + self.impossible);
        }
        if self.worst.as_ref().is_none_or(|worst| look.margin < worst.margin) {
            self.worst = Some(look.clone());
        }
    }
}
