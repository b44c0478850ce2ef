//! Lengthens route segments along the route: backwards over lanes that lead there, forwards beyond its end.
//!
//! `s` is metres along the given segments from their start; a negative one lies before them. A lane is never driven
//! twice. Source: the original's `PncMap::ExtendSegments`.

use super::{LaneFollowQuirks, Route, RouteSegments};
use crate::hd_map::{HdMap, LaneSegment};
use crate::road::LaneId;
use std::collections::BTreeSet;

/// A rest shorter than this is not worth another lane, m.
const LEAST_REST: f64 = 1e-3;

/// What decides which lanes come before and behind.
pub(super) struct Extension<'a> {
    pub(super) map: &'a HdMap,
    pub(super) route: &'a Route,
    /// Lanes of the route around the car.
    pub(super) range: &'a BTreeSet<LaneId>,
    pub(super) quirks: LaneFollowQuirks,
}

impl Extension<'_> {
    /// The part of the way along `given` from `start_s` to `end_s`, longer than `given` where that is needed and
    /// there are lanes to go along. It ends where it would meet a lane again. `None` for no segments and no stretch.
    pub(super) fn extend(&self, given: &RouteSegments, start_s: f64, end_s: f64) -> Option<RouteSegments> {
        let first = given.segments.first()?;
        if start_s.is_nan() || end_s.is_nan() || start_s >= end_s {
            return None;
        }
        let mut way = self.before(first, -start_s);
        let mut seen: BTreeSet<LaneId> = way.iter().map(|segment| segment.lane).collect();
        if let Some(reached) = cut_to(given, start_s, end_s, &mut way, &mut seen) {
            self.lengthen(given, end_s - reached, &mut way, &mut seen);
        }
        Some(RouteSegments {
            segments: way,
            ..given.clone()
        })
    }

    /// `missing` metres of lanes that lead to the start of `first`, in driving order.
    fn before(&self, first: &LaneSegment, mut missing: f64) -> Vec<LaneSegment> {
        let mut seen = BTreeSet::new();
        let mut way = Vec::new();
        let (mut lane, mut s) = (first.lane, first.start_s);
        while missing > LEAST_REST {
            if s <= LEAST_REST {
                match self.predecessor(lane) {
                    Some(before) if seen.insert(before) => lane = before,
                    _ => break,
                }
                s = self.map.lane(lane).length();
            } else {
                let length = s.min(missing);
                way.push(LaneSegment::new(lane, s - length, s));
                missing -= length;
                s -= length;
                seen.insert(lane);
            }
        }
        way.reverse();
        way
    }

    /// Goes on for `missing` metres: to the end of the last lane, then over lanes that follow.
    fn lengthen(
        &self,
        given: &RouteSegments,
        mut missing: f64,
        way: &mut Vec<LaneSegment>,
        seen: &mut BTreeSet<LaneId>,
    ) {
        if let Some(last) = way.last_mut().filter(|_| missing > 0.0) {
            let rest = self.map.lane(last.lane).length() - last.end_s;
            let length = missing.min(rest).max(0.0);
            last.end_s += length;
            missing -= length;
        }
        let mut lane = given.segments.last().map(|last| last.lane);
        while missing > LEAST_REST {
            lane = lane.and_then(|lane| self.successor(lane));
            let Some(next) = lane.filter(|next| seen.insert(*next)) else {
                return;
            };
            let length = missing.min(self.map.lane(next).length());
            way.push(LaneSegment::new(next, 0.0, length));
            missing -= length;
        }
    }

    /// The lane before: one of the route, if there is a choice.
    fn predecessor(&self, lane: LaneId) -> Option<LaneId> {
        let before = self.map.lane(lane).predecessors();
        let skipped = usize::from(self.quirks.first_entry_precedes_nothing);
        let mut route = self
            .route
            .entries()
            .iter()
            .skip(skipped)
            .map(|entry| entry.segment.lane);
        route
            .find(|lane| before.contains(lane))
            .or(before.first().copied())
    }

    /// The lane behind: one of the route around the car, if there is a choice.
    fn successor(&self, lane: LaneId) -> Option<LaneId> {
        let next = self.map.lane(lane).successors();
        let on_route = next.iter().find(|lane| self.range.contains(lane));
        on_route.or(next.first()).copied()
    }
}

/// Appends what of `given` lies between the two stations. The station reached; `None` where a lane came again.
fn cut_to(
    given: &RouteSegments,
    start_s: f64,
    end_s: f64,
    way: &mut Vec<LaneSegment>,
    seen: &mut BTreeSet<LaneId>,
) -> Option<f64> {
    let mut behind = 0.0;
    for segment in &given.segments {
        let start = segment.start_s.max(start_s - behind + segment.start_s);
        let end = segment.end_s.min(end_s - behind + segment.start_s);
        if start < end {
            match way.last_mut().filter(|last| last.lane == segment.lane) {
                Some(last) => last.end_s = end,
                None if seen.insert(segment.lane) => way.push(LaneSegment::new(segment.lane, start, end)),
                None => return None,
            }
        }
        behind += segment.length();
        if behind > end_s {
            break;
        }
    }
    Some(behind)
}
