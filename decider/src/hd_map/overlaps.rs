//! What lies across a line: signals, crosswalks, junctions, other lanes, each with its stations on the line.
//!
//! Metres along the line. Source: the original's `Path::GetOverlaps` and `ReferenceLineInfo`.

use super::path::{Followed, Path};
use super::{HdMap, LaneSegment, ObjectKind, Overlap, OverlapKind};
use std::collections::BTreeMap;

/// Largest gap between two parts of the same object that still counts as one, m.
const SAME_OBJECT_GAP: f64 = 1.5;

/// How far outside an object a station still is at it, m.
const AT_TOLERANCE: f64 = 1.0;

/// How far ahead the first encountered overlap is looked for, m from the start of the line.
const ENCOUNTER_HORIZON: f64 = 500.0;

/// An object that the line meets.
#[derive(Clone, Debug, PartialEq)]
pub struct PathOverlap {
    /// Its name.
    pub object: String,
    /// First station, m.
    pub start_s: f64,
    /// Last station, m.
    pub end_s: f64,
}

/// Everything of one kind that the lanes of a line meet; by start, name and end.
pub(super) fn along(map: &HdMap, lanes: &[Followed], kind: ObjectKind) -> Vec<PathOverlap> {
    let mut parts: BTreeMap<&str, Vec<(f64, f64)>> = BTreeMap::new();
    for lane in lanes {
        let name = map.lane(lane.segment.lane).name();
        for overlap in map.overlaps(lane.segment.lane, kind) {
            let Some(range) = on_line(lane, overlap, name) else {
                continue;
            };
            for other in overlap.objects.iter().filter(|object| object.id != name) {
                parts.entry(other.id.as_str()).or_default().push(range);
            }
        }
    }
    let mut overlaps = Vec::new();
    for (object, mut ranges) in parts {
        ranges.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let mut merged: Vec<(f64, f64)> = Vec::new();
        for range in ranges {
            match merged
                .last_mut()
                .filter(|last| range.0 - last.1 <= SAME_OBJECT_GAP)
            {
                Some(last) => last.1 = last.1.max(range.1),
                None => merged.push(range),
            }
        }
        overlaps.extend(merged.into_iter().map(|(start_s, end_s)| PathOverlap {
            object: object.to_owned(),
            start_s,
            end_s,
        }));
    }
    // Objects come by name, and a stable sort keeps that order where starts agree.
    overlaps.sort_by(|a, b| a.start_s.total_cmp(&b.start_s));
    overlaps
}

/// Stations of an overlap on the line, clipped to the part of its lane that the line follows.
fn on_line(lane: &Followed, overlap: &Overlap, name: &str) -> Option<(f64, f64)> {
    let own = overlap.objects.iter().find(|object| object.id == name)?;
    let (start, end) = match own.kind {
        Some(OverlapKind::Lane { start_s, end_s, .. }) => (start_s, end_s),
        _ => (0.0, 0.0),
    };
    let LaneSegment { start_s, end_s, .. } = lane.segment;
    let meets = start <= end_s && end >= start_s;
    meets.then(|| (lane.to_line(start.max(start_s)), lane.to_line(end.min(end_s))))
}

impl Path {
    /// What it meets of one kind, by start.
    pub fn overlaps(&self, kind: ObjectKind) -> &[PathOverlap] {
        &self.overlaps[kind.index()]
    }

    /// The next crossing lane that begins beyond `s`.
    pub fn next_lane_overlap(&self, s: f64) -> Option<&PathOverlap> {
        let lanes = self.overlaps(ObjectKind::Lane);
        lanes.get(lanes.partition_point(|overlap| overlap.start_s <= s))
    }

    /// The first object of a kind at `s`, at most a metre outside it.
    pub fn overlap_at(&self, kind: ObjectKind, s: f64) -> Option<&PathOverlap> {
        let at =
            |overlap: &&PathOverlap| overlap.start_s - AT_TOLERANCE <= s && s <= overlap.end_s + AT_TOLERANCE;
        self.overlaps(kind).iter().find(at)
    }

    /// The first object of a kind that a car whose front is at `s` has not left behind.
    pub fn first_encountered(&self, kind: ObjectKind, s: f64) -> Option<&PathOverlap> {
        let ahead = |overlap: &&PathOverlap| overlap.end_s >= s;
        let first = self.overlaps(kind).iter().find(ahead);
        first.filter(|overlap| overlap.start_s < ENCOUNTER_HORIZON)
    }

    /// The part of a lane at `s`, as its place in [`Path::lane_segments`], and how far `s` is behind its start, m.
    /// `None` on a line that follows no lane.
    pub fn locate_lane(&self, s: f64) -> Option<(usize, f64)> {
        let (last, end) = (self.followed.len().checked_sub(1)?, self.length());
        let at = self.followed.partition_point(|lane| lane.end < s);
        if s <= 0.0 {
            Some((0, 0.0))
        } else if s >= end || at > last {
            Some((last, self.followed[last].segment.length()))
        } else {
            let lane = self.followed[at];
            Some((at, lane.to_lane(s) - lane.segment.start_s))
        }
    }

    /// The parts of lanes between two stations of the line.
    pub fn lane_segments_between(&self, start_s: f64, end_s: f64) -> Vec<LaneSegment> {
        if self.quirks.offsets_as_lane_stations {
            return self.offsets_between(start_s, end_s).unwrap_or_default();
        }
        let lanes = self.followed.iter();
        lanes
            .filter(|lane| lane.start < end_s && start_s < lane.end)
            .map(|lane| LaneSegment {
                lane: lane.segment.lane,
                start_s: lane.to_lane(start_s.max(lane.start)),
                end_s: lane.to_lane(end_s.min(lane.end)),
            })
            .collect()
    }

    /// What the original answers instead.
    fn offsets_between(&self, start_s: f64, end_s: f64) -> Option<Vec<LaneSegment>> {
        use super::polyline::EPSILON;
        if start_s + EPSILON > end_s {
            return None;
        }
        let (mut first, mut offset) = self.locate_lane(start_s)?;
        if offset + EPSILON >= self.followed[first].segment.length() {
            (first, offset) = (first + 1, 0.0);
        }
        let segment = |at: usize| self.followed.get(at).map(|lane| lane.segment);
        let head = segment(first)?;
        let mut found = vec![LaneSegment::new(head.lane, offset, head.length())];
        let (last, offset) = self.locate_lane(end_s)?;
        found.extend((first..last).filter_map(segment));
        if offset >= EPSILON {
            found.push(LaneSegment::new(segment(last)?.lane, 0.0, offset));
        }
        Some(found)
    }
}
