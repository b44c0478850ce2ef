//! The same seeds twice: every job of a plan under two settings.
//!
//! The two runs of a pair are made one after the other on one thread, so that what else the machine does meets both
//! alike; their times can then be compared, though never repeated.

use super::{Job, Plan, SweepError, pool, row};
use crate::report::{Comparison, SweepRow};
use crate::settings::{SettingError, Settings};
use rayon::prelude::*;

/// Settings to run under; one of the two things compared.
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

/// Runs every job of a plan under both variants on `threads` threads (0: one per core). `done` hears of each finished
/// pair, in any order; the comparison does not depend on it.
///
/// # Errors
/// [`SweepError`] when the threads cannot be started.
pub fn compare(
    plan: &Plan,
    variants: &[Variant; 2],
    threads: usize,
    done: &(dyn Fn() + Sync),
) -> Result<Comparison, SweepError> {
    let run_pair = |job: &Job| -> [SweepRow; 2] {
        let pair = variants
            .each_ref()
            .map(|variant| row(plan, *job, &variant.settings, &variant.overrides));
        done();
        pair
    };
    let pairs = pool(threads)?.install(|| plan.jobs().par_iter().map(run_pair).collect());
    let names = variants.each_ref().map(|variant| variant.name.clone());
    Ok(Comparison::new(names, pairs))
}
