//! What the decider remembers from tick to tick.
//!
//! A decision is a pure function of the frame and this; replaying the frames of a trace from the first one
//! rebuilds it.

use crate::decision::{PathPoint, Stop, TrajectoryPoint};
use crate::piecewise_jerk::Riccati;
use crate::tasks::lane_borrow::BorrowState;
use crate::tasks::lane_change::LaneChangeState;
use crate::tasks::path_bounds::{Label, Memory};
use crate::tasks::speed_decider::PedestrianTimers;

/// The decider's memory. Starts empty.
#[derive(Clone, Debug, Default)]
pub struct Context {
    /// Of the path bounds.
    pub bounds: Memory,
    /// Of the lane-borrow decider.
    pub borrow: BorrowState,
    /// Whether the car has stopped and looked before it went out of its lane (rule-based stop).
    pub has_looked: bool,
    /// Of the lane-change decider.
    pub lane_change: LaneChangeState,
    /// How long each person on foot has been stopped for (speed decider).
    pub pedestrians: PedestrianTimers,
    /// What the last tick slowed down for.
    pub stop: Option<Stop>,
    /// What the path optimiser knows of each bound since the last tick.
    pub path_solvers: Vec<(Label, Riccati)>,
    /// What the speed optimiser knows since the last tick.
    pub speed_solver: Riccati,
    /// The path of the last tick.
    pub path: Option<LastPath>,
    /// The trajectory of the last tick and the time it starts at.
    pub last: Option<LastTrajectory>,
    /// Since when ticks could not be planned at all, s; `None`: the last one was.
    pub blind_since: Option<f64>,
}

/// A path that is being driven.
#[derive(Clone, Debug, PartialEq)]
pub struct LastPath {
    /// Time of the frame that it was found for, s.
    pub time: f64,
    /// Label of the bound that it was found in.
    pub label: Label,
    /// Its points.
    pub points: Vec<PathPoint>,
}

/// A trajectory that is being driven.
#[derive(Clone, Debug, PartialEq)]
pub struct LastTrajectory {
    /// Time of the frame that it answers, s.
    pub time: f64,
    /// Its points.
    pub points: Vec<TrajectoryPoint>,
}

impl Context {
    /// What the path optimiser knows of one kind of bound.
    pub fn path_solver(&mut self, label: Label) -> &mut Riccati {
        let known = self.path_solvers.iter().position(|(of, _)| *of == label);
        let place = known.unwrap_or_else(|| {
            self.path_solvers.push((label, Riccati::new()));
            self.path_solvers.len() - 1
        });
        &mut self.path_solvers[place].1
    }
}
