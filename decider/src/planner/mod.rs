//! Planners: nothing but the order of the tasks.

mod choice;
mod lane_follow;

pub use lane_follow::Planner;
