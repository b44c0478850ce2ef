//! The closed loop: a world, a tracker, a monitor, and what records and repeats their runs.

pub mod monitor;
pub mod report;
pub mod sweep;
pub mod trace;
pub mod verdict;
