//! What the runs of one scenario add up to.

use super::shares::Shares;
use crate::sweep::statistics::{CONFIDENCE, failure_rate_bound};
use crate::sweep::{RunResult, SweepRow};
use crate::verdict::Ending;
use serde::Serialize;
use std::cmp::Ordering;

/// The runs of one scenario.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScenarioSummary {
    /// Name of the scenario family.
    pub scenario: String,
    /// Runs in all.
    pub runs: u64,
    /// Runs that passed.
    pub passed: u64,
    /// Runs that could not be judged.
    pub broken: u64,
    /// Runs with a collision.
    pub collisions: u64,
    /// Runs with a collision for which the ego is to blame.
    pub at_fault: u64,
    /// Runs in which the ego left the road.
    pub off_road: u64,
    /// Median of the progress to a thousandth, where it was measured.
    pub progress: Option<f64>,
    /// Mean of nuPlan's closed-loop score.
    pub nuplan_cls: Option<f64>,
    /// Mean of the extended score.
    pub ext_cls: Option<f64>,
    /// Runs that were asked to pull over, and how many did.
    pub pull_overs: PullOvers,
    /// Upper bound of the failure rate at 95 %, from the judged runs.
    pub failure_rate_bound: f64,
    /// Rejected draws.
    pub rejected: u64,
    /// The seed of the worst run: a failed one, else the one that came nearest to an obstacle.
    pub worst_seed: Option<u64>,
    /// The seed whose run took longest in simulated time.
    pub longest_seed: Option<u64>,
    /// The seed whose run took longest on this machine.
    #[serde(skip)]
    pub slowest_seed: Option<u64>,
}

/// Pull-overs asked for and done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct PullOvers {
    /// Runs whose ending should have been a pull-over.
    pub asked: u64,
    /// Runs that ended in one.
    pub done: u64,
}

/// The sums from which a summary comes.
#[derive(Clone, Debug, Default)]
pub(super) struct Sums {
    pub(super) runs: u64,
    pub(super) passed: u64,
    pub(super) broken: u64,
    collisions: u64,
    at_fault: u64,
    off_road: u64,
    progress: Shares,
    nuplan_cls: Shares,
    ext_cls: Shares,
    pull_overs: PullOvers,
    rejected: u64,
    worst: Option<Marked<Badness>>,
    longest: Option<Marked<f64>>,
    slowest: Option<Marked<f64>>,
}

/// A run with what makes it stand out.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Marked<T> {
    mark: T,
    seed: u64,
}

/// Whether a run passed, and its clearance, m.
type Badness = (bool, f64);

impl Sums {
    /// Takes in a row of this scenario.
    pub(super) fn add(&mut self, row: &SweepRow) {
        let count = |wanted: bool| u64::from(wanted);
        self.runs += 1;
        self.passed += count(row.passed());
        self.broken += count(matches!(row.result, RunResult::Broken(_)));
        self.collisions += count(row.fails("no_collision"));
        self.at_fault += count(row.fails("no_at_fault_collision"));
        self.off_road += count(row.fails("drivable_area"));
        for (name, shares) in [
            ("progress", &mut self.progress),
            ("nuplan_cls", &mut self.nuplan_cls),
            ("ext_cls", &mut self.ext_cls),
        ] {
            row.metric(name).into_iter().for_each(|value| shares.add(value));
        }
        if row.metric("pull_over_success").is_some() {
            self.pull_overs.asked += 1;
            self.pull_overs.done += count(row.ending() == Some(Ending::PulledOver));
        }
        self.rejected += row.rejected.values().map(|n| u64::from(*n)).sum::<u64>();
        self.mark(row);
    }

    /// Keeps the runs that stand out; of equals, that of the smallest seed.
    fn mark(&mut self, row: &SweepRow) {
        let clearance = row.metric("min_clearance").unwrap_or(f64::INFINITY);
        let worse = |a: &Badness, b: &Badness| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1));
        let longer = |a: &f64, b: &f64| b.total_cmp(a);
        let duration = row.verdict().map_or(0.0, |verdict| verdict.duration);
        keep_first(&mut self.worst, (row.passed(), clearance), row.seed, worse);
        keep_first(&mut self.longest, duration, row.seed, longer);
        keep_first(&mut self.slowest, row.wall_time.as_secs_f64(), row.seed, longer);
    }

    /// What it comes to for the scenario of this name.
    pub(super) fn summary(&self, scenario: &str) -> ScenarioSummary {
        let judged = self.runs - self.broken;
        ScenarioSummary {
            scenario: scenario.to_owned(),
            runs: self.runs,
            passed: self.passed,
            broken: self.broken,
            collisions: self.collisions,
            at_fault: self.at_fault,
            off_road: self.off_road,
            progress: self.progress.median(),
            nuplan_cls: self.nuplan_cls.mean(),
            ext_cls: self.ext_cls.mean(),
            pull_overs: self.pull_overs,
            failure_rate_bound: failure_rate_bound(judged - self.passed, judged, CONFIDENCE),
            rejected: self.rejected,
            worst_seed: self.worst.map(|run| run.seed),
            longest_seed: self.longest.map(|run| run.seed),
            slowest_seed: self.slowest.map(|run| run.seed),
        }
    }
}

/// Keeps the run that comes first by `order`, then by its seed.
fn keep_first<T>(kept: &mut Option<Marked<T>>, mark: T, seed: u64, order: impl Fn(&T, &T) -> Ordering) {
    let comes_first = |best: &Marked<T>| order(&mark, &best.mark).then(seed.cmp(&best.seed)).is_lt();
    if kept.as_ref().is_none_or(comes_first) {
        *kept = Some(Marked { mark, seed });
    }
}
