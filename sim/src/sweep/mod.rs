//! Sweeps: many runs at once, and what can be said of them.
//!
//! A plan names the runs; they are made side by side, and each becomes a row, handed on in the order of the plan and then
//! forgotten: reports add rows up, results files hold them.

pub mod bootstrap;
mod claim;
mod compare;
pub mod hunt;
mod in_order;
pub mod paired;
mod plan;
pub mod results;
mod row;
pub mod signed_rank;
pub mod statistics;
mod stopwatch;

pub use claim::{Claim, Standing};
pub use compare::compare;
pub use plan::{Job, Plan, Shard};
pub use row::{Judgement, RunResult, SweepRow, Tried};
pub use stopwatch::{CycleTimes, Stopwatch};

use crate::both::Both;
use crate::decider;
use crate::report::{Decided, Situation};
use crate::run::run_into;
use crate::settings::{SettingError, Settings};
use corridor_scenarios::Drawn;
pub(crate) use in_order::in_order;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Duration;

/// Why a sweep cannot start.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The threads could not be made.
    #[error("cannot start {jobs} threads: {source}")]
    Threads {
        /// How many were asked for.
        jobs: usize,
        /// What went wrong.
        source: std::io::Error,
    },
}

/// Settings to run under, and what to call them.
#[derive(Clone, Debug)]
pub struct Variant {
    /// What to call it.
    pub name: String,
    /// Its settings.
    pub settings: Settings,
    /// Those of them that are not the defaults, as the command line has them.
    pub overrides: Vec<String>,
}

impl Variant {
    /// The defaults with some settings made, in order.
    ///
    /// # Errors
    /// [`SettingError`] for the first one that cannot be made.
    pub fn new(name: &str, overrides: Vec<String>) -> Result<Self, SettingError> {
        Ok(Self {
            name: name.to_owned(),
            settings: Settings::with(&overrides)?,
            overrides,
        })
    }
}

/// Makes the runs of a plan from its run `from` on, on `threads` threads (0: one per core), and hands each row to `take`
/// in the order of the plan, until that breaks off. Rows do not depend on the number of threads.
///
/// # Errors
/// [`SweepError`] when the threads cannot be started.
pub fn sweep(
    plan: &Plan,
    from: u64,
    variant: &Variant,
    threads: usize,
    mut take: impl FnMut(SweepRow) -> ControlFlow<()>,
) -> Result<(), SweepError> {
    let count = plan.len().saturating_sub(from);
    let work = |nth| row(plan, plan.job(from + nth), variant);
    in_order(threads, count, work, |_, row| take(row))
}

/// All rows of a plan at once: for few of them.
///
/// # Errors
/// [`SweepError`] when the threads cannot be started.
pub fn rows(plan: &Plan, variant: &Variant, threads: usize) -> Result<Vec<SweepRow>, SweepError> {
    let mut rows = Vec::new();
    sweep(plan, 0, variant, threads, |row| {
        rows.push(row);
        ControlFlow::Continue(())
    })?;
    Ok(rows)
}

fn row(plan: &Plan, job: Job, variant: &Variant) -> SweepRow {
    let (family, given) = plan.family(job);
    let row = SweepRow {
        job: job.index,
        scenario: family.name().to_owned(),
        seed: job.seed,
        result: RunResult::Broken(String::new()),
        has_goal: false,
        rejected: BTreeMap::new(),
        tried: None,
        replay: replay_command(given, job.seed, &variant.overrides),
        wall_time: Duration::ZERO,
        cycles: CycleTimes::default(),
    };
    match family.draw(job.seed) {
        Ok(drawn) => judged(row, &drawn, &variant.settings),
        Err(error) => SweepRow {
            result: RunResult::Broken(error.to_string()),
            ..row
        },
    }
}

/// The row with what came of its run.
fn judged(row: SweepRow, drawn: &Drawn, settings: &Settings) -> SweepRow {
    let mut rejected = BTreeMap::new();
    for rejection in &drawn.rejected {
        *rejected.entry(rejection.reason().to_owned()).or_insert(0) += 1;
    }
    let (mut watch, mut decided) = (Stopwatch::default(), Decided::default());
    // A decider that panics is judged; a panic of anything else breaks its own run and no other.
    let run = || {
        catch_unwind(AssertUnwindSafe(|| {
            run_into(&drawn.scenario, settings, &mut Both(&mut watch, &mut decided))
        }))
    };
    let (verdict, wall_time) = timed(run);
    let result = match verdict {
        Ok(Ok(verdict)) => RunResult::Judged(Box::new(verdict.into())),
        Ok(Err(error)) => RunResult::Broken(error.to_string()),
        Err(panic) => RunResult::Broken(format!("the testbed panicked: {}", decider::said(&*panic))),
    };
    let expect = &drawn.scenario.expect;
    SweepRow {
        result,
        has_goal: expect.goal().is_some() || expect.goal_region().is_some(),
        rejected,
        tried: Some(Box::new(Tried {
            parameters: drawn.parameters.clone(),
            situation: Situation::of(&drawn.scenario),
            decided,
        })),
        wall_time,
        cycles: watch.cycles,
        ..row
    }
}

#[expect(
    clippy::disallowed_types,
    reason = "how long a run took stands beside its result, never in it"
)]
fn timed<T>(run: impl FnOnce() -> T) -> (T, Duration) {
    let start = std::time::Instant::now();
    let result = run();
    (result, start.elapsed())
}

/// The command that runs one job again.
fn replay_command(given: &str, seed: u64, overrides: &[String]) -> String {
    let mut command = format!("corridor run {given} --seed {seed}");
    for setting in overrides {
        let quote = if setting.contains(['"', '{', '[', ' ']) {
            "'"
        } else {
            ""
        };
        command.extend([" --set ", quote, setting.as_str(), quote]);
    }
    command
}
