//! The same seeds twice: every job of a plan under two settings.
//!
//! The two runs of a pair are made one after the other on one thread, so that what else the machine does meets both
//! alike; their times can then be compared, though never repeated.

use super::in_order::in_order;
use super::{Plan, SweepError, SweepRow, Variant, row};
use std::ops::ControlFlow;

/// Runs every job of a plan under both variants on `threads` threads (0: one per core) and hands the pairs to `take` in
/// the order of the plan.
///
/// # Errors
/// [`SweepError`] when the threads cannot be started.
pub fn compare(
    plan: &Plan,
    variants: &[Variant; 2],
    threads: usize,
    mut take: impl FnMut([SweepRow; 2]),
) -> Result<(), SweepError> {
    let run_pair = |nth| {
        variants
            .each_ref()
            .map(|variant| row(plan, plan.job(nth), variant))
    };
    in_order(threads, plan.len(), run_pair, |_, pair| {
        take(pair);
        ControlFlow::Continue(())
    })
}
