//! The comparison as JSON: nothing in it depends on the machine or the moment.

use super::super::{ReportError, SweepReport};
use super::outcomes::{Fourfold, OutcomeRow};
use super::quantities::QuantityRow;
use super::scores::ScoreRow;
use super::{ALPHA, Comparison, Harm, Pair, harm, is_judged};
use crate::sweep::RunResult;
use crate::sweep::statistics::CONFIDENCE;
use serde::Serialize;
use std::collections::BTreeMap;

/// Version of this layout.
const FORMAT: u32 = 1;

#[derive(Serialize)]
struct Document<'a> {
    format: u32,
    /// The first and the second.
    planners: &'a [String; 2],
    digests: [String; 2],
    safe: bool,
    pairs: u64,
    /// Pairs of which a run could not be made: not compared.
    broken: Vec<Broken<'a>>,
    /// Draws rejected, by reason: the same for both.
    rejected: &'a BTreeMap<String, u64>,
    alpha: f64,
    confidence: f64,
    tests: usize,
    outcomes: &'a [OutcomeRow],
    metrics: &'a [QuantityRow],
    scores: &'a [ScoreRow],
    scenarios: Vec<Split<'a>>,
    only_first: Vec<Regression<'a>>,
    only_second: Vec<Regression<'a>>,
}

#[derive(Serialize)]
struct Broken<'a> {
    scenario: &'a str,
    seed: u64,
    errors: [Option<&'a str>; 2],
}

/// How the runs of one scenario passed.
#[derive(Serialize)]
struct Split<'a> {
    scenario: &'a str,
    #[serde(flatten)]
    passed: Fourfold,
}

/// A pair that one passes and the other does not.
#[derive(Serialize)]
struct Regression<'a> {
    scenario: &'a str,
    seed: u64,
    harm: Harm,
    failure: &'a str,
    replay: &'a str,
}

/// The comparison as JSON text with a line break at its end.
///
/// # Errors
/// [`ReportError::Json`] when the writer fails.
pub fn comparison_to_json(comparison: &Comparison) -> Result<String, ReportError> {
    let reports = &comparison.reports;
    let broken = comparison.pairs().filter(|pair| !is_judged(pair));
    let document = Document {
        format: FORMAT,
        planners: &comparison.names,
        digests: reports.each_ref().map(SweepReport::digest),
        safe: comparison.is_safe(),
        pairs: reports[0].runs(),
        broken: broken.map(broken_pair).collect(),
        rejected: reports[0].rejected(),
        alpha: ALPHA,
        confidence: CONFIDENCE,
        tests: comparison.tests(),
        outcomes: &comparison.outcomes,
        metrics: &comparison.quantities,
        scores: &comparison.scores,
        scenarios: comparison
            .scenarios()
            .into_iter()
            .map(|(scenario, passed)| Split { scenario, passed })
            .collect(),
        only_first: regressions(comparison, 0),
        only_second: regressions(comparison, 1),
    };
    let mut text = serde_json::to_string_pretty(&document)?;
    text.push('\n');
    Ok(text)
}

fn broken_pair(pair: Pair<'_>) -> Broken<'_> {
    let [first, _] = pair;
    Broken {
        scenario: &first.scenario,
        seed: first.seed,
        errors: pair.map(|row| match &row.result {
            RunResult::Judged(_) => None,
            RunResult::Broken(reason) => Some(reason.as_str()),
        }),
    }
}

fn regressions(comparison: &Comparison, side: usize) -> Vec<Regression<'_>> {
    let pairs = comparison.passed_by_only(side).into_iter();
    pairs
        .map(|pair| {
            let failed = pair[1 - side];
            Regression {
                scenario: &failed.scenario,
                seed: failed.seed,
                harm: harm(failed),
                failure: failed.failure().unwrap_or_default(),
                replay: &failed.replay,
            }
        })
        .collect()
}
