//! The lattice planner's parts: sampled motions along and across a line, what they cost and whether they may be driven.
//!
//! After the article "Lattice planner" and Apollo's planner of that name: a bundle of longitudinal curves `s(t)` and one
//! of lateral curves `l(s)`; every pair of them is a trajectory, the cheapest that keeps the limits and touches nothing
//! is driven. What is defective in the original is put right: entries of the path-time graph own their corners and times,
//! curves to a stop point pass the stop filter, lengths are counted from the car, obstacles are looked at when the car is
//! there, and the last resort is checked like every other trajectory.
//!
//! Frenet frame of one line, metres and seconds; the reference point is the centre of the rear axle.

mod backup;
mod bundle;
mod collision;
mod combine;
mod config;
mod constraints;
mod cost;
mod curve;
mod end_conditions;
mod evaluator;
mod feasible_region;
mod grid;
mod guide;
mod lateral_bounds;
mod lateral_optimum;
mod line_table;
mod path_time_graph;
mod piecewise;
mod piecewise_acceleration;
mod plan;
mod prediction;
mod survey;
#[cfg(test)]
mod tests;

pub use backup::{BACKUP_DECELERATIONS, BackupPair, backup_order};
pub use bundle::{Kind, Longitudinal, lateral_bundle, longitudinal_bundle};
pub use collision::{CollisionEnvironment, Footprint, Near};
pub use combine::{LongitudinalTrack, Point, combine, path, trajectory};
pub use config::{LatticeConfig, Weights};
pub use constraints::{Violation, keeps_lateral_limits, keeps_longitudinal_limits, violation};
pub use cost::{Blocked, LateralProfile, LongitudinalCosts, Sampled, lateral_comfort};
pub use curve::{ConstantDeceleration, Curve};
pub use end_conditions::{EndCondition, cruise, lateral, path_time, stop};
pub use evaluator::{Evaluator, Pair, PairCosts, Surroundings, Unfit, keeps_stop, total_cost};
pub use feasible_region::FeasibleRegion;
pub use grid::{HORIZON, SAMPLES, TIMES};
pub use guide::{Braking, GuideError, braking_profile, guide_speeds};
pub use lateral_bounds::{StaticBox, lateral_bounds};
pub use lateral_optimum::lateral_optimum;
pub use line_table::{LineTable, foot_on};
pub use path_time_graph::{LaneWidth, PathTimeEntry, PathTimeGraph, Project, projection};
pub use piecewise::Piecewise;
pub use piecewise_acceleration::{PiecewiseAcceleration, PiecewiseError};
pub use plan::{Lattice, LineTask, Outcome, Planned, Rejection, Sizes};
pub use prediction::{PredictedMotion, motions_of, pose_at, projected_speed};
pub use survey::{Assessed, Survey};

/// What the plan is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanningTarget {
    /// Speed to drive where nothing stops the car, m/s.
    pub cruise_speed: f64,
    /// Station that the rear axle may not pass, m; `None` for none.
    pub stop_s: Option<f64>,
}
