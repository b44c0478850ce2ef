//! A routing answer: roads, their parallel passages, and the lanes of each, by name.
//!
//! Stations are metres along a lane from its start. Nothing here is checked against a map: that is the business of
//! whoever follows the route. Source: the original's `modules/common_msgs/routing_msgs/routing.proto`.

use crate::geometry::Vec2;
use serde::{Deserialize, Serialize};

/// A route from the first waypoint of a request, through all others, to the last.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RoutingResponse {
    /// Roads in driving order.
    pub roads: Vec<RoadSegment>,
    /// Where the request wanted to pass, in order: first the start, last the destination.
    pub waypoints: Vec<LaneWaypoint>,
}

/// A stretch of the route on which the same parallel passages can be used.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RoadSegment {
    /// Its name; may be empty.
    pub id: String,
    /// Passages in the order of the manoeuvre: the first is where the car comes from, the last where it must leave.
    pub passages: Vec<Passage>,
}

/// A chain of lanes that can be driven without a lane change.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Passage {
    /// Its lanes in driving order.
    pub segments: Vec<LaneSegment>,
    /// Whether going straight leads on to the next road.
    pub can_exit: bool,
    /// To which side the car must change to get where it can exit.
    pub change_lane_type: ChangeLaneType,
}

/// To which side a passage is to be left.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "SCREAMING_SNAKE_CASE")]
pub enum ChangeLaneType {
    /// To none: straight on.
    #[default]
    Forward,
    /// To the left.
    Left,
    /// To the right.
    Right,
}

/// A part of a lane.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LaneSegment {
    /// Name of the lane.
    pub lane: String,
    /// First station, m.
    pub start_s: f64,
    /// Last station, m.
    pub end_s: f64,
}

/// A place that a request names: on a lane, in the plane, or both.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LaneWaypoint {
    /// Name of the lane, if the request named one.
    pub lane: Option<String>,
    /// Station on that lane, m.
    pub s: Option<f64>,
    /// World position, m.
    pub position: Option<Vec2>,
    /// Heading there, rad.
    pub heading: Option<f64>,
}
