//! The scores of two deciders, as means: what a leader board would show, with the range of their difference.

use super::Pair;
use crate::sweep::bootstrap::{self, Mean};
use crate::sweep::statistics::CONFIDENCE;
use serde::Serialize;

/// The scores in the order of the table.
const SCORES: [&str; 2] = ["nuplan_cls", "ext_cls"];

/// One score over all pairs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct ScoreRow {
    pub(super) name: &'static str,
    pub(super) pairs: usize,
    /// Mean of each.
    pub(super) means: [f64; 2],
    /// Mean of second minus first, with its range by the paired bootstrap.
    pub(super) difference: Mean,
}

/// A row for each score that any pair has.
pub(super) fn rows(pairs: &[Pair]) -> Vec<ScoreRow> {
    SCORES.iter().filter_map(|name| row(name, pairs)).collect()
}

fn row(name: &'static str, pairs: &[Pair]) -> Option<ScoreRow> {
    let both = |pair: &Pair| Some([pair[0].metric(name)?, pair[1].metric(name)?]);
    let values: Vec<[f64; 2]> = pairs.iter().filter_map(both).collect();
    let differences: Vec<f64> = values.iter().map(|[first, second]| second - first).collect();
    let average = |side: usize| values.iter().map(|pair| pair[side]).sum::<f64>() / values.len() as f64;
    Some(ScoreRow {
        name,
        pairs: values.len(),
        difference: bootstrap::mean(&differences, CONFIDENCE)?,
        means: [average(0), average(1)],
    })
}
