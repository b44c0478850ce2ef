//! What is measured of a run as a number, compared pair by pair. SI units; names are those of the metrics of a verdict,
//! where there is one.
//!
//! A pair counts where both runs measured it: what one run gave no occasion to measure cannot be compared.

use super::{Pair, Test};
use crate::sweep::SweepRow;
use crate::sweep::paired::{Median, median};
use crate::sweep::signed_rank::signed_rank;
use crate::sweep::statistics::{CONFIDENCE, percentile};
use crate::verdict::Ending;
use serde::Serialize;

/// Differences are rounded to whole multiples of this: far below what any metric resolves, far above the error of a
/// subtraction, so that equal differences are equal.
const RESOLUTION: f64 = 1e-9;

/// Which value is the better one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Better {
    Larger,
    Smaller,
}

struct Quantity {
    name: &'static str,
    unit: &'static str,
    better: Better,
    of: fn(&SweepRow) -> Option<f64>,
}

const fn quantity(
    name: &'static str,
    unit: &'static str,
    better: Better,
    of: fn(&SweepRow) -> Option<f64>,
) -> Quantity {
    Quantity {
        name,
        unit,
        better,
        of,
    }
}

/// The quantities in the order of the table.
const QUANTITIES: [Quantity; 16] = [
    quantity("progress", "", Better::Larger, |row| {
        metric_to_goal(row, "progress")
    }),
    quantity("time_to_goal", "s", Better::Smaller, time_to_goal),
    quantity("nuplan_cls", "", Better::Larger, |row| {
        metric_to_goal(row, "nuplan_cls")
    }),
    quantity("comfort", "", Better::Smaller, |row| row.metric("comfort")),
    quantity("lon_acceleration", "m/s²", Better::Smaller, lon_acceleration),
    quantity("lon_jerk", "m/s³", Better::Smaller, |row| row.metric("lon_jerk")),
    quantity("lateral_acceleration", "m/s²", Better::Smaller, |row| {
        row.metric("lateral_acceleration")
    }),
    quantity("min_clearance", "m", Better::Larger, |row| {
        row.metric("min_clearance")
    }),
    quantity("lane_keep", "s", Better::Smaller, |row| row.metric("lane_keep")),
    quantity("standstill", "s", Better::Smaller, |row| row.metric("standstill")),
    quantity("tracking_error", "m", Better::Smaller, |row| {
        row.metric("tracking_error")
    }),
    quantity("fallback_ratio", "", Better::Smaller, |row| {
        row.metric("fallback_ratio")
    }),
    quantity("pull_over_s_error", "m", Better::Smaller, |row| {
        row.metric("pull_over_s_error").map(f64::abs)
    }),
    quantity("pull_over_l_error", "m", Better::Smaller, |row| {
        row.metric("pull_over_l_error")
    }),
    quantity("pull_over_theta_error", "rad", Better::Smaller, |row| {
        row.metric("pull_over_theta_error")
    }),
    quantity("pull_over_edge_gap", "m", Better::Smaller, |row| {
        row.metric("pull_over_edge_gap").map(f64::abs)
    }),
];

/// A metric that rewards getting on, where that is what was asked: who fails to pull over gets on best.
fn metric_to_goal(row: &SweepRow, name: &str) -> Option<f64> {
    row.metric(name).filter(|_| row.has_goal)
}

/// How long the way to the goal took, s.
fn time_to_goal(row: &SweepRow) -> Option<f64> {
    let verdict = row.verdict()?;
    (verdict.ending == Ending::GoalReached).then_some(verdict.duration)
}

/// The strongest braking or acceleration, m/s².
fn lon_acceleration(row: &SweepRow) -> Option<f64> {
    Some(row.metric("braking")?.max(row.metric("acceleration")?))
}

/// One quantity over all pairs, tested by Wilcoxon's signed ranks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct QuantityRow {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    pub(super) better: Better,
    pub(super) pairs: usize,
    /// Pairs in which the first, the second and neither is better.
    pub(super) first_better: usize,
    pub(super) second_better: usize,
    pub(super) equal: usize,
    /// Median of each.
    pub(super) medians: [f64; 2],
    /// Median of second minus first.
    pub(super) difference: Median,
    #[serde(flatten)]
    pub(super) test: Test,
}

/// A row for each quantity that both runs of any pair measured.
pub(super) fn rows(pairs: &[Pair]) -> Vec<QuantityRow> {
    QUANTITIES
        .iter()
        .filter_map(|quantity| row(quantity, pairs))
        .collect()
}

fn row(quantity: &Quantity, pairs: &[Pair]) -> Option<QuantityRow> {
    let values: Vec<[f64; 2]> = pairs
        .iter()
        .filter_map(|pair| {
            let [first, second] = pair.map(quantity.of);
            Some([first?, second?]).filter(|values| values.iter().all(|v| v.is_finite()))
        })
        .collect();
    let column = |side: usize| values.iter().map(|pair| pair[side]).collect::<Vec<f64>>();
    let difference = |[first, second]: &[f64; 2]| ((second - first) / RESOLUTION).round() * RESOLUTION;
    let differences: Vec<f64> = values.iter().map(difference).collect();
    let larger = differences.iter().filter(|d| **d > 0.0).count();
    let smaller = differences.iter().filter(|d| **d < 0.0).count();
    let (first_better, second_better) = match quantity.better {
        Better::Larger => (smaller, larger),
        Better::Smaller => (larger, smaller),
    };
    Some(QuantityRow {
        name: quantity.name,
        unit: quantity.unit,
        better: quantity.better,
        pairs: values.len(),
        first_better,
        second_better,
        equal: values.len() - larger - smaller,
        medians: [percentile(&column(0), 50.0)?, percentile(&column(1), 50.0)?],
        difference: median(&differences, CONFIDENCE)?,
        test: Test::new(signed_rank(&differences)),
    })
}
