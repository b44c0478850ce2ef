//! Places on lanes and parts of lanes, by handle.
//!
//! Stations are metres along a lane's centre line, `l` metres to its left. Source: the original's
//! `modules/map/pnc_map/path.h` and `route_segments.cc`.

use crate::road::LaneId;

/// How far beyond an end of a segment a waypoint still belongs to it, m.
pub const SEGMENT_TOLERANCE: f64 = 0.2;

/// A place in the frame of a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneWaypoint {
    /// The lane.
    pub lane: LaneId,
    /// Station on it, m.
    pub s: f64,
    /// Offset to the left of its centre line, m.
    pub l: f64,
}

impl LaneWaypoint {
    /// The place on the centre line of `lane` at `s`.
    pub fn on(lane: LaneId, s: f64) -> Self {
        Self { lane, s, l: 0.0 }
    }
}

/// A part of a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneSegment {
    /// The lane.
    pub lane: LaneId,
    /// First station, m.
    pub start_s: f64,
    /// Last station, m.
    pub end_s: f64,
}

impl LaneSegment {
    /// The part of `lane` between two stations.
    pub fn new(lane: LaneId, start_s: f64, end_s: f64) -> Self {
        Self { lane, start_s, end_s }
    }

    /// Its length, m.
    pub fn length(&self) -> f64 {
        self.end_s - self.start_s
    }

    /// Whether `s` lies on it, [`SEGMENT_TOLERANCE`] more to each side.
    pub fn spans(&self, s: f64) -> bool {
        self.start_s - SEGMENT_TOLERANCE <= s && s <= self.end_s + SEGMENT_TOLERANCE
    }

    /// Whether a place lies on it, by lane and station alone.
    pub fn contains(&self, waypoint: &LaneWaypoint) -> bool {
        self.lane == waypoint.lane && self.spans(waypoint.s)
    }
}
