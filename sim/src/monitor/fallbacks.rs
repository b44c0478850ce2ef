//! `fallback_ratio`, `fallback_longest` and a count per rung: how often a tick was not planned, what led there, what
//! was driven instead, for how long, and whether planning came back.

use super::measure::{LongestSpan, Measure};
use crate::verdict::FallbackCount;
use corridor_decider::decision::{Decision, Fallback, Outcome};
use corridor_decider::frame::Frame;
use corridor_decider::tasks::path_bounds::Label;

/// Largest share of ticks on a fallback in a situation that can be solved.
pub(super) const FALLBACK_LIMIT: f64 = 0.05;

/// Counts the ticks that were not planned.
#[derive(Clone, Debug, Default)]
pub(super) struct FallbackWatch {
    ticks: u32,
    fallen_back: u32,
    longest: LongestSpan,
    counts: Vec<FallbackCount>,
    /// The rung of the last tick and since when.
    current: Option<(Fallback, f64)>,
}

impl FallbackWatch {
    pub(super) fn tick(&mut self, frame: &Frame, decision: &Decision) {
        let label = decision.chosen.and_then(|k| decision.candidates.get(k));
        let in_fallback_bound = label.is_some_and(|candidate| candidate.bound.label == Label::Fallback);
        let falls_back = in_fallback_bound || !decision.outcome.is_planned();
        self.ticks += 1;
        self.fallen_back += u32::from(falls_back);
        self.longest.sample(falls_back, frame.time);
        match decision.fallback {
            Some(fallback) => self.count(fallback, decision.outcome, frame.time),
            None => {
                if self.current.take().is_some() {
                    self.counts.iter_mut().for_each(|count| count.recovered = true);
                }
            }
        }
    }

    fn count(&mut self, fallback: Fallback, outcome: Outcome, time: f64) {
        let since = match self.current {
            Some((same, since)) if same == fallback => since,
            _ => time,
        };
        self.current = Some((fallback, since));
        let is_same = |count: &&mut FallbackCount| count.fallback == fallback && count.outcome == outcome;
        match self.counts.iter_mut().find(is_same) {
            Some(count) => {
                count.ticks += 1;
                count.longest = count.longest.max(time - since);
                count.recovered = false;
            }
            None => self.counts.push(FallbackCount {
                outcome,
                fallback,
                ticks: 1,
                first: time,
                longest: time - since,
                recovered: false,
            }),
        }
    }

    /// One entry per rung and cause, in the order in which they first came up.
    pub(super) fn counts(&self) -> Vec<FallbackCount> {
        self.counts.clone()
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        let ratio = (self.ticks > 0).then(|| f64::from(self.fallen_back) / f64::from(self.ticks));
        vec![
            Measure::new("fallback_ratio", ratio),
            self.longest.measure("fallback_longest"),
        ]
    }
}
