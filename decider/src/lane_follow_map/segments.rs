//! Parts of lanes in a row, and what planning has to know about driving along them.
//!
//! `s` is metres along the list from its start, `l` metres to the left of the lanes' centre lines. Source: the
//! original's `modules/map/pnc_map/route_segments.cc`.

use crate::geometry::{Vec2, angle};
use crate::hd_map::{HdMap, LaneSegment, LaneWaypoint, SEGMENT_TOLERANCE};
use crate::road::Side;
use crate::routing::ChangeLaneType;
use std::f64::consts::FRAC_PI_2;
use std::fmt;

/// How far aside a place may be to be driven from, m: two wide lanes.
const MAX_ASIDE: f64 = 20.0;

/// Largest gap between the edges of two lanes to change between, m.
const MAX_LANE_GAP: f64 = 0.3;

/// Which passage of which road of the route.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct PassageId {
    /// Place of the road in the route.
    pub road: usize,
    /// Place of the passage in the road.
    pub passage: usize,
}

impl fmt::Display for PassageId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}_{}", self.road, self.passage)
    }
}

/// A way to drive: lanes in a row, with what the route says about them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RouteSegments {
    /// Parts of lanes in driving order.
    pub segments: Vec<LaneSegment>,
    /// The passage they extend.
    pub passage: PassageId,
    /// Whether going straight leads on to the next road.
    pub can_exit: bool,
    /// Whether the car is on them. Otherwise they are what it changes to.
    pub is_on_segment: bool,
    /// To which side they are to be left.
    pub next_action: ChangeLaneType,
    /// To which side the car changes to get on them.
    pub previous_action: ChangeLaneType,
    /// Whether the next place to pass is the destination.
    pub stop_for_destination: bool,
    /// Where the route leaves them or ends, if that is on them.
    pub route_end_waypoint: Option<LaneWaypoint>,
    /// The place on them that the car is at or beside.
    pub car: Option<LaneWaypoint>,
}

/// Where a point lies beside route segments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RouteProjection {
    /// Station along the list, m.
    pub s: f64,
    /// Offset to the left, m.
    pub l: f64,
    /// The same place on the centre line of its lane.
    pub waypoint: LaneWaypoint,
}

impl From<Vec<LaneSegment>> for RouteSegments {
    fn from(segments: Vec<LaneSegment>) -> Self {
        Self {
            segments,
            ..Self::default()
        }
    }
}

impl RouteSegments {
    /// Length of all segments, m.
    pub fn length(&self) -> f64 {
        self.segments.iter().map(LaneSegment::length).sum()
    }

    /// The start of the first segment.
    pub fn first_waypoint(&self) -> Option<LaneWaypoint> {
        let first = self.segments.first()?;
        Some(LaneWaypoint::on(first.lane, first.start_s))
    }

    /// The end of the last segment.
    pub fn last_waypoint(&self) -> Option<LaneWaypoint> {
        let last = self.segments.last()?;
        Some(LaneWaypoint::on(last.lane, last.end_s))
    }

    /// Whether a place lies on one of them, by lane and station alone.
    pub fn contains(&self, waypoint: &LaneWaypoint) -> bool {
        self.position(waypoint).is_some()
    }

    fn position(&self, waypoint: &LaneWaypoint) -> Option<usize> {
        self.segments
            .iter()
            .position(|segment| segment.contains(waypoint))
    }

    /// Segments with their stations along the list.
    fn with_stations(&self) -> impl Iterator<Item = (f64, &LaneSegment)> {
        let mut behind = 0.0;
        self.segments.iter().map(move |segment| {
            let s = behind;
            behind += segment.length();
            (s, segment)
        })
    }

    /// The place on the segment whose centre line passes `point` nearest, among those that it lies beside.
    pub fn project(&self, map: &HdMap, point: Vec2) -> Option<RouteProjection> {
        let mut best: Option<RouteProjection> = None;
        for (behind, segment) in self.with_stations() {
            let at = map.lane(segment.lane).project(point);
            let nearer = best.is_none_or(|best| at.l.abs() < best.l.abs());
            if segment.spans(at.s) && nearer {
                let s = at.s.min(segment.end_s).max(segment.start_s);
                best = Some(RouteProjection {
                    s: s - segment.start_s + behind,
                    l: at.l,
                    waypoint: LaneWaypoint::on(segment.lane, s),
                });
            }
        }
        best
    }

    /// The place at `s` along the list.
    pub fn waypoint_at(&self, s: f64) -> Option<LaneWaypoint> {
        let mut segments = self.with_stations();
        let (behind, segment) = segments.find(|(behind, segment)| {
            behind - SEGMENT_TOLERANCE < s && s < behind + segment.length() + SEGMENT_TOLERANCE
        })?;
        let s = s - behind + segment.start_s;
        Some(LaneWaypoint::on(
            segment.lane,
            s.min(segment.end_s).max(segment.start_s),
        ))
    }

    /// Whether an end of one list lies on the other.
    pub fn is_connected(&self, other: &Self) -> bool {
        let touches = |a: &Self, b: &Self| {
            let ends = [b.first_waypoint(), b.last_waypoint()];
            ends.iter().flatten().any(|end| a.contains(end))
        };
        touches(self, other) || touches(other, self)
    }

    /// Whether the car may change to these segments from a place on another lane: beside it, in the same direction,
    /// and with no gap between the lanes.
    pub fn can_drive_from(&self, map: &HdMap, waypoint: &LaneWaypoint) -> bool {
        if self.contains(waypoint) {
            return true;
        }
        let from = map.lane(waypoint.lane);
        let point = from.point_at(waypoint.s);
        let Some(at) = self.project(map, point) else {
            return false;
        };
        let (lane, s) = (map.lane(at.waypoint.lane), at.waypoint.s);
        let turn = angle::difference(from.heading_at(waypoint.s), lane.heading_at(s)).abs();
        let (from_width, width) = (from.width_at(waypoint.s), lane.width_at(s));
        let half_widths = match side_of(at.l) {
            Side::Right => from_width.0 + width.1,
            Side::Left => from_width.1 + width.0,
        };
        let distance = (point - lane.point_at(s)).norm();
        at.l.abs() <= MAX_ASIDE && turn <= FRAC_PI_2 && distance <= half_widths + MAX_LANE_GAP
    }

    /// Takes over what `other` has before and behind. Tells whether the two overlap.
    pub fn stitch(&mut self, other: &Self) -> bool {
        let Some(first) = self.first_waypoint() else {
            return false;
        };
        let mut overlap = other.first_waypoint().is_some_and(|start| self.contains(&start));
        if let Some(at) = other.position(&first) {
            widen(&mut self.segments[0], &other.segments[at]);
            self.segments.splice(0..0, other.segments[..at].iter().copied());
            overlap = true;
        }
        let (Some(last), Some(back)) = (self.last_waypoint(), self.segments.last_mut()) else {
            return overlap;
        };
        if let Some(at) = other.segments.iter().rposition(|segment| segment.contains(&last)) {
            widen(back, &other.segments[at]);
            self.segments.extend_from_slice(&other.segments[at + 1..]);
            overlap = true;
        }
        overlap
    }

    /// Cuts off what is more than `back` metres behind `s` and more than `forward` metres ahead. Changes nothing and
    /// returns `false` where `s` is not on the list.
    pub fn shrink(&mut self, s: f64, back: f64, forward: f64) -> bool {
        let Some(waypoint) = self.waypoint_at(s) else {
            return false;
        };
        self.cut_head(s - back);
        self.cut_tail(&waypoint, forward);
        true
    }

    /// Drops what is before `s`, and what is left of a segment when that is next to nothing.
    fn cut_head(&mut self, s: f64) {
        let (mut first, mut behind) = (0, 0.0);
        while let Some(segment) = self.segments.get(first)
            && behind + segment.length() < s
        {
            behind += segment.length();
            first += 1;
        }
        let Some(segment) = self.segments.get_mut(first) else {
            return;
        };
        segment.start_s = segment.start_s.max(s - behind + segment.start_s);
        let next_to_nothing = segment.length() < SEGMENT_TOLERANCE;
        self.segments.drain(..first + usize::from(next_to_nothing));
    }

    /// Keeps `forward` metres behind a place; all where the place has been cut off.
    fn cut_tail(&mut self, from: &LaneWaypoint, forward: f64) {
        let Some(at) = self.position(from) else { return };
        let mut left = forward;
        let mut start = from.s;
        for k in at..self.segments.len() {
            let segment = &mut self.segments[k];
            let length = segment.end_s - start;
            if length >= left {
                segment.end_s = start + left;
                self.segments.truncate(k + 1);
                return;
            }
            left -= length;
            start = self.segments.get(k + 1).map_or(0.0, |next| next.start_s);
        }
    }
}

/// On which side of the segments something with this offset is; straight on them counts as left.
fn side_of(l: f64) -> Side {
    if l < 0.0 { Side::Right } else { Side::Left }
}

fn widen(segment: &mut LaneSegment, other: &LaneSegment) {
    segment.start_s = segment.start_s.min(other.start_s);
    segment.end_s = segment.end_s.max(other.end_s);
}
