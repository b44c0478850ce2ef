//! Planners: nothing but the order of the tasks.

mod baseline;
mod ground;
mod lane_follow;
mod lattice;
mod plan;
mod probe;
mod report;
mod stage;
mod task;

pub use baseline::BaselinePlanner;
pub use lane_follow::Planner;
pub use lattice::{LatticePlanner, LatticeSurvey, LineCost};
pub use plan::LinePlan;
pub use probe::Probe;
pub use stage::LANE_FOLLOW;
pub use task::{Part, TaskError, TaskName};
