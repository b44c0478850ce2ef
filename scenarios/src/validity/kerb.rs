//! Free stretches along the right edge of the road: where a car could stand.
//!
//! Two lengths are measured. The *strict* one counts every stretch onto which the car's body fits at all; the
//! *roomy* one only what also leaves the clearances that a careful planner keeps. A planner must find a place
//! where the roomy one is long enough to turn in, and cannot find one where the strict one is shorter than the car.

use super::Scene;

/// How far from the road's edge the car may stand, m: the original's `pull_over_road_edge_buffer`.
const EDGE_GAP: f64 = 0.15;

/// Sideways room that a careful planner keeps, m: the original's obstacle buffer of 0.4 m and a quarter of a
/// car's width to move in.
const SIDE_ROOM: f64 = 0.93;

/// Length that a careful planner needs, in car lengths: the original's window.
const LENGTHS: f64 = 1.5;

/// Length for turning in from the lane without reversing, m: two metres and a half sideways at the smallest turning
/// radius of a car take seven and a half, and the tail needs some more.
const TURN_IN: f64 = 10.0;

/// How far beyond the destination the window reaches, m: the original's front buffer.
const BEYOND_DESTINATION: f64 = 3.0;

/// Braking with which a driver stops at the road's edge, m/s².
const COMFORTABLE_BRAKING: f64 = 2.0;

/// From the ego's rear axle to the end of what is planned, m: 200 points, half a metre apart.
pub(crate) const HORIZON: f64 = 100.0;

/// What the road's edge offers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct KerbGap {
    /// Longest stretch onto which the body fits, m.
    pub(crate) strict: f64,
    /// Longest stretch with a careful planner's clearances, m.
    pub(crate) roomy: f64,
    /// Below this `strict` is too short for the car, m.
    pub(crate) least: f64,
    /// From this on `roomy` is long enough for everyone, m.
    pub(crate) ample: f64,
}

impl KerbGap {
    /// Measures between the ego and the destination, or as far as one plans.
    pub(crate) fn measure(scene: &Scene<'_>) -> Self {
        let vehicle = &scene.draft.vehicle;
        let end = scene.draft.destination.unwrap_or(scene.draft.ego_s + HORIZON);
        let speed = scene.draft.ego.speed.max(scene.draft.cruise_speed);
        let braking = speed * speed / (2.0 * COMFORTABLE_BRAKING) + speed * scene.draft.command_time;
        let strip = vehicle.width;
        Self {
            // No car gets sideways to the edge within less than its own length.
            strict: longest(scene, (scene.front(), end + vehicle.length), strip),
            roomy: longest(
                scene,
                (scene.front() + braking, end + BEYOND_DESTINATION),
                EDGE_GAP + strip + SIDE_ROOM,
            ),
            least: vehicle.length,
            ample: LENGTHS * vehicle.length + TURN_IN,
        }
    }
}

/// The longest stretch of `range` along which a strip of this width at the right edge is free of junctions and of
/// what stands.
fn longest(scene: &Scene<'_>, range: (f64, f64), width: f64) -> f64 {
    let line = &scene.road.line;
    let mut blocked: Vec<(f64, f64)> = scene
        .standing()
        .filter(|body| {
            let (_, right) = line.sample_at(body.s.0).road_width;
            body.l.0 < width - right
        })
        .map(|body| body.s)
        .collect();
    let from = line.samples().partition_point(|sample| sample.s < range.0);
    let near = line.samples()[from..]
        .iter()
        .take_while(|sample| sample.s <= range.1);
    blocked.extend(
        near.filter(|sample| sample.in_junction)
            .map(|sample| (sample.s, sample.s)),
    );
    let line_end = line.samples().last().map_or(0.0, |sample| sample.s);
    blocked.push((line_end, f64::MAX));
    blocked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut free_from, mut best) = (range.0, 0.0_f64);
    for (start, end) in blocked {
        best = best.max(start.min(range.1) - free_from);
        free_from = free_from.max(end);
    }
    best.max(range.1 - free_from)
}
