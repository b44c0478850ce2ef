//! One lane of an HD map: a polyline with tables beside it.
//!
//! Metres, radians; stations along the chords of the centre line, `l` to the left, widths positive to each side.
//! Source: the original's `modules/map/hdmap/hdmap_common.cc`, class `LaneInfo`.

use super::ObjectKind;
use super::data::LaneData;
use super::polyline::{Foot, Polyline, Projection, SAME_POINT};
use crate::geometry::{Vec2, angle};
use crate::road::{BoundaryType, LaneId, Neighbour, Side};

/// How far beyond its ends a point still is on a lane, and by how much curvatures take a piece for longer than it is,
/// so that a piece without length has one, m.
const TOLERANCE: f64 = 1e-3;

/// A lane with its links, all of them to lanes of the same map. Immutable.
#[derive(Clone, Debug)]
pub struct HdLane {
    data: LaneData,
    centre: Polyline,
    headings: Vec<f64>,
    pub(super) links: Links,
}

/// What a lane is connected with; whatever its file names but does not hold is left out.
#[derive(Clone, Debug, Default)]
pub(super) struct Links {
    pub(super) predecessors: Vec<LaneId>,
    pub(super) successors: Vec<LaneId>,
    pub(super) neighbours: [Vec<LaneId>; 4],
    /// Overlaps by kind of the other object, as places in the map's list.
    pub(super) overlaps: [Vec<usize>; ObjectKind::COUNT],
    /// Road and section.
    pub(super) road: Option<(String, String)>,
}

/// Half widths at a station: (left, right), m.
pub type HalfWidths = (f64, f64);

impl HdLane {
    /// `None` when its finite points span no length.
    pub(super) fn new(data: LaneData) -> Option<Self> {
        let centre = Polyline::new(apart(&data.points))?;
        Some(Self {
            headings: centre.headings(),
            data,
            centre,
            links: Links::default(),
        })
    }

    /// What its file says.
    pub fn data(&self) -> &LaneData {
        &self.data
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.data.id
    }

    /// Length of its centre line, m; not the length that its file names.
    pub fn length(&self) -> f64 {
        self.centre.length()
    }

    /// Points of its centre line, each apart from the one before.
    pub fn points(&self) -> &[Vec2] {
        self.centre.points()
    }

    /// Station of every point, m.
    pub fn stations(&self) -> &[f64] {
        self.centre.stations()
    }

    /// Heading of every point: that of the chord behind it; the last one repeats.
    pub fn headings(&self) -> &[f64] {
        &self.headings
    }

    pub(super) fn centre(&self) -> &Polyline {
        &self.centre
    }

    /// Lanes that lead here, in file order.
    pub fn predecessors(&self) -> &[LaneId] {
        &self.links.predecessors
    }

    /// Lanes to go on to, in file order.
    pub fn successors(&self) -> &[LaneId] {
        &self.links.successors
    }

    /// Adjacent lanes of one kind, in file order.
    pub fn neighbours(&self, kind: Neighbour) -> &[LaneId] {
        &self.links.neighbours[kind.index()]
    }

    /// Name of the road it belongs to.
    pub fn road(&self) -> Option<&str> {
        self.links.road.as_ref().map(|(road, _)| road.as_str())
    }

    /// Name of the road's section it belongs to.
    pub fn section(&self) -> Option<&str> {
        self.links.road.as_ref().map(|(_, section)| section.as_str())
    }

    /// The point of the centre line at `s`, clamped to the lane.
    pub fn point_at(&self, s: f64) -> Vec2 {
        self.centre.point_at(s)
    }

    /// The heading at `s`, clamped to the lane: turns evenly from vertex to vertex.
    pub fn heading_at(&self, s: f64) -> f64 {
        let at = self.vertex_not_before(s);
        let stations = self.stations();
        if at == stations.len() {
            return self.headings[at - 1];
        }
        if at == 0 {
            return self.headings[0];
        }
        let t = (s - stations[at - 1]) / (stations[at] - stations[at - 1]);
        between(self.headings[at - 1], self.headings[at], t)
    }

    /// How much the heading turns per metre around `s`, 1/m; 0 outside the lane.
    pub fn curvature_at(&self, s: f64) -> f64 {
        let at = self.vertex_not_before(s);
        let stations = self.stations();
        if at == 0 || at == stations.len() {
            return 0.0;
        }
        let turn = angle::difference(self.headings[at], self.headings[at - 1]);
        turn / (stations[at] - stations[at - 1] + TOLERANCE)
    }

    fn vertex_not_before(&self, s: f64) -> usize {
        self.stations().partition_point(|at| *at < s)
    }

    /// Half widths of the lane at `s`; its tables hold outside. An empty table is 0 wide.
    pub fn width_at(&self, s: f64) -> HalfWidths {
        (
            in_table(&self.data.left_samples, s),
            in_table(&self.data.right_samples, s),
        )
    }

    /// Twice the smaller half width at `s`, m.
    pub fn effective_width_at(&self, s: f64) -> f64 {
        let (left, right) = self.width_at(s);
        2.0 * left.min(right)
    }

    /// Half widths of the road at `s`, seen from the centre line of this lane.
    pub fn road_width_at(&self, s: f64) -> HalfWidths {
        (
            in_table(&self.data.left_road_samples, s),
            in_table(&self.data.right_road_samples, s),
        )
    }

    /// The line on one edge at `s`: the first type of the last entry not beyond `s`. Unknown before the first entry.
    pub fn boundary_type_at(&self, side: Side, s: f64) -> BoundaryType {
        let types = match side {
            Side::Left => &self.data.left_boundary.types,
            Side::Right => &self.data.right_boundary.types,
        };
        let entry = types.iter().rfind(|(from, _)| *from <= s);
        let kind = entry.and_then(|(_, kinds)| kinds.first());
        kind.copied().unwrap_or(BoundaryType::Unknown)
    }

    /// Frenet coordinates of `point`; the ends of the lane go on straight.
    pub fn project(&self, point: Vec2) -> Projection {
        self.centre.project(point)
    }

    /// The point of the centre line that is nearest to `point`.
    pub fn foot(&self, point: Vec2) -> Foot {
        self.centre.foot(point)
    }

    /// Whether `point` lies strictly between the edges of the lane, and between its ends.
    pub fn contains(&self, point: Vec2) -> bool {
        let Projection { s, l, .. } = self.project(point);
        let (left, right) = self.width_at(s);
        let along = s >= -TOLERANCE && s <= self.length() + TOLERANCE;
        along && l < left && l > -right
    }
}

/// The points, of those nearer together than [`SAME_POINT`] only the last.
fn apart(points: &[Vec2]) -> Vec<Vec2> {
    let mut apart: Vec<Vec2> = Vec::with_capacity(points.len());
    for point in points {
        if apart
            .last()
            .is_some_and(|last| (point - last).norm() <= SAME_POINT)
        {
            apart.pop();
        }
        apart.push(*point);
    }
    apart
}

/// The heading a fraction `t` of the smallest turn from `a` to `b`.
pub(super) fn between(a: f64, b: f64, t: f64) -> f64 {
    angle::wrap(a + angle::difference(b, a) * t)
}

/// A value between the entries of a table by ascending station.
fn in_table(table: &[(f64, f64)], s: f64) -> f64 {
    let after = table.partition_point(|(at, _)| *at <= s);
    match (after.checked_sub(1).map(|k| table[k]), table.get(after).copied()) {
        (Some((a, at_a)), Some((b, at_b))) => at_a + (at_b - at_a) * (s - a) / (b - a),
        (Some((_, only)), None) | (None, Some((_, only))) => only,
        (None, None) => 0.0,
    }
}
