//! Where the car may be at each knot, and how fast.

use super::guide::STEP;
use crate::piecewise_jerk::Limits;
use crate::planner::{LinePlan, TaskError};
use crate::st_graph::{BoundaryType, SpeedData, SpeedPoint};

/// Room between what the car can just do and what it has to do, m and m/s: limits that touch leave no inside.
const ROOM: (f64, f64) = (0.02, 0.02);

/// What a car that stands may move, m/s: limits that coincide leave no inside.
pub(super) const STANDING: f64 = 1e-3;

/// For how many knots the guide has to have stood until the car must.
const SETTLING: usize = 2;

/// Margin kept to a moving obstacle where the car can no more keep the wanted one, m.
const LEAST_GAP: f64 = 0.5;

/// How much faster than the limit the guide may be followed, m/s.
const ABOVE: f64 = 0.1;

/// What the car can do.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    /// Speed at the start, m/s.
    pub v: f64,
    /// Acceleration there, m/s².
    pub a: f64,
    /// Hardest braking, m/s², negative.
    pub braking: f64,
    /// Fastest change of it, m/s³.
    pub jerk: f64,
}

impl Reach {
    /// The profile of a car that brakes as it can: nobody can be nearer than that.
    pub(super) fn least_profile(&self, count: usize) -> Vec<SpeedPoint> {
        let mut now = SpeedPoint {
            v: self.v,
            a: self.a,
            ..SpeedPoint::default()
        };
        let mut points = Vec::with_capacity(count);
        for k in 0..count {
            points.push(now);
            let a = (now.a - self.jerk * STEP).max(self.braking);
            let v = now.v + f64::midpoint(now.a, a) * STEP;
            let moved = STEP * (now.v + STEP * (now.a / 3.0 + a / 6.0));
            now = if v > 0.0 {
                SpeedPoint {
                    s: now.s + moved,
                    v,
                    a,
                    ..now
                }
            } else {
                SpeedPoint {
                    s: now.s + stopping_way(&now),
                    v: 0.0,
                    a: 0.0,
                    ..now
                }
            };
            now.t = (k + 1) as f64 * STEP;
        }
        points
    }
}

/// The way on which a car comes to stand within a step.
fn stopping_way(now: &SpeedPoint) -> f64 {
    now.v * STEP / 2.0
}

/// Lowest and highest place per knot.
pub(super) fn stations(
    plan: &LinePlan,
    guide: &SpeedData,
    least: &[SpeedPoint],
    wall: f64,
) -> Result<Vec<Limits>, TaskError> {
    let config = &plan.scene.config.speed;
    let mut limits = Vec::with_capacity(guide.points.len());
    for (point, least) in guide.points.iter().zip(least) {
        let mut upper = wall.max(point.s).max(least.s + ROOM.0);
        for there in plan
            .on_path
            .iter()
            .filter(|there| stays_behind(there.boundary.kind))
        {
            let Some(edges) = there
                .boundary
                .edges_at(point.t)
                .filter(|edges| edges.upper > least.s)
            else {
                continue;
            };
            if least.s > edges.lower {
                return Err(TaskError::Unavoidable(there.id));
            }
            let wanted = edges.lower - config.least_stop_distance;
            let kept = wanted
                .max(least.s + ROOM.0)
                .min((edges.lower - LEAST_GAP).max(least.s + ROOM.0));
            upper = upper.min(kept.max(point.s.min(edges.lower)));
        }
        limits.push((0.0, upper));
    }
    Ok(limits)
}

fn stays_behind(kind: BoundaryType) -> bool {
    matches!(
        kind,
        BoundaryType::Follow | BoundaryType::Yield | BoundaryType::Stop
    )
}

/// Lowest and highest speed per knot: what the road allows where the guide is, or what the car cannot help. Where the
/// guide has come to stand the car stands too: a small speed costs little, and it would never quite stop rolling.
pub(super) fn speeds(plan: &LinePlan, guide: &SpeedData, least: &[SpeedPoint]) -> Vec<Limits> {
    let limit = |s: f64| {
        plan.envelope
            .as_ref()
            .map_or(f64::INFINITY, |envelope| envelope.at(s))
    };
    let mut stands_for = 0;
    let highest = |(point, least): (&SpeedPoint, &SpeedPoint)| {
        stands_for = if point.v <= 0.0 { stands_for + 1 } else { 0 };
        let wanted = if stands_for > SETTLING {
            STANDING
        } else {
            limit(point.s).max(point.v) + ABOVE
        };
        let forced = if least.v > 0.0 { least.v + ROOM.1 } else { 0.0 };
        (0.0, wanted.max(forced))
    };
    guide.points.iter().zip(least).map(highest).collect()
}
