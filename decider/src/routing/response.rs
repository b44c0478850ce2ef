//! A route as the original's routing answers it: roads of passages of lane segments.
//!
//! A road is a stretch of the route on which the same passages run side by side; a passage is a chain of lanes that is
//! driven without a change of lane. Lanes are named as their map names them, stations are metres along the lane.

use serde::{Deserialize, Serialize};

/// A whole route.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RoutingResponse {
    /// Its roads, in the order in which they are driven.
    pub roads: Vec<RoadSegment>,
    /// What it was asked for: the start, places to pass, the destination. `None` where the answer does not tell.
    pub way_points: Option<Vec<LaneWaypoint>>,
    /// Its length, m.
    pub distance: f64,
}

/// A stretch of a route with constant passages.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RoadSegment {
    /// Name of its road; may be empty.
    pub id: String,
    /// Its passages: where one comes from first, where one leaves last.
    pub passages: Vec<Passage>,
}

/// Lanes that are driven one after the other.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Passage {
    /// Its lanes.
    pub segments: Vec<LaneSegment>,
    /// Whether the next road is reached by going on straight.
    pub can_exit: bool,
    /// To which side one has to change where it is not.
    pub change_lane_type: ChangeLaneType,
}

/// A stretch of a lane.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LaneSegment {
    /// Name of the lane.
    pub lane: String,
    /// First station, m.
    pub start_s: f64,
    /// Last station, m.
    pub end_s: f64,
}

/// To which side a passage is left.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "SCREAMING_SNAKE_CASE")]
pub enum ChangeLaneType {
    /// Straight on.
    #[default]
    Forward,
    /// To the left.
    Left,
    /// To the right.
    Right,
}

/// A place on a lane that a route was asked to pass.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LaneWaypoint {
    /// Name of the lane, if the request names one.
    pub lane: Option<String>,
    /// Station on it, m.
    pub s: Option<f64>,
}
