//! Sweeps: many runs at once, and what can be said of them.

mod compare;
pub mod hunt;
pub mod paired;
mod plan;
pub mod signed_rank;
pub mod statistics;
mod stopwatch;

pub use compare::{Variant, compare};
pub use plan::{Job, Plan};
pub use stopwatch::{CycleTimes, Stopwatch};

use crate::decider;
use crate::report::{RunResult, SweepReport, SweepRow};
use crate::run::run_into;
use crate::settings::Settings;
use corridor_scenarios::{Drawn, Family};
use rayon::prelude::*;
use std::collections::BTreeMap;
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
        source: rayon::ThreadPoolBuildError,
    },
}

/// Runs every job of a plan on `threads` threads (0: one per core) and reports. `done` hears of each finished
/// run, in any order; the report does not depend on it.
///
/// # Errors
/// [`SweepError`] when the threads cannot be started.
pub fn sweep(
    plan: &Plan,
    settings: &Settings,
    overrides: &[String],
    threads: usize,
    done: &(dyn Fn(&SweepRow) + Sync),
) -> Result<SweepReport, SweepError> {
    let run_job = |job: &Job| {
        let row = row(plan, *job, settings, overrides);
        done(&row);
        row
    };
    let rows = pool(threads)?.install(|| plan.jobs().par_iter().map(run_job).collect());
    Ok(SweepReport::new(rows))
}

fn pool(threads: usize) -> Result<rayon::ThreadPool, SweepError> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|source| SweepError::Threads {
            jobs: threads,
            source,
        })
}

fn row(plan: &Plan, job: Job, settings: &Settings, overrides: &[String]) -> SweepRow {
    let (family, given) = plan.family(job);
    let row = SweepRow {
        scenario: family.name().to_owned(),
        seed: job.seed,
        result: RunResult::Broken(String::new()),
        has_goal: false,
        rejected: BTreeMap::new(),
        replay: replay_command(given, job.seed, overrides),
        wall_time: Duration::ZERO,
        cycles: CycleTimes::default(),
    };
    match family.draw(job.seed) {
        Ok(drawn) => judged(row, &drawn, settings),
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
    let mut watch = Stopwatch::default();
    // A decider that panics is judged; a panic of anything else breaks its own run and no other.
    let run = || {
        catch_unwind(AssertUnwindSafe(|| {
            run_into(&drawn.scenario, settings, &mut watch)
        }))
    };
    let (verdict, wall_time) = timed(run);
    let result = match verdict {
        Ok(Ok(verdict)) => RunResult::Judged(Box::new(verdict)),
        Ok(Err(error)) => RunResult::Broken(error.to_string()),
        Err(panic) => RunResult::Broken(format!("the testbed panicked: {}", decider::said(&*panic))),
    };
    let expect = &drawn.scenario.expect;
    SweepRow {
        result,
        has_goal: expect.goal().is_some() || expect.goal_region().is_some(),
        rejected,
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

/// The family of a row in a plan, to run it again with a trace.
pub fn find<'a>(plan: &'a Plan, row: &SweepRow) -> Option<&'a Family> {
    plan.families().find(|family| family.name() == row.scenario)
}
