//! One line along a whole route, changes of lane included: what a drive along it is measured by.
//!
//! On a road of several passages the line moves evenly from one to the next, where a driver might. It is not meant to be
//! planned along: that is what the lines of the single passages are for.

use super::line::{LineError, LineSample, ReferenceLine, sample};
use super::smooth;
use crate::geometry::{Vec2, angle, cross};
use crate::road::{LaneId, LanePoint, RoadMap};
use crate::routing::{Passage, RoadSegment, RoutingResponse};

/// Distance between cross-sections, m.
const STEP: f64 = 1.0;

/// Length over which the line moves from one passage to the next, m.
const CHANGE_LENGTH: f64 = 50.0;

/// A lane segment by handle.
type Segment = (LaneId, f64, f64);

/// A place on the line: on its nearest lane, and where it is.
struct Place {
    lane: LaneId,
    at: LanePoint,
    position: Vec2,
}

impl ReferenceLine {
    /// The line along a route and `beyond` metres on, and the station of the destination on it.
    ///
    /// # Errors
    /// [`LineError`] when the route holds nothing that this map has, or is too short.
    pub fn through(map: &RoadMap, route: &RoutingResponse, beyond: f64) -> Result<(Self, f64), LineError> {
        let mut places: Vec<Place> = Vec::new();
        for road in &route.roads {
            along_road(map, road, &mut places);
        }
        let destination = places.len().saturating_sub(1);
        if let Some(last) = places.last() {
            let (lane, s) = (last.lane, last.at.s);
            places.extend(straight_on(map, lane, s, beyond));
        }
        let positions: Vec<Vec2> = places.iter().map(|place| place.position).collect();
        if positions.len() < 2 {
            return Err(LineError::Empty);
        }
        let mut samples: Vec<LineSample> = Vec::with_capacity(places.len());
        for (place, point) in places.iter().zip(smooth::points(&positions)) {
            let mut next = sample(map, place.lane, &place.at);
            let (sin, cos) = angle::sin_cos(place.at.theta);
            let l = cross(Vec2::new(cos, sin), place.position - place.at.offset(0.0));
            next.point = point;
            next.offset = l;
            next.lane_width = (next.lane_width.0 - l, next.lane_width.1 + l);
            next.road_width = (next.road_width.0 - l, next.road_width.1 + l);
            next.s = samples.last().map_or(0.0, |last| {
                let step = (place.position - Vec2::new(last.point.x, last.point.y)).norm();
                last.s + step
            });
            samples.push(next);
        }
        let s = samples[destination].s;
        Ok((Self::checked(samples)?, s))
    }
}

/// Places along a road of the route. They begin a step behind the last one.
fn along_road(map: &RoadMap, road: &RoadSegment, places: &mut Vec<Place>) {
    let passages: Vec<Vec<Segment>> = road
        .passages
        .iter()
        .map(|passage| segments(map, passage))
        .collect();
    let passages: Vec<Vec<Segment>> = passages
        .into_iter()
        .filter(|segments| !segments.is_empty())
        .collect();
    let length = passages
        .iter()
        .map(|segments| length(segments))
        .fold(0.0, f64::max);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a length in metres, not negative"
    )]
    let count = (length / STEP).round().max(1.0) as usize;
    let first = usize::from(!places.is_empty());
    for k in first..=count {
        places.extend(between(map, &passages, k as f64 / count as f64, length));
    }
}

/// The place at a share of a road's length, on its passage or between two of them.
fn between(map: &RoadMap, passages: &[Vec<Segment>], share: f64, length: f64) -> Option<Place> {
    let last = passages.len().checked_sub(1)?;
    // Changes are spread evenly: the k-th of n passages is left at (k + 1) / n.
    let span = (CHANGE_LENGTH / length.max(CHANGE_LENGTH)).min(1.0 / passages.len() as f64);
    let mut at = 0;
    let mut moved = 0.0;
    for k in 0..last {
        let middle = (k + 1) as f64 / passages.len() as f64;
        let progress = ((share - middle) / span + 0.5).clamp(0.0, 1.0);
        if progress > 0.0 {
            (at, moved) = (k, progress * progress * (3.0 - 2.0 * progress));
        }
    }
    let (from, from_at) = on(map, &passages[at], share)?;
    if moved <= 0.0 || at == last {
        return Some(place(from, from_at, from_at.offset(0.0)));
    }
    let (to, to_at) = on(map, &passages[at + 1], share)?;
    let position = from_at.offset(0.0) * (1.0 - moved) + to_at.offset(0.0) * moved;
    Some(if moved < 0.5 {
        place(from, from_at, position)
    } else {
        place(to, to_at, position)
    })
}

fn place(lane: LaneId, at: LanePoint, position: Vec2) -> Place {
    Place { lane, at, position }
}

/// The cross-section at a share of a passage's length.
fn on(map: &RoadMap, segments: &[Segment], share: f64) -> Option<(LaneId, LanePoint)> {
    let mut rest = share * length(segments);
    for (k, (lane, start, end)) in segments.iter().enumerate() {
        if rest <= end - start || k + 1 == segments.len() {
            return Some((*lane, map.lane(*lane).at((start + rest).min(*end))));
        }
        rest -= end - start;
    }
    None
}

fn length(segments: &[Segment]) -> f64 {
    segments.iter().map(|(_, start, end)| end - start).sum()
}

fn segments(map: &RoadMap, passage: &Passage) -> Vec<Segment> {
    let known = passage.segments.iter().filter_map(|segment| {
        let lane = map.find(&segment.lane)?;
        Some((lane, segment.start_s, segment.end_s))
    });
    known.filter(|(_, start, end)| end > start).collect()
}

/// Places a step apart from a place on a lane on, along first successors.
fn straight_on(map: &RoadMap, mut lane: LaneId, mut s: f64, beyond: f64) -> Vec<Place> {
    let mut places = Vec::new();
    let mut seen = vec![lane];
    while (places.len() as f64) * STEP < beyond {
        s += STEP;
        let length = map.lane(lane).length();
        if s > length {
            let next = map.lane(lane).successors.iter().find(|next| !seen.contains(next));
            let Some(next) = next else { break };
            (lane, s) = (*next, s - length);
            seen.push(lane);
        }
        let at = map.lane(lane).at(s);
        places.push(place(lane, at, at.offset(0.0)));
    }
    places
}
