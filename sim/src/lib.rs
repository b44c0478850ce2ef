//! The closed loop: a world, a tracker, a monitor, and what records and repeats their runs.

pub mod agents;
pub mod blame;
mod both;
mod clock;
pub mod closed_loop;
pub mod decider;
pub mod explain;
pub mod faults;
pub mod map_drawing;
pub mod map_report;
pub mod monitor;
pub mod perception;
pub mod replay;
pub mod report;
mod route;
pub mod run;
pub mod search;
pub mod settings;
pub mod shrink;
pub mod signature;
mod story;
pub mod sweep;
#[cfg(test)]
pub(crate) mod testing;
pub mod trace;
pub mod tracker;
pub mod verdict;
pub mod view;
pub mod world;
