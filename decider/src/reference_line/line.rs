//! A reference line along the centre lines of a sequence of lanes.

use super::curve::Curve;
use super::foot::Foot;
use super::query::{LineQuery, SlPoint};
use crate::geometry::{Vec2, angle};
use crate::road::{BoundaryType, LaneId, LanePoint, Neighbour, RoadMap, Side};
use crate::tasks::path_bounds::{Station, station};
use serde::{Deserialize, Serialize};

/// Largest gap between the end of a lane and the start of its successor, m. Real maps join within
/// centimetres; half a metre is what the format notes ask importers to survive.
const JOIN_TOLERANCE: f64 = 0.5;

/// Samples closer than this are one, m.
const SAME_POINT: f64 = 1e-3;

/// A shorter line is none, m: there is nothing to plan along, and its ends have no direction of their own.
const LEAST_LENGTH: f64 = 0.1;

/// How far from the line a lane may be for its heading to count, m.
const LANE_HEADING_RADIUS: f64 = 5.0;

/// Position, heading and curvature of a line at one station.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LinePoint {
    /// World position, m.
    pub x: f64,
    /// World position, m.
    pub y: f64,
    /// Heading, rad.
    pub theta: f64,
    /// Curvature, 1/m, left turns positive.
    pub kappa: f64,
}

/// A cross-section of the road around the line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LineSample {
    /// Station along the line, m.
    pub s: f64,
    /// The line itself.
    pub point: LinePoint,
    /// The lane it follows.
    pub lane: LaneId,
    /// Lateral position of the line in the lane's frame, m, left positive.
    pub offset: f64,
    /// To the (left, right) lane edges, m.
    pub lane_width: (f64, f64),
    /// To the (left, right) edges of the road surface, m.
    pub road_width: (f64, f64),
    /// Lines on the (left, right) lane edges.
    pub marks: (BoundaryType, BoundaryType),
    /// Widths of the adjacent lanes, indexed by [`Neighbour::index`].
    pub neighbours: [Option<f64>; 4],
    /// Whether it lies in a junction.
    pub in_junction: bool,
    /// Speed limit, m/s; `None` where the map names none.
    pub speed_limit: Option<f64>,
}

/// Why no line can be made along some lanes.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LineError {
    /// No lanes were given.
    #[error("a reference line needs at least one lane")]
    Empty,
    /// Two lanes that do not meet.
    #[error("lane `{from}` ends {gap:.2} m away from the start of lane `{to}`")]
    Gap {
        /// The lane that ends.
        from: String,
        /// The lane that should follow.
        to: String,
        /// Distance between them, m.
        gap: f64,
    },
    /// Nothing to plan along.
    #[error("a reference line needs two points at least {LEAST_LENGTH} m apart; this one is {length} m long")]
    TooShort {
        /// Its length, m.
        length: f64,
    },
    /// A written line whose stations do not increase from 0, or with a number that is none.
    #[error("cross-section {0} of the reference line is not a finite step behind the one before")]
    Sample(usize),
}

/// A smooth curve with everything a decider asks of the road beside it. Immutable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "WrittenLine", into = "Vec<LineSample>")]
pub struct ReferenceLine {
    samples: Vec<LineSample>,
    curve: Curve,
}

impl From<Vec<LineSample>> for ReferenceLine {
    fn from(samples: Vec<LineSample>) -> Self {
        let curve = Curve::through(&samples);
        Self { samples, curve }
    }
}

/// A line as a file has it: nothing about it is known to be right.
#[derive(Deserialize)]
#[serde(transparent)]
struct WrittenLine(Vec<LineSample>);

impl TryFrom<WrittenLine> for ReferenceLine {
    type Error = LineError;

    fn try_from(WrittenLine(samples): WrittenLine) -> Result<Self, LineError> {
        let is_finite = |sample: &LineSample| {
            let LinePoint { x, y, theta, kappa } = sample.point;
            [sample.s, x, y, theta, kappa].iter().all(|v| v.is_finite())
        };
        let mut before = f64::NEG_INFINITY;
        for (k, sample) in samples.iter().enumerate() {
            if !is_finite(sample) || sample.s <= before {
                return Err(LineError::Sample(k));
            }
            before = sample.s;
        }
        long_enough(samples).map(Self::from)
    }
}

fn long_enough(samples: Vec<LineSample>) -> Result<Vec<LineSample>, LineError> {
    let length = match &samples[..] {
        [first, .., last] => last.s - first.s,
        _ => 0.0,
    };
    if samples.len() < 2 || length < LEAST_LENGTH {
        return Err(LineError::TooShort { length });
    }
    Ok(samples)
}

impl From<ReferenceLine> for Vec<LineSample> {
    fn from(line: ReferenceLine) -> Self {
        line.samples
    }
}

impl ReferenceLine {
    /// The line along the centre lines of `lanes`, which follow each other.
    ///
    /// # Errors
    /// [`LineError`] when there is no lane, two of them do not meet or all are too short.
    pub fn along(map: &RoadMap, lanes: &[LaneId]) -> Result<Self, LineError> {
        if lanes.is_empty() {
            return Err(LineError::Empty);
        }
        let mut samples: Vec<LineSample> = Vec::new();
        for (k, id) in lanes.iter().enumerate() {
            let lane = map.lane(*id);
            if let (Some(last), Some(first)) = (samples.last(), lane.points.first()) {
                let gap = Vec2::new(first.x - last.point.x, first.y - last.point.y).norm();
                if gap > JOIN_TOLERANCE {
                    let from = map.lane(lanes[k - 1]).name.clone();
                    return Err(LineError::Gap {
                        from,
                        to: lane.name.clone(),
                        gap,
                    });
                }
            }
            for point in &lane.points {
                append(&mut samples, sample(map, *id, point));
            }
        }
        long_enough(samples).map(Self::from)
    }

    /// The line through cross-sections by ascending station.
    ///
    /// # Errors
    /// [`LineError`] when they are too few or too near.
    pub(super) fn checked(samples: Vec<LineSample>) -> Result<Self, LineError> {
        long_enough(samples).map(Self::from)
    }

    /// Its cross-sections, by ascending station.
    pub fn samples(&self) -> &[LineSample] {
        &self.samples
    }

    /// The cross-section that rules at `s`.
    pub fn sample_at(&self, s: f64) -> &LineSample {
        let (k, t) = self.curve.locate(s);
        &self.samples[if t >= 1.0 { k + 1 } else { k }]
    }

    /// What [`station`] asks for one by one, for `s` between samples `k` and `k + 1`.
    fn station_between(&self, k: usize, s: f64) -> Station {
        let (a, b) = (&self.samples[k], &self.samples[k + 1]);
        let t = ((s - a.s) / (b.s - a.s)).clamp(0.0, 1.0);
        let mix = |a: (f64, f64), b: (f64, f64)| (a.0 + (b.0 - a.0) * t, a.1 + (b.1 - a.1) * t);
        let rules = if t >= 1.0 { b } else { a };
        Station {
            s,
            lane: Some(mix(a.lane_width, b.lane_width)),
            road: Some(mix(a.road_width, b.road_width)),
            offset: a.offset + (b.offset - a.offset) * t,
            marks: Some(rules.marks),
            neighbours: rules.neighbours,
        }
    }

    /// Frenet coordinates of a point with a given foot.
    fn frenet_at(&self, Foot { k, t, l }: Foot, point: Vec2) -> SlPoint {
        if (k == 0 && t < 0.0) || (k + 2 == self.samples.len() && t > 1.0) {
            return beyond_the_end(&self.samples[if t < 0.0 { 0 } else { k + 1 }], point);
        }
        let s = self.curve.station(k, t.clamp(0.0, 1.0));
        SlPoint { s, l }
    }

    fn inside(&self, s: f64) -> bool {
        s >= self.start() && s <= self.length()
    }

    fn mix_widths(&self, s: f64, widths: impl Fn(&LineSample) -> (f64, f64)) -> Option<(f64, f64)> {
        if !self.inside(s) {
            return None;
        }
        let (k, t) = self.curve.locate(s);
        let (a, b) = (widths(&self.samples[k]), widths(&self.samples[k + 1]));
        Some((a.0 + (b.0 - a.0) * t, a.1 + (b.1 - a.1) * t))
    }
}

impl LineQuery for ReferenceLine {
    fn start(&self) -> f64 {
        self.samples.first().map_or(0.0, |p| p.s)
    }

    fn length(&self) -> f64 {
        self.samples.last().map_or(0.0, |p| p.s)
    }

    fn lane_width(&self, s: f64) -> Option<(f64, f64)> {
        self.mix_widths(s, |p| p.lane_width)
    }

    fn road_width(&self, s: f64) -> Option<(f64, f64)> {
        self.mix_widths(s, |p| p.road_width)
    }

    fn offset_to_map(&self, s: f64) -> Option<f64> {
        let (k, t) = self.curve.locate(s);
        let (a, b) = (self.samples[k].offset, self.samples[k + 1].offset);
        Some(a + (b - a) * t)
    }

    fn boundary_types(&self, s: f64) -> Option<(BoundaryType, BoundaryType)> {
        Some(self.sample_at(s).marks)
    }

    fn neighbour_width(&self, neighbour: Neighbour, s: f64) -> Option<f64> {
        self.sample_at(s).neighbours[neighbour.index()]
    }

    fn near_junction(&self, s: f64, radius: f64) -> bool {
        let from = self.samples.partition_point(|p| p.s < s - radius);
        self.samples[from..]
            .iter()
            .take_while(|p| p.s <= s + radius)
            .any(|p| p.in_junction)
    }

    fn lane_heading(&self, point: Vec2, theta: f64) -> Option<f64> {
        let at = self.to_frenet(point);
        let heading = self.point(at.s).theta;
        let agrees = angle::difference(heading, theta).abs() <= std::f64::consts::FRAC_PI_2;
        (at.l.abs() <= LANE_HEADING_RADIUS && agrees).then_some(heading)
    }

    fn point(&self, s: f64) -> LinePoint {
        let (k, t) = self.curve.locate(s);
        self.curve.between(k, t)
    }

    fn sample(&self, from: f64, step: f64, end: f64, stations: &mut Vec<Station>) {
        if from < self.start() || end > self.length() {
            let mut s = from;
            while s < end {
                stations.push(station(self, s));
                s += step;
            }
            return;
        }
        // Walk along instead of searching for every station anew.
        let (mut k, _) = self.curve.locate(from);
        let mut s = from;
        while s < end {
            while k + 2 < self.samples.len() && self.samples[k + 1].s <= s {
                k += 1;
            }
            stations.push(self.station_between(k, s));
            s += step;
        }
    }

    fn to_frenet(&self, point: Vec2) -> SlPoint {
        self.frenet_at(self.curve.foot(point), point)
    }

    /// Looks up to 8 m along the line to both sides of `s_hint`. Where the point lies nearer to all of that stretch than
    /// the centres of its bends, the stretch has one foot, and that is found; where it is the nearest place of the
    /// whole line the answer is that of [`LineQuery::to_frenet`], bit for bit.
    fn to_frenet_near(&self, point: Vec2, s_hint: f64) -> SlPoint {
        let near = self.curve.foot_near(point, s_hint);
        self.frenet_at(near.unwrap_or_else(|| self.curve.foot(point)), point)
    }
}

/// Frenet coordinates beyond an end, where the tangent goes on straight.
fn beyond_the_end(end: &LineSample, point: Vec2) -> SlPoint {
    let (sin, cos) = angle::sin_cos(end.point.theta);
    let d = Vec2::new(point.x - end.point.x, point.y - end.point.y);
    SlPoint {
        s: end.s + cos * d.x + sin * d.y,
        l: cos * d.y - sin * d.x,
    }
}

/// Adds a cross-section behind the last one, at the station that its distance gives. Where a lane ends and the next
/// one begins, the next one rules from there on; that the place belongs to a junction is true of both.
fn append(samples: &mut Vec<LineSample>, mut next: LineSample) {
    if let Some(last) = samples.last_mut() {
        let step = Vec2::new(next.point.x - last.point.x, next.point.y - last.point.y).norm();
        if step < SAME_POINT {
            *last = LineSample {
                s: last.s,
                point: last.point,
                in_junction: last.in_junction || next.in_junction,
                ..next
            };
            return;
        }
        // Length of the arc over this chord, so that stations do not shrink in bends.
        let turn = angle::difference(next.point.theta, last.point.theta);
        next.s = last.s + step * (1.0 + turn * turn / 24.0);
    }
    samples.push(next);
}

/// What the map says beside a place of a lane's centre line.
pub(super) fn sample(map: &RoadMap, id: LaneId, at: &LanePoint) -> LineSample {
    let lane = map.lane(id);
    let width_of = |kind: Neighbour| {
        let other = map.lane(map.neighbour(id, kind)?);
        // Neighbours of one road section share their stations; oncoming ones count them backwards.
        let s = at.s / lane.length() * other.length();
        let there = other.at(if kind.reverse { other.length() - s } else { s });
        Some(there.left + there.right)
    };
    LineSample {
        s: 0.0,
        point: LinePoint {
            x: at.x,
            y: at.y,
            theta: at.theta,
            kappa: at.kappa,
        },
        lane: id,
        offset: 0.0,
        lane_width: (at.left, at.right),
        road_width: (at.road_left, at.road_right),
        marks: (lane.mark(Side::Left, at.s), lane.mark(Side::Right, at.s)),
        neighbours: Neighbour::ALL.map(width_of),
        in_junction: lane.junction.is_some(),
        speed_limit: at.speed_limit.is_finite().then_some(at.speed_limit),
    }
}
