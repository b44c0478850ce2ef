//! Work done side by side, its results taken one after the other in the order of the work.
//!
//! The threads take the jobs in their order and hand the results to the caller's thread, which takes them in that order,
//! too; who runs far ahead of the oldest job that is still being done waits. So what is held at a time does not grow with
//! the number of jobs, and what the caller makes of the results does not depend on the number of threads.

use super::SweepError;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, PoisonError, mpsc};
use std::thread;

/// How many results may wait for an older one, per thread: enough that one long run among short ones stops nobody.
const AHEAD_PER_THREAD: u64 = 64;

/// Which jobs may be begun.
struct Gate {
    /// The next job to begin, and how many results were taken.
    state: Mutex<(u64, u64)>,
    moved: Condvar,
    is_shut: AtomicBool,
    ahead: u64,
}

impl Gate {
    /// The next job; waits while it would be too far ahead. `None` when there is none left.
    fn enter(&self, end: u64) -> Option<u64> {
        let is_early = |(next, taken): &mut (u64, u64)| {
            *next < end && *next - *taken >= self.ahead && !self.is_shut.load(Ordering::SeqCst)
        };
        let state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let waited = self.moved.wait_while(state, is_early);
        let mut state = waited.unwrap_or_else(PoisonError::into_inner);
        if state.0 >= end || self.is_shut.load(Ordering::SeqCst) {
            return None;
        }
        state.0 += 1;
        Some(state.0 - 1)
    }

    fn taken(&self, count: u64) {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).1 = count;
        self.moved.notify_all();
    }

    fn shut(&self) {
        self.is_shut.store(true, Ordering::SeqCst);
        self.moved.notify_all();
    }
}

/// Does the jobs `0..count` on `threads` threads (0: one per core) and hands each result to `take`, in ascending order,
/// until that breaks off.
///
/// # Errors
/// [`SweepError`] when a thread cannot be started.
pub(crate) fn in_order<T: Send>(
    threads: usize,
    count: u64,
    work: impl Fn(u64) -> T + Sync,
    mut take: impl FnMut(u64, T) -> ControlFlow<()>,
) -> Result<(), SweepError> {
    let cores = || thread::available_parallelism().map_or(1, Into::into);
    let threads = if threads == 0 { cores() } else { threads };
    let gate = Gate {
        state: Mutex::new((0, 0)),
        moved: Condvar::new(),
        is_shut: AtomicBool::new(false),
        ahead: AHEAD_PER_THREAD * threads as u64,
    };
    thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        for _ in 0..threads.min(usize::try_from(count).unwrap_or(usize::MAX)) {
            let (sender, gate, work) = (sender.clone(), &gate, &work);
            let labour = move || {
                while let Some(job) = gate.enter(count) {
                    if sender.send((job, work(job))).is_err() {
                        break;
                    }
                }
            };
            if let Err(source) = thread::Builder::new().spawn_scoped(scope, labour) {
                gate.shut();
                return Err(SweepError::Threads {
                    jobs: threads,
                    source,
                });
            }
        }
        drop(sender);
        take_all(&receiver, &gate, &mut take);
        gate.shut();
        Ok(())
    })
}

/// Takes the results in the order of their jobs until none come or `take` breaks off.
fn take_all<T>(
    results: &mpsc::Receiver<(u64, T)>,
    gate: &Gate,
    take: &mut impl FnMut(u64, T) -> ControlFlow<()>,
) {
    let mut waiting = BTreeMap::new();
    let mut next = 0;
    for (job, result) in results {
        waiting.insert(job, result);
        while let Some(result) = waiting.remove(&next) {
            if take(next, result).is_break() {
                return;
            }
            next += 1;
        }
        gate.taken(next);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(threads: usize, count: u64, enough: u64) -> Vec<u64> {
        let mut taken = Vec::new();
        let work = |job: u64| {
            // Every seventh job takes long, so that others overtake it.
            let rounds = if job.is_multiple_of(7) { 20_000 } else { 10 };
            (0..rounds).fold(job, |sum, k| std::hint::black_box(sum ^ k ^ k))
        };
        let take = |job, result| {
            assert_eq!(job, result);
            taken.push(job);
            if taken.len() as u64 == enough {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        in_order(threads, count, work, take).unwrap();
        taken
    }

    #[test]
    fn results_come_in_order_for_any_number_of_threads() {
        for threads in [0, 1, 2, 5] {
            let expected: Vec<u64> = (0..1000).collect();
            assert_eq!(taken(threads, 1000, u64::MAX), expected, "{threads} threads");
            assert_eq!(taken(threads, 0, u64::MAX), Vec::<u64>::new());
        }
    }

    #[test]
    fn breaking_off_ends_it_whoever_waits() {
        for threads in [1, 3] {
            assert_eq!(taken(threads, u64::MAX, 300).len(), 300);
        }
    }

    #[test]
    fn nobody_runs_far_ahead_of_the_oldest() {
        use std::sync::atomic::AtomicU64;
        let (begun, most) = (AtomicU64::new(0), AtomicU64::new(0));
        let work = |_| begun.fetch_add(1, Ordering::SeqCst);
        let take = |job, _| {
            most.fetch_max(begun.load(Ordering::SeqCst) - job, Ordering::SeqCst);
            ControlFlow::Continue(())
        };
        in_order(2, 5000, work, take).unwrap();
        assert!(most.into_inner() <= 2 * AHEAD_PER_THREAD + 2);
    }
}
