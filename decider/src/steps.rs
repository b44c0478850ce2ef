//! A budget of steps, for whoever must be sure of an answer: a decider that never answers cannot be told from a slow one
//! by a clock without two runs of the same seed ending differently.
//!
//! A step is a round of something that goes on until it is satisfied: a task, an iteration of an optimiser, a column of a
//! search, a look at a sampled trajectory. The count is kept per thread and only under [`within`]; it never changes an
//! answer, it only ends the making of one. What loops without taking steps is not caught: a foreign decider needs a
//! fence of its own, a thread or a process that can be ended from outside, and its runs are then no longer bit-exact.

use std::cell::Cell;
use std::panic::resume_unwind;

thread_local! {
    /// Steps that are left to the one in the making; `None`: as many as it likes.
    static LEFT: Cell<Option<u64>> = const { Cell::new(None) };
}

/// What an answer that ran out of steps unwinds with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutOfSteps;

/// Gives the budget back at the end, be it by unwinding.
struct Restore(Option<u64>);

impl Drop for Restore {
    fn drop(&mut self) {
        LEFT.set(self.0);
    }
}

/// Makes an answer within a budget; also how many steps that took. Beyond it [`count`] unwinds with [`OutOfSteps`],
/// without a word of the panic hook: it is an outcome, and whoever gives the budget catches it.
pub fn within<T>(budget: u64, answer: impl FnOnce() -> T) -> (T, u64) {
    let _restore = Restore(LEFT.replace(Some(budget)));
    let answer = answer();
    (answer, budget - LEFT.get().unwrap_or(budget))
}

/// Takes one step.
///
/// # Panics
/// With [`OutOfSteps`] when none is left.
#[inline]
pub fn count() {
    match LEFT.get() {
        None => {}
        Some(0) => resume_unwind(Box::new(OutOfSteps)),
        Some(left) => LEFT.set(Some(left - 1)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::catch_unwind;

    fn take(steps: u64) -> u64 {
        (0..steps).for_each(|_| count());
        steps
    }

    #[test]
    fn the_budget_is_enough_to_the_step() {
        assert_eq!(within(3, || take(3)), (3, 3));
        let beyond = catch_unwind(|| within(3, || take(4)));
        assert!(beyond.unwrap_err().is::<OutOfSteps>());
        assert_eq!(
            take(100),
            100,
            "no budget is left behind, and without one nothing ends"
        );
    }

    #[test]
    fn a_budget_inside_another_ends_only_itself() {
        let (inner, outer) = within(5, || {
            take(2);
            let inner = catch_unwind(|| within(1, || take(2))).is_err();
            take(3);
            inner
        });
        assert_eq!((inner, outer), (true, 5));
    }
}
