//! What a decision itself says about a bad end: whether its bound, its path or its speed let it happen.
//!
//! * Bound: what was met stood at that place already, and the bound, swept by the car's width, holds it; or the
//!   bound reaches off the road.
//! * Path: the path leaves its bound, or its footprints meet something standing or leave the road.
//! * Speed: otherwise. The way was free of what stands, and something that moves was there at that time; or the way
//!   ended before what was met, and the car did not.
//!
//! Frenet plane of the line planned along, metres; footprints are the true ones in world axes.

use super::Link;
use super::tracks::OFF_ROAD;
use corridor_decider::decision::{Decision, Stop, StopCause};
use corridor_decider::frame::{Frame, ObstacleId};
use corridor_decider::geometry::{ConvexPolygon, Vec2};
use corridor_decider::reference_line::{LineQuery, ReferenceLine, SlPoint};
use corridor_decider::tasks::path_bounds::BoundPoint;
use corridor_scenarios::Scenario;

/// Less than this of an overlap is rounding and the tracker's tolerance, m.
const TOLERANCE: f64 = 0.1;

/// How far apart points of an outline are when it is put on a line, m: several between two stations of a bound.
const PIECE: f64 = 0.1;

/// Farther from where it was when decided than this, an obstacle has moved since, m.
const MOVED: f64 = 0.1;

/// A decision with its frame, in a scenario.
#[derive(Clone, Copy, Debug)]
pub struct Inspection<'a> {
    /// Where.
    pub scenario: &'a Scenario,
    /// What was seen.
    pub frame: &'a Frame,
    /// What was decided.
    pub decision: &'a Decision,
}

impl Inspection<'_> {
    /// The link that let the car meet an obstacle whose outline was `met` then.
    pub fn of_collision(&self, id: ObstacleId, met: &ConvexPolygon) -> Link {
        let seen = self.frame.obstacles.iter().find(|o| o.id == id);
        let stood = seen.is_some_and(|o| {
            let middle = |of: &ConvexPolygon| of.vertices().iter().sum::<Vec2>() / of.vertices().len() as f64;
            (middle(&o.footprint()) - middle(met)).norm() <= MOVED
        });
        if stood && self.bound_holds(met) {
            Link::Bound
        } else if self.path_leaves_bound() || (stood && self.path_meets(met)) {
            Link::Path
        } else {
            Link::Speed
        }
    }

    /// The link that led the car off the road.
    pub fn of_road(&self) -> Link {
        let off = |point: Vec2| self.scenario.map.distance_off_road(point) > OFF_ROAD;
        let half_width = self.scenario.vehicle.half_width();
        let bound_leads_off = self.on_bound(|line, point| {
            [point.l_min - half_width, point.l_max + half_width]
                .map(|l| line.to_cartesian(SlPoint { s: point.s, l }))
                .into_iter()
                .any(off)
        });
        let mut footprints = self.footprints();
        let path_leads_off = footprints.any(|body| body.vertices().iter().any(|corner| off(*corner)));
        match (path_leads_off, bound_leads_off) {
            (true, true) => Link::Bound,
            (true, false) => Link::Path,
            (false, _) => Link::Tracker,
        }
    }

    /// The link that keeps the car from arriving, by what it stops for.
    pub fn of_standing(&self) -> Link {
        match self.decision.stop {
            Some(Stop {
                cause: StopCause::Blocked(_),
                ..
            }) => Link::Bound,
            _ if self.decision.fallback.is_some() && self.decision.chosen.is_none() => Link::Path,
            Some(Stop {
                cause: StopCause::PathEnd,
                ..
            }) => Link::Path,
            _ => Link::Speed,
        }
    }

    fn line(&self) -> Option<&ReferenceLine> {
        self.frame.lines.get(self.decision.line).map(|line| &*line.line)
    }

    /// The stations of the chosen bound that promise something.
    fn bound(&self) -> &[BoundPoint] {
        let chosen = self.decision.chosen.and_then(|k| self.decision.candidates.get(k));
        chosen.map_or(&[], |candidate| {
            let bound = &candidate.bound;
            &bound.points[..bound.points.len() - bound.padding.min(bound.points.len())]
        })
    }

    fn on_bound(&self, holds: impl Fn(&ReferenceLine, &BoundPoint) -> bool) -> bool {
        self.line()
            .is_some_and(|line| self.bound().iter().any(|point| holds(line, point)))
    }

    /// Whether the bound, swept by the car's width, holds a part of an outline.
    fn bound_holds(&self, met: &ConvexPolygon) -> bool {
        let Some(line) = self.line() else { return false };
        let outline = outline(line, met);
        let half_width = self.scenario.vehicle.half_width();
        self.bound().windows(2).any(|pair| {
            let beside = outline.iter().filter(|p| pair[0].s <= p.s && p.s <= pair[1].s);
            let range = beside.fold(None, |range: Option<(f64, f64)>, p| {
                let (low, high) = range.unwrap_or((p.l, p.l));
                Some((low.min(p.l), high.max(p.l)))
            });
            let right = pair[0].l_min.min(pair[1].l_min) - half_width;
            let left = pair[0].l_max.max(pair[1].l_max) + half_width;
            range.is_some_and(|(low, high)| high > right + TOLERANCE && low < left - TOLERANCE)
        })
    }

    fn path_leaves_bound(&self) -> bool {
        let bound = self.bound();
        self.decision.path.iter().any(|point| {
            let next = bound.partition_point(|p| p.s <= point.s);
            let Some((a, b)) = next.checked_sub(1).map(|k| &bound[k]).zip(bound.get(next)) else {
                return false;
            };
            point.l < a.l_min.min(b.l_min) - TOLERANCE || point.l > a.l_max.max(b.l_max) + TOLERANCE
        })
    }

    fn path_meets(&self, met: &ConvexPolygon) -> bool {
        self.footprints().any(|body| body.overlaps(met))
    }

    /// The ground that the car covers along its path, or along its trajectory where a planner gives no path.
    fn footprints(&self) -> impl Iterator<Item = ConvexPolygon> + '_ {
        let path = self.decision.path.iter().map(|point| point.pose);
        let driven = self.decision.trajectory.iter().map(|point| point.pose);
        let alone = self.decision.path.is_empty();
        path.chain(driven.filter(move |_| alone))
            .map(|pose| self.scenario.vehicle.footprint(pose))
    }
}

/// An outline in short pieces on a line.
fn outline(line: &ReferenceLine, of: &ConvexPolygon) -> Vec<SlPoint> {
    let mut points = Vec::new();
    for (a, b) in of.edges() {
        let pieces = ((b - a).norm() / PIECE).ceil().max(1.0);
        let mut k = 0.0;
        while k < pieces {
            points.push(line.to_frenet(a + (b - a) * (k / pieces)));
            k += 1.0;
        }
    }
    points
}
