//! The closed loop: a world, a tracker, a monitor, and what records and repeats their runs.

pub mod trace;
pub mod verdict;
