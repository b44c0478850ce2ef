//! Two sinks as one: each hears all, the first one first.

use crate::closed_loop::Sink;
use crate::trace::{TickRecord, TraceError};
use corridor_decider::frame::EgoState;
use corridor_decider::planner::TaskName;

/// Two sinks of one run.
#[derive(Debug)]
pub(crate) struct Both<'a, A, B>(pub(crate) &'a mut A, pub(crate) &'a mut B);

impl<A: Sink, B: Sink> Sink for Both<'_, A, B> {
    fn tick(&mut self, tick: &TickRecord) -> Result<(), TraceError> {
        self.0.tick(tick)?;
        self.1.tick(tick)
    }

    fn deciding(&mut self) {
        self.0.deciding();
        self.1.deciding();
    }

    fn decided(&mut self) {
        self.0.decided();
        self.1.decided();
    }

    fn begins(&mut self, task: TaskName) {
        self.0.begins(task);
        self.1.begins(task);
    }

    fn ended(&mut self, task: TaskName) {
        self.0.ended(task);
        self.1.ended(task);
    }

    fn stepped(&mut self, ego: &EgoState) {
        self.0.stepped(ego);
        self.1.stepped(ego);
    }
}
