//! The closed loop: a world, a tracker, a monitor, and what records and repeats their runs.

pub mod agents;
pub mod monitor;
pub mod perception;
pub mod report;
pub mod sweep;
pub mod trace;
pub mod tracker;
pub mod verdict;
pub mod world;
