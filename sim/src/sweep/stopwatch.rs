//! How long the decider takes to answer, by the clock of this machine. Beside results, never in them.
//!
//! Times are counted in buckets that grow with them, so that a million cycles take no more room than a hundred and
//! those of many runs add up. Nanoseconds inside; the clock is read around the call, outside of the loop.

use crate::closed_loop::Sink;
use crate::trace::{TickRecord, TraceError};
use corridor_decider::planner::TaskName;
use std::collections::BTreeMap;
use std::time::Duration;

/// Buckets per doubling: a bucket is 2.2 % wide.
const PER_OCTAVE: f64 = 32.0;

/// Times of planning cycles.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CycleTimes {
    /// Cycles per bucket, by its number.
    counts: BTreeMap<u16, u64>,
    longest: Duration,
}

impl CycleTimes {
    /// Adds one cycle.
    pub fn add(&mut self, time: Duration) {
        let nanoseconds = (time.as_nanos() as f64).max(1.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "32 times the logarithm of at most 2^94"
        )]
        let bucket = (libm::log2(nanoseconds) * PER_OCTAVE).floor() as u16;
        *self.counts.entry(bucket).or_insert(0) += 1;
        self.longest = self.longest.max(time);
    }

    /// Adds the cycles of another run.
    pub fn merge(&mut self, other: &Self) {
        for (bucket, count) in &other.counts {
            *self.counts.entry(*bucket).or_insert(0) += count;
        }
        self.longest = self.longest.max(other.longest);
    }

    /// How many cycles there were.
    pub fn count(&self) -> u64 {
        self.counts.values().sum()
    }

    /// The time that `share` of the cycles did not exceed, to 2 %; of all of them, the longest. Zero without any cycle.
    pub fn quantile(&self, share: f64) -> Duration {
        let count = self.count();
        let mut seen = 0;
        for (bucket, in_bucket) in &self.counts {
            seen += in_bucket;
            if seen < count && seen as f64 >= share * count as f64 {
                let middle = libm::exp2((f64::from(*bucket) + 0.5) / PER_OCTAVE);
                return Duration::from_secs_f64(middle * 1e-9);
            }
        }
        self.longest
    }

    /// The longest cycle.
    pub fn longest(&self) -> Duration {
        self.longest
    }
}

/// Times every answer of a run, and each task on the way to it, and keeps nothing else.
#[expect(
    clippy::disallowed_types,
    reason = "how long a decision took is never part of it: the loop does not see this clock"
)]
#[derive(Debug, Default)]
pub struct Stopwatch {
    since: Option<std::time::Instant>,
    task_since: Option<std::time::Instant>,
    /// Whole answers.
    pub cycles: CycleTimes,
    /// Tasks, in the order in which they first ran.
    pub tasks: Vec<(TaskName, CycleTimes)>,
}

impl Stopwatch {
    fn of(&mut self, task: TaskName) -> &mut CycleTimes {
        let known = self.tasks.iter().position(|(of, _)| *of == task);
        let place = known.unwrap_or_else(|| {
            self.tasks.push((task, CycleTimes::default()));
            self.tasks.len() - 1
        });
        &mut self.tasks[place].1
    }
}

#[expect(clippy::disallowed_types, reason = "the clock is read outside of the loop")]
impl Sink for Stopwatch {
    fn tick(&mut self, _: &TickRecord) -> Result<(), TraceError> {
        Ok(())
    }

    fn deciding(&mut self) {
        self.since = Some(std::time::Instant::now());
    }

    fn decided(&mut self) {
        if let Some(since) = self.since.take() {
            self.cycles.add(since.elapsed());
        }
    }

    fn begins(&mut self, _: TaskName) {
        self.task_since = Some(std::time::Instant::now());
    }

    fn ended(&mut self, task: TaskName) {
        if let Some(since) = self.task_since.take() {
            self.of(task).add(since.elapsed());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(milliseconds: impl Iterator<Item = u64>) -> CycleTimes {
        let mut times = CycleTimes::default();
        milliseconds.for_each(|ms| times.add(Duration::from_millis(ms)));
        times
    }

    #[test]
    fn quantiles_are_those_of_the_sorted_times_to_a_bucket() {
        let times = times((1..=1000).rev());
        for (share, expected) in [(0.5, 500.0), (0.99, 990.0), (0.001, 1.0)] {
            let found = times.quantile(share).as_secs_f64() * 1e3;
            assert!((found / expected - 1.0).abs() < 0.023, "{share}: {found}");
        }
        assert_eq!(times.quantile(1.0), Duration::from_secs(1));
        assert_eq!((times.count(), times.longest()), (1000, Duration::from_secs(1)));
        assert_eq!(CycleTimes::default().quantile(0.5), Duration::ZERO);
    }

    #[test]
    fn runs_add_up() {
        let (all, mut odd) = (times(1..=100), times((1..=100).step_by(2)));
        odd.merge(&times((2..=100).step_by(2)));
        assert_eq!(all, odd);
    }

    #[test]
    fn any_time_has_its_bucket() {
        let mut times = CycleTimes::default();
        times.add(Duration::ZERO);
        times.add(Duration::MAX);
        assert_eq!(times.count(), 2);
        assert_eq!(times.quantile(1.0), times.longest());
    }
}
