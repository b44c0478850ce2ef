//! What a decider asks of a line: Frenet coordinates and back, widths, lanes, neighbours, limits.
//!
//! World frame and Frenet frame in metres and radians, `l` to the left. Source: the original's
//! `modules/planning/reference_line/reference_line.cc`, `modules/map/pnc_map/path.cc` and
//! `modules/common/math/cartesian_frenet_conversion.cc`.

use super::lane::between;
use super::path::{Path, PathError, PathPoint};
use super::polyline::Projection;
use super::{LaneWaypoint, ObjectKind, RoadKind};
use crate::geometry::{Vec2, angle, cross};
use crate::reference_line::{LinePoint, LineQuery, SlPoint};
use crate::road::{BoundaryType, LaneId, Neighbour, Side};
use std::f64::consts::FRAC_PI_2;

/// How near a lane must be for its road's class to count, m.
const ROAD_RADIUS: f64 = 4.0;

/// How near a lane must be for its heading to count, m.
const LANE_HEADING_RADIUS: f64 = 5.0;

/// Where a body is in the Frenet frame, and how it moves there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrenetState {
    /// Station with its first and second derivative by time: m, m/s, m/s².
    pub s: [f64; 3],
    /// Offset with its first and second derivative by station: m, -, 1/m.
    pub l: [f64; 3],
}

/// A body's motion in the plane: speed along its heading, curvature of its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CartesianState {
    /// World position.
    pub position: Vec2,
    /// Heading, rad.
    pub theta: f64,
    /// Curvature of its way, 1/m.
    pub kappa: f64,
    /// Speed, m/s.
    pub v: f64,
    /// Acceleration, m/s².
    pub a: f64,
}

impl Path {
    /// Frenet coordinates of `point`: of the nearest piece, wherever that is. The ends go on straight.
    pub fn project(&self, point: Vec2) -> Projection {
        self.line.project(point)
    }

    /// The same for a point that is known to lie between two stations.
    pub fn project_between(&self, point: Vec2, start_s: f64, end_s: f64) -> Projection {
        let pieces = self.line.locate(start_s).0..self.line.locate(end_s).0 + 1;
        self.line.project_within(pieces, point)
    }

    /// The same for a line that ends at its ends: no station is beyond them.
    pub fn nearest(&self, point: Vec2) -> Projection {
        let at = self.project(point);
        Projection {
            s: at.s.clamp(0.0, self.length()),
            ..at
        }
    }

    /// Heading of the line where it is nearest to `point`.
    pub fn heading_along(&self, point: Vec2) -> f64 {
        self.point_at(self.project(point).s).heading
    }

    /// Whether `point` lies strictly between the edges of the line's lane.
    pub fn is_on_path(&self, point: Vec2) -> bool {
        let at = self.project(point);
        let within = |(left, right): (f64, f64)| at.l < left && at.l > -right;
        self.lane_width_at(at.s).is_some_and(within)
    }

    /// The point of the chord between the neighbours of the nearest point that is nearest to `point`. It has no
    /// waypoints.
    pub fn chord_point(&self, point: Vec2) -> PathPoint {
        let distance = |k: &usize| (self.points[*k].position - point).norm_squared();
        let nearest = (0..self.points.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let nearest = nearest.unwrap_or(0);
        let (from, to) = (
            &self.points[nearest.saturating_sub(1)],
            &self.points[(nearest + 1).min(self.points.len() - 1)],
        );
        let chord = to.position - from.position;
        let along = (point - from.position).dot(&chord) / chord.norm_squared();
        let t = if along.is_nan() {
            0.0
        } else {
            along.clamp(0.0, 1.0)
        };
        let mix = |a: f64, b: f64| a + (b - a) * t;
        PathPoint {
            position: from.position + chord * t,
            heading: between(from.heading, to.heading, t),
            kappa: mix(from.kappa, to.kappa),
            dkappa: mix(from.dkappa, to.dkappa),
            waypoints: Vec::new(),
        }
    }

    /// The first point at or beyond `s`; the last one beyond the end.
    pub fn index_from(&self, s: f64) -> usize {
        let at = self.stations().partition_point(|station| *station < s);
        at.min(self.points.len() - 1)
    }

    /// The point whose station is nearest to `s`; the later of two.
    pub fn nearest_point(&self, s: f64) -> &PathPoint {
        let above = self.index_from(s);
        let stations = self.stations();
        if above > 0 && (stations[above - 1] - s).abs() < (stations[above] - s).abs() {
            return &self.points[above - 1];
        }
        &self.points[above]
    }

    /// The point of the plane at `(s, l)`; `s` is clamped to the line.
    pub fn to_cartesian(&self, s: f64, l: f64) -> Vec2 {
        let at = self.point_at(s);
        let (sin, cos) = angle::sin_cos(at.heading);
        at.position + Vec2::new(-sin, cos) * l
    }

    /// How a body moves in the frame of the line. Meaningless where the body is further aside than the line's radius,
    /// or moves across it.
    pub fn to_frenet_state(&self, body: &CartesianState) -> FrenetState {
        let s = self.project(body.position).s;
        let at = self.point_at(s);
        let d = body.position - at.position;
        let (sin_r, cos_r) = angle::sin_cos(at.heading);
        let l = d.norm().copysign(cross(Vec2::new(cos_r, sin_r), d));
        let (sin, cos) = angle::sin_cos(body.theta - at.heading);
        let tan = sin / cos;
        let shrink = 1.0 - at.kappa * l;
        let dl = shrink * tan;
        let turn = at.dkappa * l + at.kappa * dl;
        let bend = body.kappa * shrink / cos - at.kappa;
        let ddl = -turn * tan + shrink / (cos * cos) * bend;
        let ds = body.v * cos / shrink;
        let dds = (body.a * cos - ds * ds * (dl * bend - turn)) / shrink;
        FrenetState {
            s: [s, ds, dds],
            l: [l, dl, ddl],
        }
    }

    /// Lanes at `s`, each once.
    pub fn lanes_at(&self, s: f64) -> Vec<LaneId> {
        let mut lanes: Vec<LaneId> = Vec::new();
        for waypoint in self.point_at(s).waypoints {
            if !lanes.contains(&waypoint.lane) {
                lanes.push(waypoint.lane);
            }
        }
        lanes
    }

    /// The lowest speed limit of the lanes at `s`, m/s; `None` where none has any.
    pub fn speed_limit_at(&self, s: f64) -> Option<f64> {
        let lanes = self.lanes_at(s).into_iter();
        let limits = lanes.filter_map(|lane| self.map.lane(lane).data().speed_limit);
        limits.min_by(f64::total_cmp)
    }

    /// The class of the road at `s`: of the first lane nearby whose road has one.
    pub fn road_kind_at(&self, s: f64) -> RoadKind {
        let lanes = self.map.lanes_within(self.to_cartesian(s, 0.0), ROAD_RADIUS);
        let roads = lanes.into_iter().filter_map(|lane| self.map.lane(lane).road());
        let kinds = roads.filter_map(|name| {
            let road = self.map.roads().iter().find(|road| road.id == name);
            road.map(|road| road.kind)
        });
        let mut known = kinds.filter(|kind| *kind != RoadKind::Unknown);
        known.next().unwrap_or(RoadKind::Unknown)
    }

    /// The adjacent lane of one kind at `s`, and its whole width there, m.
    pub fn neighbour_at(&self, kind: Neighbour, s: f64) -> Option<(LaneId, f64)> {
        let at = self.point_at(s);
        let lane = at.waypoints.first()?.lane;
        let id = *self.map.lane(lane).neighbours(kind).first()?;
        let neighbour = self.map.lane(id);
        let (left, right) = neighbour.width_at(neighbour.project(at.position).s);
        Some((id, left + right))
    }

    /// Lines on the (left, right) edges of the lane at `s`; `None` where the line follows no lane.
    pub fn boundary_types_at(&self, s: f64) -> Option<(BoundaryType, BoundaryType)> {
        let LaneWaypoint { lane, s, .. } = *self.point_at(s).waypoints.first()?;
        let kind = |side| self.map.lane(lane).boundary_type_at(side, s);
        Some((kind(Side::Left), kind(Side::Right)))
    }

    /// The part of the line from `back` metres behind `s` to `forward` metres ahead, point by point. Its stations
    /// begin at 0.
    ///
    /// # Errors
    /// [`PathError::TooFewPoints`] where fewer than two points are left.
    pub fn segment(&self, s: f64, back: f64, forward: f64) -> Result<Self, PathError> {
        let from = self.stations().partition_point(|station| *station < s - back);
        let to = self.stations().partition_point(|station| *station <= s + forward);
        let points = self.points.get(from..to).unwrap_or_default();
        Self::through(&self.map, points.to_vec(), self.quirks)
    }
}

impl LineQuery for Path {
    fn length(&self) -> f64 {
        self.length()
    }

    fn lane_width(&self, s: f64) -> Option<(f64, f64)> {
        self.lane_width_at(s)
    }

    fn road_width(&self, s: f64) -> Option<(f64, f64)> {
        self.road_width_at(s)
    }

    fn offset_to_map(&self, s: f64) -> Option<f64> {
        self.nearest_point(s).waypoints.first().map(|waypoint| waypoint.l)
    }

    fn boundary_types(&self, s: f64) -> Option<(BoundaryType, BoundaryType)> {
        self.boundary_types_at(s)
    }

    fn neighbour_width(&self, neighbour: Neighbour, s: f64) -> Option<f64> {
        self.neighbour_at(neighbour, s).map(|(_, width)| width)
    }

    fn near_junction(&self, s: f64, radius: f64) -> bool {
        let at = self.line.point_at(s);
        !self
            .map
            .objects_within(ObjectKind::Junction, at, radius)
            .is_empty()
    }

    fn lane_heading(&self, point: Vec2, theta: f64) -> Option<f64> {
        let nearest = self
            .map
            .nearest_lane_with_heading(point, LANE_HEADING_RADIUS, theta, FRAC_PI_2)?;
        Some(self.map.lane(nearest.lane).heading_at(nearest.s))
    }

    fn point(&self, s: f64) -> LinePoint {
        let at = self.point_at(s);
        LinePoint {
            x: at.position.x,
            y: at.position.y,
            theta: at.heading,
            kappa: at.kappa,
        }
    }

    fn to_frenet(&self, point: Vec2) -> SlPoint {
        let Projection { s, l, .. } = self.project(point);
        SlPoint { s, l }
    }
}
