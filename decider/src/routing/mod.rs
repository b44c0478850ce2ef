//! What a router answers: which lanes to drive, and where to change between them.

mod response;

pub use response::{ChangeLaneType, LaneSegment, LaneWaypoint, Passage, RoadSegment, RoutingResponse};
