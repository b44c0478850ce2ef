//! Simple planners to hold others against: what none of them can do is what a scenario is hard by, what one of them can
//! do nobody should fail at.
//!
//! All three drive beside the reference line by the law of the Intelligent Driver Model and differ in what they see and
//! weigh. The *blind* one keeps to the line and its speed and sees nothing; the *IDM* one follows whatever is nearest in
//! its path; *PDM-Closed* (after Dauner et al., "Parting with misconceptions about learning-based vehicle motion
//! planning", 2023) simulates several speeds and offsets and drives the one that scores best. Obstacles are expected to
//! keep their velocity. None of them borrows or changes lanes or leaves the lane to pull over.
//!
//! Frenet frame of one line, metres and seconds; the reference point is the centre of the rear axle.

mod idm;
mod pdm_closed;
mod rollout;
mod score;
#[cfg(test)]
mod tests;
mod traffic;

pub use idm::{IdmLaw, Leader};
use pdm_closed::best_proposal;
pub use pdm_closed::{EMERGENCY, OFFSETS, SPEEDS};
pub use rollout::{Proposal, Rollout, STEP, STEPS, State};
pub use score::{Assessment, SCORED_STEPS, assess};
pub use traffic::Traffic;

use crate::frame::Obstacle;
use crate::geometry::frenet::FrenetMotion;
use crate::lattice::{LaneWidth, LineTable, PlanningTarget, Project};
use crate::vehicle::VehicleParams;
use serde::{Deserialize, Serialize};

/// The simple planners.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Baseline {
    /// Keeps its lane and its speed, sees nothing.
    Blind,
    /// Keeps its lane, follows what is nearest in its path.
    Idm,
    /// The best of several speeds and offsets, by forward simulation.
    PdmClosed,
}

/// What a plan along a line is made from.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// The line.
    pub line: &'a LineTable,
    /// Where the plan starts.
    pub initial: FrenetMotion,
    /// What the plan is for.
    pub target: PlanningTarget,
    /// The highest speed at a station, m/s.
    pub speed_limit: &'a dyn Fn(f64) -> f64,
    /// Distances from the line to the (left, right) edges of the road; `None` where they are not known.
    pub road_width: LaneWidth<'a>,
    /// Everything in the way or near it.
    pub obstacles: &'a [Obstacle],
    /// Frenet coordinates of points.
    pub project: Project<'a>,
    /// The ego.
    pub vehicle: &'a VehicleParams,
}

/// What a simple planner drives.
#[derive(Clone, Debug, PartialEq)]
pub struct Driven {
    /// The simulated drive.
    pub rollout: Rollout,
    /// Whether nothing but the hardest braking was left.
    pub is_emergency: bool,
}

impl Baseline {
    /// The drive that this planner chooses.
    pub fn drive(self, scene: &Scene) -> Driven {
        let along_line = Proposal {
            offset: 0.0,
            share: 1.0,
        };
        let calm = |rollout| Driven {
            rollout,
            is_emergency: false,
        };
        match self {
            Self::Blind => calm(Rollout::new(scene, &Traffic::default(), along_line)),
            Self::Idm => calm(Rollout::new(scene, &Traffic::new(scene), along_line)),
            Self::PdmClosed => best_proposal(scene, &Traffic::new(scene)),
        }
    }
}
