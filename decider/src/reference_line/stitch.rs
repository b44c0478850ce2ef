//! A smooth line along a chain of lanes that grows ahead of the car and is cut behind it.
//!
//! Anchors stand a metre apart, counted from where the chain began, so a longer chain has the same anchors and some
//! more. When the line grows, all but its last stretch stays exactly as it is, and stations go on counting: nothing that
//! a planner remembers in terms of `s` and `l` moves (the original smooths a window anew in every cycle, or pins one
//! point of it).

use super::line::{LineError, LineSample, ReferenceLine, sample};
use super::query::LineQuery;
use super::smooth::{self, Anchor};
use crate::geometry::{Vec2, angle};
use crate::hd_map::{LaneSegment, LaneWaypoint};
use crate::road::{LaneId, RoadMap};
use crate::vehicle::VehicleParams;
use std::sync::Arc;

/// Distance between anchors, m.
const STEP: f64 = 1.0;

/// Stretch at the end of a line that may still move when the line grows, m (the original's
/// `reference_line_stitch_overlap_distance`).
const OVERLAP: usize = 20;

/// Points at the end of the unmoved stretch whose curvature looks ahead into the moved one.
const STENCIL: usize = 2;

/// Room that the car must have to both sides of the line, m (the original's `lateral_buffer`).
const LATERAL_BUFFER: f64 = 0.2;

/// Least and largest distance to which the line may leave the lane's centre, m
/// (`min_` and `max_lateral_boundary_bound`).
const REACH: (f64, f64) = (0.1, 0.5);

/// A smooth line and the lanes that it follows.
#[derive(Clone, Debug)]
pub struct StitchedLine {
    chain: Vec<LaneSegment>,
    /// Distance from where the chain began to its first anchor now, in anchors.
    dropped: usize,
    /// How far each anchor was moved to the left, m.
    offsets: Vec<f64>,
    /// How many of them stay when the line grows.
    settled: usize,
    line: Arc<ReferenceLine>,
}

impl StitchedLine {
    /// A line along `chain`, whose stretches follow each other.
    ///
    /// # Errors
    /// [`LineError`] when the chain is empty or too short.
    pub fn new(map: &RoadMap, chain: Vec<LaneSegment>, vehicle: &VehicleParams) -> Result<Self, LineError> {
        if chain.is_empty() {
            return Err(LineError::Empty);
        }
        let places = places(&chain, 0);
        let mut anchors: Vec<Anchor> = places.iter().map(|place| anchor(map, *place, vehicle)).collect();
        // Where the line begins it is the lane's centre: whoever comes from there finds it.
        if let Some(first) = anchors.first_mut() {
            first.limits = (0.0, 0.0);
        }
        let offsets = smooth::offsets(&anchors, STEP);
        let samples = samples(map, &places, &anchors, &offsets, &[], 0.0);
        Ok(Self {
            chain,
            dropped: 0,
            settled: offsets.len().saturating_sub(OVERLAP),
            offsets,
            line: Arc::new(ReferenceLine::checked(samples)?),
        })
    }

    /// The line itself.
    pub fn line(&self) -> &Arc<ReferenceLine> {
        &self.line
    }

    /// The lanes it follows.
    pub fn chain(&self) -> &[LaneSegment] {
        &self.chain
    }

    /// Whether the line holds all of `chain`, so that it serves as it is.
    pub fn covers(&self, chain: &[LaneSegment]) -> bool {
        let Some(first) = self.place_of(chain) else {
            return false;
        };
        let mine = &self.chain[first..];
        let inside = |(k, wanted): (usize, &LaneSegment)| {
            mine.get(k).is_some_and(|have| {
                let starts = k == 0 || have.start_s <= wanted.start_s + STEP;
                have.lane == wanted.lane && starts && have.end_s + STEP >= wanted.end_s
            })
        };
        chain.iter().enumerate().all(inside)
    }

    /// This line led on along `chain`. `None` where the
    /// chain does not begin on this line.
    ///
    /// # Errors
    /// [`LineError`] when nothing is left.
    pub fn led_on(
        &self,
        map: &RoadMap,
        chain: &[LaneSegment],
        vehicle: &VehicleParams,
    ) -> Option<Result<Self, LineError>> {
        let first = self.place_of(chain)?;
        let mut joined = self.chain[..first].to_vec();
        let mut common = joined.iter().map(LaneSegment::length).sum::<f64>();
        let mut is_common = true;
        for (k, wanted) in chain.iter().enumerate() {
            let mut stretch = *wanted;
            if let Some(mine) = self
                .chain
                .get(first + k)
                .filter(|mine| is_common && mine.lane == wanted.lane)
            {
                stretch.start_s = if k == 0 { mine.start_s } else { wanted.start_s };
                common += mine.length().min(stretch.length());
            } else {
                is_common = false;
            }
            joined.push(stretch);
        }
        Some(self.rebuilt(map, joined, common, vehicle))
    }

    /// The line along `chain`, of which the first `common` metres are this line's.
    fn rebuilt(
        &self,
        map: &RoadMap,
        chain: Vec<LaneSegment>,
        common: f64,
        vehicle: &VehicleParams,
    ) -> Result<Self, LineError> {
        let places = places(&chain, self.dropped);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a length in metres, not negative"
        )]
        let shared = ((common / STEP) as usize + 1).saturating_sub(self.dropped);
        let kept = if shared + 1 < self.offsets.len() {
            self.settled.min(shared.saturating_sub(OVERLAP))
        } else {
            self.settled
        };
        let mut anchors: Vec<Anchor> = places.iter().map(|place| anchor(map, *place, vehicle)).collect();
        for (anchor, offset) in anchors.iter_mut().zip(&self.offsets[..kept]) {
            anchor.limits = (*offset, *offset);
        }
        let offsets = smooth::offsets(&anchors, STEP);
        let old = &self.line.samples()[..kept.saturating_sub(STENCIL)];
        let samples = samples(map, &places, &anchors, &offsets, old, self.line.start());
        Ok(Self {
            chain,
            dropped: self.dropped,
            settled: offsets.len().saturating_sub(OVERLAP),
            offsets,
            line: Arc::new(ReferenceLine::checked(samples)?),
        })
    }

    /// Whether from a place on the line follows the lanes that `chain` follows from there, as far as it goes.
    pub fn agrees(&self, chain: &[LaneSegment], place: &LaneWaypoint) -> bool {
        let from = |chain: &[LaneSegment]| chain.iter().rposition(|stretch| stretch.lane == place.lane);
        match (from(&self.chain), from(chain)) {
            (Some(mine), Some(wanted)) => {
                let lanes = self.chain[mine..].iter().zip(&chain[wanted..]);
                lanes.into_iter().all(|(mine, wanted)| mine.lane == wanted.lane)
            }
            _ => false,
        }
    }

    /// The station at a place of the chain, the last one where the chain passes it twice.
    pub fn station_of(&self, place: &LaneWaypoint) -> Option<f64> {
        let holds = |mine: &LaneSegment| {
            mine.lane == place.lane && mine.start_s - STEP <= place.s && place.s <= mine.end_s + STEP
        };
        let last = self.chain.iter().rposition(holds)?;
        let before = self.chain[..last].iter().map(LaneSegment::length).sum::<f64>();
        let along = (before + place.s - self.chain[last].start_s) / STEP - self.dropped as f64;
        let samples = self.line.samples();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "saturates, and is bounded below the number of samples"
        )]
        let k = (along as usize).min(samples.len() - 2);
        Some(samples[k].s + (along - k as f64) * (samples[k + 1].s - samples[k].s))
    }

    /// This line up to the station `end`.
    #[must_use]
    pub fn cut_ahead(&self, end: f64) -> Self {
        let samples = self.line.samples();
        let kept = samples.partition_point(|sample| sample.s <= end).max(2);
        let Ok(line) = ReferenceLine::checked(samples[..kept.min(samples.len())].to_vec()) else {
            return self.clone();
        };
        let mut chain = self.chain.clone();
        let mut left = (self.dropped + kept - 1) as f64 * STEP;
        chain.retain_mut(|stretch| {
            let length = stretch.length().min(left);
            stretch.end_s = stretch.start_s + length;
            left -= length;
            length > 0.0
        });
        Self {
            chain,
            dropped: self.dropped,
            // What lay beyond the new end has had its say.
            settled: self.settled.min(kept),
            offsets: self.offsets[..kept.min(self.offsets.len())].to_vec(),
            line: Arc::new(line),
        }
    }

    /// This line without what lies more than `keep` metres before the station `here`.
    #[must_use]
    pub fn cut_behind(&self, here: f64, keep: f64) -> Self {
        let samples = self.line.samples();
        let gone = samples.partition_point(|sample| sample.s < here - keep);
        let gone = gone.min(samples.len().saturating_sub(2));
        let Ok(line) = ReferenceLine::checked(samples[gone..].to_vec()) else {
            return self.clone();
        };
        Self {
            chain: self.chain.clone(),
            dropped: self.dropped + gone,
            settled: self.settled.saturating_sub(gone),
            offsets: self.offsets[gone..].to_vec(),
            line: Arc::new(line),
        }
    }

    /// Place in the own chain of the lane on which another chain begins.
    fn place_of(&self, chain: &[LaneSegment]) -> Option<usize> {
        let wanted = chain.first()?;
        let holds = |mine: &LaneSegment| {
            mine.lane == wanted.lane && mine.start_s <= wanted.start_s + STEP && wanted.start_s <= mine.end_s
        };
        self.chain.iter().position(holds)
    }
}

/// A place of an anchor: a lane and a station on it.
type Place = (LaneId, f64);

/// Where the anchors of a chain stand, without the first `dropped`.
fn places(chain: &[LaneSegment], dropped: usize) -> Vec<Place> {
    let mut places = Vec::new();
    let (mut before, mut index) = (0.0, 0_usize);
    for stretch in chain {
        let end = before + stretch.length();
        while index as f64 * STEP <= end {
            if index >= dropped {
                places.push((stretch.lane, stretch.start_s + (index as f64 * STEP - before)));
            }
            index += 1;
        }
        before = end;
    }
    places
}

/// An anchor on the centre line, with the room that the lane leaves (the original's `GetAnchorPoint`).
fn anchor(map: &RoadMap, (lane, s): Place, vehicle: &VehicleParams) -> Anchor {
    let at = map.lane(lane).at(s);
    let (sin, cos) = angle::sin_cos(at.theta);
    let room = (at.left + at.right - vehicle.width) / 2.0 - LATERAL_BUFFER;
    let reach = room.clamp(REACH.0, REACH.1);
    Anchor {
        position: Vec2::new(at.x, at.y),
        normal: Vec2::new(-sin, cos),
        limits: (-reach, reach),
    }
}

/// The line's cross-sections: those of an older line as far as they stay, then new ones. `start`: station of the first.
fn samples(
    map: &RoadMap,
    places: &[Place],
    anchors: &[Anchor],
    offsets: &[f64],
    old: &[LineSample],
    start: f64,
) -> Vec<LineSample> {
    let moved = anchors
        .iter()
        .zip(offsets)
        .map(|(anchor, l)| anchor.position + anchor.normal * *l);
    let positions: Vec<Vec2> = moved.collect();
    let points = smooth::points(&positions);
    let mut samples = old.to_vec();
    for k in samples.len()..points.len() {
        let (lane, s) = places[k];
        let along = samples.last().map(|last| {
            let step = (positions[k] - positions[k - 1]).norm();
            let turn = angle::difference(points[k].theta, last.point.theta);
            last.s + step * (1.0 + turn * turn / 24.0)
        });
        let mut next = sample(map, lane, &map.lane(lane).at(s));
        let l = offsets[k];
        next.s = along.unwrap_or(start);
        next.point = points[k];
        next.offset = l;
        next.lane_width = (next.lane_width.0 - l, next.lane_width.1 + l);
        next.road_width = (next.road_width.0 - l, next.road_width.1 + l);
        samples.push(next);
    }
    samples
}
