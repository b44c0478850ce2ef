//! What is done to a planner from outside while it decides, and what is seen of it.

use super::plan::LinePlan;
use super::task::{Part, TaskName};

/// Makes parts of a planner fail, changes what its tasks hand on, or times them: it may have the clock that no planner has.
pub trait Probe {
    /// Whether a part is to fail, whatever it would find.
    fn fails(&self, _: Part) -> bool {
        false
    }

    /// A task begins.
    fn begins(&mut self, _: TaskName) {}

    /// The task that began last has ended.
    fn ended(&mut self, _: TaskName) {}

    /// What a task that did not fail hands on to those after it.
    fn hands_on(&mut self, _: TaskName, _: &mut LinePlan) {}
}

/// Nothing is done and nothing seen.
impl Probe for () {}
