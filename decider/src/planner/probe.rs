//! What is done to a planner from outside while it decides, and what is seen of it.

use super::task::{Part, TaskName};

/// Makes parts of a planner fail, or times its tasks: it may have the clock that no planner has.
pub trait Probe {
    /// Whether a part is to fail, whatever it would find.
    fn fails(&self, _: Part) -> bool {
        false
    }

    /// A task begins.
    fn begins(&mut self, _: TaskName) {}

    /// The task that began last has ended.
    fn ended(&mut self, _: TaskName) {}
}

/// Nothing is done and nothing seen.
impl Probe for () {}
