//! Cross-sections of a lane: the smooth centre line with the distances to all bounds along its normal.

use super::Source;
use super::budget::Budget;
use super::centre::Strip;
use super::smooth::CurvePoint;
use super::surface::FarBound;
use crate::import::ImportError;
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::road::{LanePoint, Side};

/// Points of a lane are at least this far apart, m.
const LEAST_STEP: f64 = 1e-5;

/// What lies beside a lanelet, from the nearest on.
pub(super) struct Beside {
    pub(super) left: Vec<FarBound>,
    pub(super) right: Vec<FarBound>,
}

/// The lane points of lanelet `number` along its smooth line.
pub(super) fn lane_points(
    number: usize,
    line: &[CurvePoint],
    beside: &Beside,
    strips: &[Option<Strip>],
    budget: &mut Budget,
    source: &mut Source<'_, '_>,
) -> Result<Vec<LanePoint>, ImportError> {
    let speed_limit = source.lanelets[number].speed_limit.unwrap_or(f64::INFINITY);
    let last = (line.len() - 1) as f64;
    let mut points: Vec<LanePoint> = Vec::with_capacity(line.len());
    for (k, at) in line.iter().enumerate() {
        let mut rays = Rays {
            strips,
            at: *at,
            share: k as f64 / last,
            looked_at: 0,
        };
        let (left, road_left) = rays.edges(number, Side::Left, &beside.left);
        let (right, road_right) = rays.edges(number, Side::Right, &beside.right);
        budget.stretch(left + right, rays.looked_at, number, source)?;
        let CurvePoint {
            position,
            theta,
            kappa,
        } = *at;
        let s = points.last().map_or(0.0, |before| before.s + arc(before, at));
        if points.last().is_some_and(|before| s - before.s < LEAST_STEP) {
            continue;
        }
        points.push(LanePoint {
            s,
            x: position.x,
            y: position.y,
            theta,
            kappa,
            left,
            right,
            road_left,
            road_right,
            speed_limit,
        });
    }
    Ok(points)
}

/// Length of the arc from a point to the next one.
fn arc(from: &LanePoint, to: &CurvePoint) -> f64 {
    let chord = (to.position - Vec2::new(from.x, from.y)).norm();
    let turn = angle::difference(to.theta, from.theta);
    chord * (1.0 + turn * turn / 24.0)
}

/// The normal of a lane at one point, to both sides.
struct Rays<'a> {
    strips: &'a [Option<Strip>],
    at: CurvePoint,
    share: f64,
    looked_at: usize,
}

impl Rays<'_> {
    /// Distances to the lane's own edge and to that of the road.
    fn edges(&mut self, number: usize, side: Side, beyond: &[FarBound]) -> (f64, f64) {
        let own = FarBound {
            lanelet: number,
            side,
            reverse: false,
        };
        let edge = self.distance(own, side, 0.0);
        let road = beyond
            .iter()
            .fold(edge, |least, bound| self.distance(*bound, side, least));
        (edge, road)
    }

    /// Distance to a bound that is at least `least` away.
    fn distance(&mut self, bound: FarBound, side: Side, least: f64) -> f64 {
        let Some(strip) = &self.strips[bound.lanelet] else {
            return least;
        };
        let line = match bound.side {
            Side::Left => &strip.left,
            Side::Right => &strip.right,
        };
        let (sin, cos) = angle::sin_cos(self.at.theta);
        let normal = Vec2::new(-sin, cos) * side.sign();
        let share = if bound.reverse {
            1.0 - self.share
        } else {
            self.share
        };
        let found = line.crossing(self.at.position, normal, share, least);
        self.looked_at += found.looked_at;
        found.distance
    }
}
