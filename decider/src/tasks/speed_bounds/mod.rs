//! `SPEED_BOUNDS_PRIORI_DECIDER` and `SPEED_BOUNDS_FINAL_DECIDER`: what obstacles occupy of the path and when, and how
//! fast the car may be where.
//!
//! `s` is metres along the path, for the rear axle, and `t` seconds from the planning start. The geometry
//! ([`Track::occupied`]) depends on no decision, so that both passes share it; [`decided`] then adds what has been
//! decided. Against the original: contacts are found on the outlines themselves, to a tenth of a metre, and to the very
//! end of the path, which it loses by thinning out its points; a stop behind the start of the path is at its start,
//! where the original fails.

mod contact;
mod limits;
#[cfg(test)]
mod tests;
mod track;

pub use contact::Contact;
pub use limits::{Nudge, speed_limit};
pub use track::Track;

use super::object_decision::{Fence, Longitudinal};
use crate::decision::PathPoint;
use crate::st_graph::{BoundaryType, StBoundary, StPair};
use serde::{Deserialize, Serialize};

/// How much lower the far end of an approaching boundary is, m.
const APPROACHING: f64 = 1e-6;

/// Settings; names and values are the original's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpeedBoundsConfig {
    /// How far ahead, s.
    pub total_time: f64,
    /// Lateral acceleration in bends, m/s².
    pub max_centric_acceleration_limit: f64,
    /// By how much contacts with predicted obstacles are lengthened at both ends, m.
    pub point_extension: f64,
    /// No limit is lower than this, m/s.
    pub lowest_speed: f64,
    /// Whether one slows down beside what is nudged.
    pub enable_nudge_slowdown: bool,
    /// Share of the map's limit beside what stands.
    pub static_obs_nudge_speed_ratio: f64,
    /// The same beside what moves.
    pub dynamic_obs_nudge_speed_ratio: f64,
    /// Room beside the body within which one slows down, m.
    pub collision_safety_range: f64,
    /// Room beside the body that counts as the body, m.
    pub nonstatic_obstacle_nudge_l_buffer: f64,
    /// The same while lanes are changed.
    pub lane_change_obstacle_nudge_l_buffer: f64,
    /// By how much a stop grows until the end of the time, m: in the pass before the search and the one after it.
    pub boundary_buffer: [f64; 2],
}

impl Default for SpeedBoundsConfig {
    fn default() -> Self {
        Self {
            total_time: 7.0,
            max_centric_acceleration_limit: 2.0,
            point_extension: 0.0,
            lowest_speed: 2.5,
            enable_nudge_slowdown: true,
            static_obs_nudge_speed_ratio: 0.6,
            dynamic_obs_nudge_speed_ratio: 0.8,
            collision_safety_range: 1.0,
            nonstatic_obstacle_nudge_l_buffer: 0.4,
            lane_change_obstacle_nudge_l_buffer: 0.3,
            boundary_buffer: [0.25, 0.1],
        }
    }
}

impl SpeedBoundsConfig {
    /// Room beside the body that counts as the body, m.
    pub fn lateral_buffer(&self, is_changing_lanes: bool) -> f64 {
        if is_changing_lanes {
            self.lane_change_obstacle_nudge_l_buffer
        } else {
            self.nonstatic_obstacle_nudge_l_buffer
        }
    }
}

/// Where stops are mapped to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopGround<'a> {
    /// The path; two points or more.
    pub path: &'a [PathPoint],
    /// Length of the reference line, m.
    pub line_length: f64,
    /// Rear axle to front bumper, m.
    pub front_edge_to_center: f64,
    /// How far ahead, s.
    pub total_time: f64,
    /// By how much the stop grows until then, m.
    pub boundary_buffer: f64,
}

/// Boundaries with their decisions, for obstacles in the same order as `occupied` and `decisions`. What is ignored has
/// none any more; of all that is stopped for only the nearest has one, from there to the end of the path.
pub fn decided(
    occupied: &[Option<StBoundary>],
    decisions: &[Option<Longitudinal>],
    ground: &StopGround,
) -> Vec<Option<StBoundary>> {
    let stops = decisions
        .iter()
        .enumerate()
        .filter_map(|(k, decision)| match decision {
            Some(Longitudinal::Stop(fence)) => Some((k, *fence)),
            _ => None,
        });
    let nearest = stops.min_by(|a, b| a.1.s.total_cmp(&b.1.s));
    let mut boundaries: Vec<Option<StBoundary>> = occupied
        .iter()
        .zip(decisions)
        .map(|(boundary, decision)| {
            boundary
                .as_ref()
                .and_then(|boundary| with_decision(boundary, *decision))
        })
        .collect();
    if let Some((k, fence)) = nearest {
        boundaries[k] = stop(ground, fence);
    }
    boundaries
}

/// A boundary under a decision other than a stop.
fn with_decision(boundary: &StBoundary, decision: Option<Longitudinal>) -> Option<StBoundary> {
    let decided = |boundary: StBoundary, kind, fence: Fence| {
        boundary
            .with_kind(kind)
            .with_characteristic_length(fence.distance.abs())
    };
    match decision {
        None => Some(boundary.clone()),
        Some(Longitudinal::Ignore | Longitudinal::Stop(_)) => None,
        Some(Longitudinal::Follow(fence)) => Some(decided(boundary.clone(), BoundaryType::Follow, fence)),
        Some(Longitudinal::Overtake(_)) => Some(boundary.clone().with_kind(BoundaryType::Overtake)),
        Some(Longitudinal::Yield(fence)) => {
            let expanded = boundary.expanded_by_s(fence.distance.abs()).ok()?;
            Some(decided(expanded, BoundaryType::Yield, fence))
        }
    }
}

/// All of the path from a fence on, for all of the time.
pub fn stop(ground: &StopGround, fence: Fence) -> Option<StBoundary> {
    let [.., last] = ground.path else { return None };
    let s = fence.s - ground.front_edge_to_center;
    let at = if s > last.s {
        last.distance + (s - last.s)
    } else {
        distance_at(ground.path, s)
    };
    let lower = at.max(0.0);
    let upper = lower.max(last.distance).max(ground.line_length);
    let pairs = vec![
        StPair::new(0.0, lower, upper),
        StPair::new(ground.total_time, lower, upper + ground.boundary_buffer),
    ];
    let boundary = StBoundary::new(pairs).ok()?.with_kind(BoundaryType::Stop);
    Some(boundary.with_characteristic_length(ground.boundary_buffer))
}

/// Distance along the path at a station of the reference line; before its start it goes on straight.
fn distance_at(path: &[PathPoint], s: f64) -> f64 {
    let Some(last) = path.len().checked_sub(1).filter(|last| *last > 0) else {
        return 0.0;
    };
    let above = path.partition_point(|point| point.s <= s).clamp(1, last);
    let (a, b) = (&path[above - 1], &path[above]);
    let along = b.s - a.s;
    if along > 0.0 {
        a.distance + (s - a.s) / along * (b.distance - a.distance)
    } else {
        a.distance
    }
}

/// How far the car gets before anything is in its way, m: 0 if something comes nearer than all that drives away is;
/// infinite if nothing is there.
pub fn lowest_s<'a>(boundaries: impl IntoIterator<Item = &'a StBoundary>) -> f64 {
    let (mut coming, mut going) = (f64::INFINITY, f64::INFINITY);
    for boundary in boundaries {
        let (left, right) = (boundary.first().lower, boundary.last().lower);
        let lowest = left.min(right).max(0.0);
        if left - right > APPROACHING {
            coming = coming.min(lowest);
        } else {
            going = going.min(lowest);
        }
    }
    if coming < going { 0.0 } else { going }
}
