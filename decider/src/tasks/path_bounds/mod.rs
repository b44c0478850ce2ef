//! `PATH_BOUNDS_DECIDER`: how far left and right the rear axle may be at each station ahead.

mod bound;
mod columns;

pub use bound::{Borrow, BoundPoint, EdgeCause, Label, LaneType, PathBound};
