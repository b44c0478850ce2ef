//! Map importers: files of other people's formats in, a [`RoadMap`](corridor_decider::road::RoadMap) out.
//!
//! A reader survives what real files contain and tells it as a warning; what it cannot read it refuses with the
//! line, the column and what would have been right. No input makes it panic or run without end.

pub mod apollo;
pub mod commonroad;
mod error;
pub mod lanelet2;
mod lanelets;
mod notes;
pub mod opendrive;
mod xml;

pub use error::{ImportError, TextPlace};
