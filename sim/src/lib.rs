//! The closed loop: a world, a tracker, a monitor, and what records and repeats their runs.

pub mod explain;
pub mod trace;
pub mod verdict;
pub mod view;
