//! Planners: nothing but the order of the tasks.

mod braking;
mod choice;
mod lane_follow;
mod passing;

pub use lane_follow::Planner;
