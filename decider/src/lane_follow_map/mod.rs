//! Follows a route lane by lane: where on it the car is, and which lanes it can use from there.
//!
//! A [`LaneFollowMap`] takes a routing answer and, tick by tick, the state of the car, and tells the lanes to drive
//! along: those that the car is on, and those that it can change to. World frame, metres, radians; `l` to the left.
//! Source: the original's `modules/planning/pnc_map/lane_follow_map` (`modules/map/pnc_map/pnc_map.cc` before).

mod config;
mod extend;
mod route;
mod segments;
#[cfg(test)]
mod tests;
mod track;

pub use config::{LaneFollowConfig, LaneFollowQuirks};
pub use route::{LocatedWaypoint, Route, RouteEntry, RouteError};
pub use segments::{PassageId, RouteProjection, RouteSegments};
pub use track::{FollowError, LaneFollowMap, VehicleState};
