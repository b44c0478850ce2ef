//! A line along the lanes of a map: points that know on which lanes they lie.
//!
//! World frame, metres, radians; `s` along the chords from the first point, `l` to the left. A raw line takes the
//! points of its lanes' centre lines and their headings; a smoothed one brings its own. What can be asked of a line
//! is in the files beside this one. Source: the original's `modules/map/pnc_map/path.cc`, class `Path`, and
//! `modules/planning/reference_line/reference_line.cc`, which wraps it.

use super::lane::{HalfWidths, between};
use super::overlaps::{self, PathOverlap};
use super::polyline::{EPSILON, Polyline, SAME_POINT};
use super::{HdLane, HdMap, LaneSegment, LaneWaypoint, ObjectKind};
use crate::geometry::Vec2;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Distance between samples of the widths, m.
const SAMPLE_STEP: f64 = 0.25;

/// Half width of a line that lies on no lane, m: half the original's default lane width.
const DEFAULT_HALF_WIDTH: f64 = 3.048 / 2.0;

/// How near its lane's end a part of a lane counts as reaching it, m.
const END_TOLERANCE: f64 = 0.5;

/// A point of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct PathPoint {
    /// World position.
    pub position: Vec2,
    /// Driving direction.
    pub heading: f64,
    /// Curvature, 1/m.
    pub kappa: f64,
    /// Its derivative along the line, 1/m².
    pub dkappa: f64,
    /// Where it lies, lane by lane; a joint lies on two lanes.
    pub waypoints: Vec<LaneWaypoint>,
}

/// Defects of the original's lines that can be switched on one by one.
#[expect(clippy::struct_excessive_bools, reason = "each is an independent switch")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PathQuirks {
    /// Between two points, the heading stays that of the first.
    pub stepwise_heading: bool,
    /// Stations of overlaps add up lengths of lanes, not of the line.
    pub lane_lengths_as_stations: bool,
    /// Parts of lanes in a range count stations from the line's part of a lane, and repeat the first lane.
    pub offsets_as_lane_stations: bool,
    /// A box that straddles the line does not overlap its lane.
    pub straddling_is_clear: bool,
}

impl PathQuirks {
    /// All of them, as in the original.
    pub fn apollo() -> Self {
        Self {
            stepwise_heading: true,
            lane_lengths_as_stations: true,
            offsets_as_lane_stations: true,
            straddling_is_clear: true,
        }
    }
}

/// Why there is no line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PathError {
    /// Nothing to go along.
    #[error("a line needs two points apart from each other, {0} given")]
    TooFewPoints(usize),
    /// A number that is none, or infinite, or a length that is.
    #[error("the line is not finite up to its point {0}")]
    NotFinite(usize),
    /// A handle of another map.
    #[error("the map has no lane number {0}")]
    UnknownLane(u32),
}

/// A part of a lane that the line follows, and where on the line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Followed {
    pub(super) segment: LaneSegment,
    /// Stations of its two ends on the line, m.
    pub(super) start: f64,
    pub(super) end: f64,
}

impl Followed {
    /// The station on the line of a station on the lane.
    pub(super) fn to_line(self, lane_s: f64) -> f64 {
        self.start + (lane_s - self.segment.start_s) * self.stretch()
    }

    /// The station on the lane of a station on the line.
    pub(super) fn to_lane(self, s: f64) -> f64 {
        self.segment.start_s + (s - self.start) / self.stretch()
    }

    fn stretch(self) -> f64 {
        (self.end - self.start) / self.segment.length()
    }
}

/// A line with everything that its map says beside it. Immutable.
#[derive(Clone, Debug)]
pub struct Path {
    pub(super) map: Arc<HdMap>,
    pub(super) points: Vec<PathPoint>,
    pub(super) line: Polyline,
    /// For every piece, the lane that both its ends lie on.
    shared: Vec<Option<LaneSegment>>,
    pub(super) followed: Vec<Followed>,
    segments: Vec<LaneSegment>,
    pub(super) overlaps: [Vec<PathOverlap>; ObjectKind::COUNT],
    pub(super) quirks: PathQuirks,
}

impl Path {
    /// The raw line along the centre lines of `segments`, which follow each other.
    ///
    /// # Errors
    /// [`PathError`] when they span no length, or a lane is not of `map`.
    pub fn along(map: &Arc<HdMap>, segments: &[LaneSegment], quirks: PathQuirks) -> Result<Self, PathError> {
        let mut points: Vec<PathPoint> = Vec::new();
        for segment in segments {
            let lane = map.lanes().get(segment.lane.0 as usize);
            let lane = lane.ok_or(PathError::UnknownLane(segment.lane.0))?;
            for point in points_of(lane, segment) {
                let last = points.last_mut();
                match last.filter(|last| (point.position - last.position).norm() <= SAME_POINT) {
                    Some(last) => last.waypoints.extend(point.waypoints),
                    None => points.push(point),
                }
            }
        }
        Self::through(map, points, quirks)
    }

    /// The line through `points`, each apart from the one before.
    ///
    /// # Errors
    /// [`PathError`] when there are fewer than two points, two in a row coincide, one is not finite, or one names a
    /// lane that is not of `map`.
    pub fn through(map: &Arc<HdMap>, points: Vec<PathPoint>, quirks: PathQuirks) -> Result<Self, PathError> {
        check(map, &points)?;
        let line = Polyline::new(points.iter().map(|p| p.position).collect())
            .ok_or(PathError::TooFewPoints(points.len()))?;
        if !line.length().is_finite() {
            return Err(PathError::NotFinite(points.len() - 1));
        }
        let pairs = points.windows(2);
        let shared: Vec<_> = pairs.map(|pair| shared_lane(&pair[0], &pair[1])).collect();
        let followed = join(map, &shared, &line, quirks);
        Ok(Self {
            map: Arc::clone(map),
            segments: followed.iter().map(|followed| followed.segment).collect(),
            overlaps: ObjectKind::ALL.map(|kind| overlaps::along(map, &followed, kind)),
            points,
            line,
            shared,
            followed,
            quirks,
        })
    }

    /// The map it lies on.
    pub fn map(&self) -> &Arc<HdMap> {
        &self.map
    }

    /// Its points.
    pub fn points(&self) -> &[PathPoint] {
        &self.points
    }

    /// Station of every point, m.
    pub fn stations(&self) -> &[f64] {
        self.line.stations()
    }

    /// Its length, m.
    pub fn length(&self) -> f64 {
        self.line.length()
    }

    /// The parts of lanes that it follows. A part that comes within half a metre of an end of its lane reaches it.
    pub fn lane_segments(&self) -> &[LaneSegment] {
        &self.segments
    }

    /// The last point not beyond `s`, and how far `s` is behind it. Outside the line, one of its ends.
    pub fn locate(&self, s: f64) -> (usize, f64) {
        self.line.locate(s)
    }

    /// The point at `s`, clamped to the line. Its lane is the one that the points around it share.
    pub fn point_at(&self, s: f64) -> PathPoint {
        let (vertex, offset) = self.line.locate(s);
        let below = &self.points[vertex];
        let Some(above) = self.points.get(vertex + 1).filter(|_| offset > EPSILON) else {
            return below.clone();
        };
        let t = offset / (self.stations()[vertex + 1] - self.stations()[vertex]);
        let heading = if self.quirks.stepwise_heading {
            below.heading
        } else {
            between(below.heading, above.heading, t)
        };
        PathPoint {
            position: self.line.point_at(s),
            heading,
            kappa: below.kappa + (above.kappa - below.kappa) * t,
            dkappa: below.dkappa + (above.dkappa - below.dkappa) * t,
            waypoints: self.waypoint_behind(vertex, offset).into_iter().collect(),
        }
    }

    /// The waypoint `offset` metres behind point `vertex`: on the lane shared with the next point, else where the
    /// point itself is.
    fn waypoint_behind(&self, vertex: usize, offset: f64) -> Option<LaneWaypoint> {
        let waypoints = &self.points[vertex].waypoints;
        let first = waypoints.first()?;
        let Some(shared) = self.shared[vertex] else {
            return Some(*first);
        };
        let same = waypoints.iter().find(|waypoint| waypoint.lane == shared.lane);
        Some(LaneWaypoint {
            lane: shared.lane,
            s: shared.start_s + offset,
            l: same.unwrap_or(first).l,
        })
    }

    /// Distances from the line to the (left, right) edges of its lane at `s`; `None` outside `[0, length]`.
    pub fn lane_width_at(&self, s: f64) -> Option<HalfWidths> {
        self.between_samples(s, HdLane::width_at)
    }

    /// Distances from the line to the (left, right) edges of the road at `s`; `None` outside `[0, length]`.
    pub fn road_width_at(&self, s: f64) -> Option<HalfWidths> {
        self.between_samples(s, HdLane::road_width_at)
    }

    /// Linear between samples; the last one holds to the end of the line.
    fn between_samples(&self, s: f64, width: fn(&HdLane, f64) -> HalfWidths) -> Option<HalfWidths> {
        if !(0.0..=self.length()).contains(&s) {
            return None;
        }
        let below = (s / SAMPLE_STEP).floor() * SAMPLE_STEP;
        let a = self.sample(below, width);
        if below + SAMPLE_STEP > self.length() {
            return Some(a);
        }
        let b = self.sample(below + SAMPLE_STEP, width);
        let t = (s - below) / SAMPLE_STEP;
        Some((a.0 + (b.0 - a.0) * t, a.1 + (b.1 - a.1) * t))
    }

    /// Widths seen from the line, by the first waypoint at `s` alone.
    fn sample(&self, s: f64, width: fn(&HdLane, f64) -> HalfWidths) -> HalfWidths {
        let (vertex, offset) = self.line.locate(s);
        let waypoint = if vertex + 1 < self.points.len() && offset > EPSILON {
            self.waypoint_behind(vertex, offset)
        } else {
            self.points[vertex].waypoints.first().copied()
        };
        let Some(LaneWaypoint { lane, s, l }) = waypoint else {
            return (DEFAULT_HALF_WIDTH, DEFAULT_HALF_WIDTH);
        };
        let (left, right) = width(self.map.lane(lane), s);
        (left - l, right + l)
    }
}

fn check(map: &HdMap, points: &[PathPoint]) -> Result<(), PathError> {
    for (k, point) in points.iter().enumerate() {
        let numbers = [
            point.position.x,
            point.position.y,
            point.heading,
            point.kappa,
            point.dkappa,
        ];
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err(PathError::NotFinite(k));
        }
        let known = |waypoint: &&LaneWaypoint| (waypoint.lane.0 as usize) < map.lanes().len();
        if let Some(unknown) = point.waypoints.iter().find(|waypoint| !known(waypoint)) {
            return Err(PathError::UnknownLane(unknown.lane.0));
        }
    }
    let moves = |pair: &[PathPoint]| pair[0].position != pair[1].position;
    if points.windows(2).all(moves) {
        Ok(())
    } else {
        Err(PathError::TooFewPoints(points.len()))
    }
}

/// Points of a lane's centre line in `segment`, with its ends.
fn points_of(lane: &HdLane, segment: &LaneSegment) -> Vec<PathPoint> {
    let (start, end) = (segment.start_s.max(0.0), segment.end_s.min(lane.length()));
    if start.is_nan() || end.is_nan() || start >= end {
        return Vec::new();
    }
    let point = |s: f64| PathPoint {
        position: lane.point_at(s),
        heading: lane.headings()[lane.centre().locate(s).0],
        kappa: 0.0,
        dkappa: 0.0,
        waypoints: vec![LaneWaypoint::on(segment.lane, s)],
    };
    let inner = lane.stations().iter().copied().filter(|s| start < *s && *s < end);
    std::iter::once(start)
        .chain(inner)
        .chain([end])
        .map(point)
        .collect()
}

/// The part of a lane that leads from one point to the next.
fn shared_lane(from: &PathPoint, to: &PathPoint) -> Option<LaneSegment> {
    from.waypoints.iter().find_map(|a| {
        let leads = |b: &&LaneWaypoint| a.lane == b.lane && a.s < b.s;
        let b = to.waypoints.iter().find(leads)?;
        Some(LaneSegment::new(a.lane, a.s, b.s))
    })
}

/// Pieces on the same lane in a row, joined.
fn join(map: &HdMap, shared: &[Option<LaneSegment>], line: &Polyline, quirks: PathQuirks) -> Vec<Followed> {
    let mut joined: Vec<Followed> = Vec::new();
    let ends = line.stations().windows(2);
    for (piece, ends) in shared.iter().zip(ends) {
        let Some(segment) = *piece else { continue };
        match joined.last_mut().filter(|last| last.segment.lane == segment.lane) {
            Some(last) => {
                last.segment.end_s = segment.end_s;
                last.end = ends[1];
            }
            None => joined.push(Followed {
                segment,
                start: ends[0],
                end: ends[1],
            }),
        }
    }
    let mut behind = 0.0;
    for followed in &mut joined {
        reach_the_ends(followed, map.lane(followed.segment.lane).length());
        if quirks.lane_lengths_as_stations {
            followed.start = behind;
            behind += followed.segment.length();
            followed.end = behind;
        }
    }
    joined
}

fn reach_the_ends(followed: &mut Followed, length: f64) {
    let segment = &mut followed.segment;
    if segment.start_s < END_TOLERANCE {
        followed.start -= segment.start_s;
        segment.start_s = 0.0;
    }
    if segment.end_s + END_TOLERANCE >= length {
        followed.end += length - segment.end_s;
        segment.end_s = length;
    }
}
