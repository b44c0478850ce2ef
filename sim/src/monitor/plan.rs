//! What the monitor remembers of a decision until the next one: the promise that the driving is held against.

use corridor_decider::decision::{Decision, Outcome, PullOverTarget, Stop, TrajectoryPoint};
use corridor_decider::frame::{Command, Frame};
use corridor_decider::reference_line::ReferenceLine;
use corridor_decider::tasks::path_bounds::{Borrow, Label, PathBound};
use std::sync::Arc;

/// The essence of one decision.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// Time of its frame, s.
    pub(super) time: f64,
    /// What the ego was asked to do.
    pub(super) command: Command,
    /// The line planned along; `None` when the decision names none of the frame's.
    pub(super) line: Option<Arc<ReferenceLine>>,
    /// The bound that is driven.
    pub(super) bound: Option<PathBound>,
    /// What the tracker follows, times from `time`.
    pub(super) trajectory: Vec<TrajectoryPoint>,
    pub(super) stop: Option<Stop>,
    pub(super) outcome: Outcome,
    pub(super) target: Option<PullOverTarget>,
}

impl Plan {
    pub(super) fn new(frame: &Frame, decision: &Decision) -> Self {
        let chosen = decision.chosen.and_then(|k| decision.candidates.get(k));
        Self {
            time: frame.time,
            command: frame.command,
            line: frame.lines.get(decision.line).map(|line| Arc::clone(&line.line)),
            bound: chosen.map(|candidate| candidate.bound.clone()),
            trajectory: decision.trajectory.clone(),
            stop: decision.stop,
            outcome: decision.outcome,
            target: decision.pull_over,
        }
    }

    /// The situation that is driven.
    pub(super) fn label(&self) -> Option<Label> {
        self.bound.as_ref().map(|bound| bound.label)
    }

    /// Whether the ego borrows another lane.
    pub(super) fn borrows(&self) -> bool {
        matches!(self.label(), Some(Label::Regular { borrow, .. }) if borrow != Borrow::None)
    }

    /// Whether the ego has a reason to be outside its lane: it borrows one, changes lanes or pulls over.
    pub(super) fn leaves_lane(&self) -> bool {
        self.borrows() || matches!(self.label(), Some(Label::PullOver | Label::LaneChange))
    }
}
