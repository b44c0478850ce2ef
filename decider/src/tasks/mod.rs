//! The lane-follow tasks, one file or folder each.

pub mod lane_borrow;
pub mod lane_change;
pub mod object_decision;
pub mod path;
pub mod path_assessment;
pub mod path_bounds;
pub mod path_decider;
pub mod path_reuse;
pub mod piecewise_jerk_speed;
pub mod rss;
pub mod rule_based_stop;
pub mod scene;
pub mod speed_bounds;
pub mod speed_decider;
pub mod speed_heuristic;
pub mod start_point;

#[cfg(test)]
pub(crate) mod testing;
