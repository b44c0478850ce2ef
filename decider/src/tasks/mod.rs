//! The lane-follow tasks, one file or folder each.

pub mod lane_borrow;
pub mod lane_change;
pub mod object_decision;
pub mod path;
pub mod path_bounds;
pub mod rss;
pub mod scene;
pub mod speed;
pub mod speed_bounds;
pub mod speed_decider;
pub mod speed_heuristic;
pub mod start_point;
