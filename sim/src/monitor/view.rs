//! What the monitor is shown: the true state of the world, in world coordinates, and nothing of who moves it.

use super::plan::Plan;
use corridor_decider::frame::{EgoState, ObstacleId};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2};
use corridor_decider::reference_line::SlPoint;
use corridor_scenarios::Scenario;

/// The world after one physics step.
#[derive(Clone, Copy)]
pub struct StepView<'a> {
    /// Seconds since the start of the run, at the end of the step.
    pub time: f64,
    /// The ego, at its rear axle.
    pub ego: &'a EgoState,
    /// The ground the ego covers.
    pub footprint: &'a ConvexPolygon,
    /// Smallest distance to an obstacle, m, and to which; `None` when nothing is near.
    pub clearance: Option<(f64, ObstacleId)>,
    /// Obstacles whose footprints overlap the ego's.
    pub overlapping: &'a [ObstacleId],
    /// Where the obstacles are.
    pub traffic: &'a dyn Traffic,
}

/// Where the obstacles of the scenario are at one moment.
pub trait Traffic {
    /// Motion of an obstacle of the scenario.
    fn motion(&self, id: ObstacleId) -> Motion;
}

/// Place and velocity of one obstacle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Its centre and heading.
    pub pose: Pose,
    /// Velocity of its centre in world axes, m/s.
    pub velocity: Vec2,
}

/// One moment at the sampling rate of the metrics.
#[derive(Clone, Copy)]
pub(super) struct Sample<'a> {
    pub(super) view: StepView<'a>,
    pub(super) scenario: &'a Scenario,
    /// The ego's rear axle on the scenario's line.
    pub(super) at: SlPoint,
    /// The same on the line planned along; on the scenario's where there is no plan.
    pub(super) planned: SlPoint,
    /// What was decided last.
    pub(super) plan: Option<&'a Plan>,
}

impl Sample<'_> {
    pub(super) fn time(&self) -> f64 {
        self.view.time
    }

    pub(super) fn ego(&self) -> &EgoState {
        self.view.ego
    }

    /// Outline of an obstacle now; `None` when the scenario has none such.
    pub(super) fn outline(&self, id: ObstacleId) -> Option<ConvexPolygon> {
        let obstacle = self.scenario.obstacles.get(id.0 as usize)?;
        Some(obstacle.shape.at(self.view.traffic.motion(id).pose))
    }

    /// Distance between the ego and an obstacle, m.
    pub(super) fn gap(&self, id: ObstacleId) -> Option<f64> {
        Some(self.view.footprint.distance(&self.outline(id)?))
    }
}
