//! The lane-follow tasks, one file or folder each.

pub mod path_bounds;
