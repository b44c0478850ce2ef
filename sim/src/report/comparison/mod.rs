//! Two deciders on the same seeds: how often each outcome came about under both, one or neither, how far the metrics
//! differ, and which of it is more than chance.
//!
//! A pure function of the two runs of every pair, their wall times left out: equal on every machine.

mod json;
mod outcomes;
mod quantities;
mod scores;
mod table;
#[cfg(test)]
mod tests;

pub use json::comparison_to_json;
pub use table::comparison_to_table;

use super::SweepReport;
use crate::sweep::SweepRow;
use crate::sweep::paired::holm;
use crate::verdict::Ending;
use outcomes::{Fourfold, OutcomeRow};
use quantities::QuantityRow;
use scores::ScoreRow;
use serde::Serialize;
use std::collections::BTreeMap;

/// Chance of calling any difference significant where there is none.
const ALPHA: f64 = 0.05;

/// The runs of one scenario and seed under the first and the second.
type Pair<'a> = [&'a SweepRow; 2];

/// Whether both could be run: only then there is something to compare.
fn is_judged(pair: &Pair) -> bool {
    pair.iter().all(|row| row.verdict().is_some())
}

/// What the probability of a difference comes to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Test {
    /// Two-sided probability of so large a difference between equals.
    p: f64,
    /// The same corrected for the number of tests (Holm).
    p_holm: f64,
    /// Whether the corrected one is at most 0.05.
    significant: bool,
}

impl Test {
    fn new(p: f64) -> Self {
        Self {
            p,
            p_holm: p,
            significant: false,
        }
    }

    fn correct(&mut self, p_holm: f64) {
        self.p_holm = p_holm;
        self.significant = p_holm <= ALPHA;
    }
}

/// Runs of two deciders on the same seeds.
#[derive(Clone, Debug)]
pub struct Comparison {
    names: [String; 2],
    /// Both runs of a scenario and seed, in that order.
    pairs: Vec<[SweepRow; 2]>,
    reports: [SweepReport; 2],
    outcomes: Vec<OutcomeRow>,
    quantities: Vec<QuantityRow>,
    scores: Vec<ScoreRow>,
}

impl Comparison {
    /// Compares `pairs`, which may come in any order; both runs of a pair are of one scenario and seed.
    pub fn new(names: [String; 2], mut pairs: Vec<[SweepRow; 2]>) -> Self {
        let is_pair = |[a, b]: &[SweepRow; 2]| (&a.scenario, a.seed) == (&b.scenario, b.seed);
        debug_assert!(pairs.iter().all(is_pair), "a pair is of one scenario and seed");
        pairs.sort_by(|[a, _], [b, _]| a.scenario.cmp(&b.scenario).then(a.seed.cmp(&b.seed)));
        let judged: Vec<Pair> = pairs
            .iter()
            .map(<[SweepRow; 2]>::each_ref)
            .filter(is_judged)
            .collect();
        let mut outcomes = outcomes::rows(&judged);
        let mut quantities = quantities::rows(&judged);
        let scores = scores::rows(&judged);
        correct(&mut outcomes, &mut quantities);
        Self {
            names,
            reports: [0, 1].map(|side| pairs.iter().map(|pair| &pair[side]).collect()),
            pairs,
            outcomes,
            quantities,
            scores,
        }
    }

    /// What the two are called.
    pub fn names(&self) -> &[String; 2] {
        &self.names
    }

    /// The rows of the first or the second, by scenario and seed.
    pub fn rows(&self, side: usize) -> impl Iterator<Item = &SweepRow> {
        self.pairs.iter().map(move |pair| &pair[side])
    }

    /// The runs of each as a report of its own.
    pub fn reports(&self) -> &[SweepReport; 2] {
        &self.reports
    }

    /// Whether every run of both could be made and judged, its decider answered, and no collision was the ego's fault.
    /// Which of the two is better is a question and no gate.
    pub fn is_safe(&self) -> bool {
        self.pairs.iter().flatten().all(|row| harm(row) == Harm::None)
    }

    /// All pairs, by scenario and seed.
    fn pairs(&self) -> impl Iterator<Item = Pair<'_>> {
        self.pairs.iter().map(<[SweepRow; 2]>::each_ref)
    }

    /// Pairs of which only the run of `side` (0 or 1) passed: the worst end of the other first, and every scenario once
    /// before any is there twice.
    fn passed_by_only(&self, side: usize) -> Vec<Pair<'_>> {
        let other = 1 - side;
        let judged = self.pairs().filter(is_judged);
        let mut seen = BTreeMap::new();
        let mut found: Vec<(Harm, usize, Pair)> = judged
            .filter(|pair| pair[side].passed() && !pair[other].passed())
            .map(|pair| {
                let harm = harm(pair[other]);
                let before = seen.entry((harm, &pair[other].scenario)).or_insert(0);
                *before += 1;
                (harm, *before, pair)
            })
            .collect();
        // A stable sort: of equals, by scenario and seed.
        found.sort_by_key(|(harm, before, _)| (*harm, *before));
        found.into_iter().map(|(_, _, pair)| pair).collect()
    }

    /// How the judged pairs of each scenario passed, by the scenarios' names.
    fn scenarios(&self) -> Vec<(&str, Fourfold)> {
        let pairs: Vec<Pair> = self.pairs().collect();
        let groups = pairs.chunk_by(|a, b| a[0].scenario == b[0].scenario);
        let split = |group: &[Pair<'_>]| {
            let judged = group.iter().filter(|pair| is_judged(pair));
            Fourfold::of(judged.map(|pair| pair.map(SweepRow::passed)))
        };
        groups
            .map(|group| (group[0][0].scenario.as_str(), split(group)))
            .collect()
    }

    /// How many tests there were: what their probabilities are corrected for.
    fn tests(&self) -> usize {
        self.outcomes.len() + self.quantities.len()
    }
}

/// Corrects the probabilities of all rows for their number.
fn correct(outcomes: &mut [OutcomeRow], quantities: &mut [QuantityRow]) {
    let mut tests: Vec<&mut Test> = outcomes.iter_mut().map(|row| &mut row.test).collect();
    tests.extend(quantities.iter_mut().map(|row| &mut row.test));
    let raw: Vec<f64> = tests.iter().map(|test| test.p).collect();
    for (test, p) in tests.into_iter().zip(holm(&raw)) {
        test.correct(p);
    }
}

/// What a run that did not pass did, worst first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
enum Harm {
    /// A collision for which the ego is to blame.
    AtFault,
    /// The decider gave no sound answer.
    DeciderFailed,
    /// It could not be run.
    Broken,
    /// It passed, or failed in a way that hurts nobody, or was run into.
    None,
}

fn harm(row: &SweepRow) -> Harm {
    let Some(verdict) = row.verdict() else {
        return Harm::Broken;
    };
    if row.passes("no_at_fault_collision") == Some(false) {
        Harm::AtFault
    } else if verdict.ending == Ending::DeciderFailed {
        Harm::DeciderFailed
    } else {
        Harm::None
    }
}
