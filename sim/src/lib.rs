//! The closed loop: a world, a tracker, a monitor, and what records and repeats their runs.

pub mod agents;
pub mod perception;
#[cfg(test)]
pub(crate) mod testing;
pub mod trace;
pub mod tracker;
pub mod verdict;
pub mod world;
