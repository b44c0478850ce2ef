//! The pull-over bound (`GeneratePullOverPathBound`): the road up to the place where the car will stand.

use super::bound::{BoundPoint, EdgeCause};
use super::edges::{Limit, narrow, unbounded};
use super::forbidden::Forbidden;
use super::input::{Input, Memory, PullOver, PullOverPlace};
use super::obstacles::{self, Passage};
use super::stations::Station;
use super::{road, search};
use crate::reference_line::{LineQuery, SlPoint};

/// Stations kept beyond the place to pull over (the original's `kNumExtraTailBoundPoint`).
const TAIL: usize = 20;

/// Lane width assumed to the left where the map does not tell, m.
const DEFAULT_HALF_LANE: f64 = 3.0;

/// How far behind the first station a stored place still counts, m.
const BEHIND: f64 = 1.0;

/// Why there is no pull-over bound. The caller goes on without one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PullOverRefusal {
    /// The car does not fit on the road where it is.
    #[error("the road is too narrow at the ego")]
    RoadTooNarrow,
    /// The ego is not on the road.
    #[error("the ego is outside the road")]
    OutsideRoad,
    /// The destination is nearer than the configured buffer.
    #[error("the destination is too near")]
    DestinationTooNear,
    /// The destination is beyond the end of the bound.
    #[error("the destination is too far")]
    DestinationTooFar,
    /// No destination was given.
    #[error("there is no destination")]
    NoDestination,
    /// No stretch at the edge of the road is free, wide enough and clear of junctions.
    #[error("no place at the edge of the road is free and wide enough")]
    NoPlace,
}

/// Builds the bound and chooses or keeps the place.
///
/// On refusal the place in memory is cleared (once the search has begun), the request stays.
pub(super) fn bound<L: LineQuery + ?Sized>(
    stations: &[Station],
    forbidden: &[Forbidden],
    line: &L,
    input: &Input,
    memory: &mut Memory,
) -> Result<(Vec<BoundPoint>, Passage), PullOverRefusal> {
    let mut bound = unbounded(stations);
    road::limit(&mut bound, stations, input);
    let first = bound.first().ok_or(PullOverRefusal::RoadTooNarrow)?;
    if input.ego.l < first.l_min || input.ego.l > first.l_max {
        return Err(PullOverRefusal::OutsideRoad);
    }
    keep_in_lane(&mut bound, stations, input);
    let passage = obstacles::limit(&mut bound, input, forbidden);
    if bound.is_empty() {
        return Err(PullOverRefusal::NoPlace);
    }
    let kept = memory
        .pull_over
        .place
        .and_then(|place| index_inside(&bound, line, place));
    let index = match kept {
        Some(index) => index,
        None => choose(&bound, stations, line, input, &mut memory.pull_over)?,
    };
    bound.truncate(index + TAIL + 1);
    let (l_min, l_max) = (bound[index].l_min, bound[index].l_max);
    for point in &mut bound[index + 1..] {
        (point.l_min, point.l_max) = (l_min, l_max);
        (point.right, point.left) = (EdgeCause::PullOverTarget, EdgeCause::PullOverTarget);
    }
    Ok((bound, passage))
}

/// Searches a place anew and remembers it.
fn choose<L: LineQuery + ?Sized>(
    bound: &[BoundPoint],
    stations: &[Station],
    line: &L,
    input: &Input,
    state: &mut PullOver,
) -> Result<usize, PullOverRefusal> {
    *state = PullOver {
        is_requested: true,
        kind: state.kind,
        place: None,
    };
    let found = search::place(bound, stations, line, input, state.kind)?;
    state.place = Some(PullOverPlace {
        position: found.position,
        theta: found.theta,
        length_front: input.config.obstacle_lon_start_buffer,
        length_back: input.config.obstacle_lon_end_buffer,
        width_left: input.vehicle.half_width(),
        width_right: input.vehicle.half_width(),
    });
    Ok(found.index)
}

/// Keeps the car right of its lane's left line.
fn keep_in_lane(bound: &mut [BoundPoint], stations: &[Station], input: &Input) {
    let half_width = input.vehicle.half_width();
    for (point, station) in bound.iter_mut().zip(stations) {
        let lane_left = station.lane.map(|(left, _)| left);
        if input.config.quirks.pull_over_overhang {
            point.l_max = lane_left.map_or(DEFAULT_HALF_LANE, |left| left + station.offset);
            point.left = EdgeCause::LaneLine;
            continue;
        }
        let line = lane_left.unwrap_or(DEFAULT_HALF_LANE) - half_width;
        // An ego that overhangs its lane may come back into it; it need not jump.
        let (l, cause) = if input.ego.l > line {
            (input.ego.l, EdgeCause::Ego)
        } else {
            (line, EdgeCause::LaneLine)
        };
        let right = Limit {
            l: point.l_min,
            cause: point.right,
        };
        narrow(
            point,
            right,
            Limit {
                l: l.max(point.l_min),
                cause,
            },
        );
    }
}

/// The station of a stored place, if it lies inside the bound (`IsPointWithinPathBound`).
fn index_inside<L: LineQuery + ?Sized>(
    bound: &[BoundPoint],
    line: &L,
    place: PullOverPlace,
) -> Option<usize> {
    let SlPoint { s, l } = line.to_frenet(place.position);
    let (first, last) = (bound.first()?, bound.last()?);
    if s > last.s || s < first.s - BEHIND {
        return None;
    }
    let after = bound.partition_point(|p| p.s < s);
    // The original reads before the list when the place is at or behind the first station.
    let before = after.saturating_sub(1);
    let inside = |p: &BoundPoint| l >= p.l_min && l <= p.l_max;
    (inside(&bound[before]) && inside(&bound[after])).then_some(after)
}
