//! The path-time graph: when which part of the line is occupied by what touches the lane.
//!
//! An obstacle is a quadrilateral in the `(t, s)` plane, from where it is when it comes into the lane to where it is when
//! it leaves it. In the original the corners were lost and the graph was always empty.

use super::cost::Blocked;
use super::grid::{HORIZON, TIMES};
use super::lateral_bounds::StaticBox;
use super::line_table::LineTable;
use super::prediction::pose_at;
use crate::frame::{Obstacle, ObstacleId};
use crate::geometry::{Pose, Vec2};
use crate::reference_line::{LineQuery, SlPoint};
use crate::st_graph::{StPair, StPoint};

/// How far ahead obstacles matter, m (`speed_lon_decision_horizon`).
const RANGE: f64 = 200.0;

/// Half the width of a lane that the map does not tell, m (half `default_reference_line_width`).
const HALF_WIDTH: f64 = 2.0;

/// Time between two points beside an entry, s (`time_min_density`).
const DENSITY: f64 = 1.0;

/// Times nearer than this are one, s.
const SAME_TIME: f64 = 1e-6;

/// By less than this the lane widens or narrows between two places of a body that are about abreast, m.
const WIDENING: f64 = 0.2;

/// A glance tells a station to this, m.
const ROUGHLY: f64 = 0.2;

/// Half-widths of the lane (left, right) at a station, m; `None` where it is not known.
pub type LaneWidth<'a> = &'a dyn Fn(f64) -> Option<(f64, f64)>;

/// Frenet coordinates of a point near a station.
pub type Project<'a> = &'a dyn Fn(Vec2, f64) -> SlPoint;

/// Frenet coordinates of points on a smooth line. A station that is not-a-number is none.
pub fn projection<L: LineQuery + ?Sized>(line: &L) -> impl Fn(Vec2, f64) -> SlPoint + '_ {
    |point, near| {
        if near.is_finite() {
            line.to_frenet_near(point, near)
        } else {
            line.to_frenet(point)
        }
    }
}

/// What one obstacle occupies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathTimeEntry {
    /// Which obstacle.
    pub id: ObstacleId,
    /// When it comes in, and what it occupies then.
    pub enters: StPair,
    /// When it leaves, and what it occupies then.
    pub leaves: StPair,
}

impl PathTimeEntry {
    /// What it occupies at a time: (lower, upper); `None` when it is not there.
    pub fn occupied_at(&self, t: f64) -> Option<(f64, f64)> {
        let inside = (self.enters.t..=self.leaves.t).contains(&t);
        inside.then(|| (self.edge(t, |pair| pair.lower), self.edge(t, |pair| pair.upper)))
    }

    fn edge(&self, t: f64, of: impl Fn(&StPair) -> f64) -> f64 {
        let (from, to) = (of(&self.enters), of(&self.leaves));
        let duration = self.leaves.t - self.enters.t;
        if duration.abs() <= SAME_TIME {
            return from;
        }
        from + (to - from) * ((t - self.enters.t) / duration)
    }

    /// Points beside it about a second apart: above its upper edge for a positive distance, below its lower one else.
    pub fn points_beside(&self, distance: f64) -> Vec<StPoint> {
        let duration = self.leaves.t - self.enters.t;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most eight seconds"
        )]
        let steps = (duration / DENSITY + 1.0).floor().max(1.0) as usize;
        let point = |k: usize| {
            let t = self.enters.t + k as f64 * (duration / steps as f64);
            let s = if distance > 0.0 {
                self.edge(t, |pair| pair.upper)
            } else {
                self.edge(t, |pair| pair.lower)
            };
            StPoint::new(t, s + distance)
        };
        (0..=steps).map(point).collect()
    }
}

/// The graph along one line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathTimeGraph {
    /// The entries by ascending identity.
    pub entries: Vec<PathTimeEntry>,
    /// What stands in the lane, by ascending start.
    pub standing: Vec<StaticBox>,
}

/// The extent of a body in the Frenet frame.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Extent {
    s: (f64, f64),
    l: (f64, f64),
}

impl PathTimeGraph {
    /// The graph of obstacles from station `s` of the car on.
    pub fn new(
        obstacles: &[Obstacle],
        s: f64,
        line: &LineTable,
        lane_width: LaneWidth,
        project: Project,
    ) -> Self {
        let survey = Survey {
            s,
            line,
            lane_width,
            project,
        };
        let mut graph = Self::default();
        for obstacle in obstacles {
            if obstacle.prediction.is_empty() {
                graph.add_standing(obstacle, &survey);
            } else if let Some(entry) = survey.moving(obstacle) {
                graph.entries.push(entry);
            }
        }
        // Sums over entries must not hang on the order in which obstacles come.
        graph.entries.sort_by_key(|entry| entry.id);
        graph
            .standing
            .sort_by(|a, b| a.s.0.total_cmp(&b.s.0).then(a.id.cmp(&b.id)));
        graph
    }

    fn add_standing(&mut self, obstacle: &Obstacle, survey: &Survey) {
        let pose = Posed::from(obstacle.pose);
        let extent = survey.extent(&Body::of(obstacle), pose, &mut { f64::NAN });
        if !survey.touches(&extent) {
            return;
        }
        let (s, l) = (extent.s, extent.l);
        self.entries.push(PathTimeEntry {
            id: obstacle.id,
            enters: StPair::new(0.0, s.0, s.1),
            leaves: StPair::new(HORIZON, s.0, s.1),
        });
        self.standing.push(StaticBox {
            id: obstacle.id,
            s,
            l,
        });
    }

    /// What is occupied at a time, in the order of the entries.
    pub fn blocked_at(&self, t: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.entries.iter().filter_map(move |entry| entry.occupied_at(t))
    }

    /// What is occupied at each time of the grid.
    pub fn blocked(&self) -> Blocked {
        let of_entry = |entry: &PathTimeEntry| {
            let entry = *entry;
            TIMES.iter().map(move |t| entry.occupied_at(*t))
        };
        Blocked::new(self.entries.iter().map(of_entry))
    }

    /// Whether an obstacle is in it.
    pub fn contains(&self, id: ObstacleId) -> bool {
        self.entries.iter().any(|entry| entry.id == id)
    }
}

impl Extent {
    fn pair(&self, t: f64) -> StPair {
        StPair::new(t, self.s.0, self.s.1)
    }
}

/// What obstacles are held against.
struct Survey<'a> {
    s: f64,
    line: &'a LineTable,
    lane_width: LaneWidth<'a>,
    project: Project<'a>,
}

impl Survey<'_> {
    /// The extent of a body at a pose. `near` is a station of it a moment ago, not-a-number if there is none.
    fn extent(&self, body: &Body, pose: Posed, near: &mut f64) -> Extent {
        *near = (self.project)(pose.position, *near).s;
        let mut extent = Extent {
            s: (f64::MAX, -f64::MAX),
            l: (f64::MAX, -f64::MAX),
        };
        for vertex in body.vertices {
            let at = (self.project)(pose.to_world(*vertex), *near);
            extent.s = (extent.s.0.min(at.s), extent.s.1.max(at.s));
            extent.l = (extent.l.0.min(at.l), extent.l.1.max(at.l));
        }
        extent
    }

    /// Whether something of this extent touches the lane ahead.
    fn touches(&self, extent: &Extent) -> bool {
        let (left, right) = self.widths(extent.s.0);
        let beside = extent.l.0 > left || extent.l.1 < -right;
        let beyond = extent.s.0 > self.s + RANGE || extent.s.1 < self.s;
        !beside && !beyond
    }

    fn widths(&self, s: f64) -> (f64, f64) {
        (self.lane_width)(s).unwrap_or((HALF_WIDTH, HALF_WIDTH))
    }

    fn moving(&self, obstacle: &Obstacle) -> Option<PathTimeEntry> {
        let body = Body::of(obstacle);
        let (mut near, mut place) = (f64::NAN, 0);
        let mut hint = self.line.nearest_place(obstacle.pose.position());
        // What is in the lane is measured when it comes and when it leaves; between that it only has to be there.
        let mut enters: Option<StPair> = None;
        let mut last = None;
        for t in &TIMES {
            let pose = Posed::from(pose_at(&obstacle.prediction, *t, &mut place)?);
            let touches = match self.at_a_glance(&body, pose, &mut hint) {
                Some(touches) => touches,
                None => self.touches(&self.extent(&body, pose, &mut near)),
            };
            if touches {
                if enters.is_none() {
                    enters = Some(self.extent(&body, pose, &mut near).pair(*t));
                }
                last = Some((*t, pose));
            } else if last.is_some() {
                break;
            }
        }
        let (t, pose) = last?;
        Some(PathTimeEntry {
            id: obstacle.id,
            enters: enters?,
            leaves: self.extent(&body, pose, &mut near).pair(t),
        })
    }

    /// Whether a body touches the lane ahead, if its two ends tell; most do.
    fn at_a_glance(&self, body: &Body, pose: Posed, hint: &mut usize) -> Option<bool> {
        let back = self.line.glance(pose.to_world(body.back), hint)?;
        let ahead = (self.s + ROUGHLY..=self.s + RANGE - ROUGHLY).contains(&back.s);
        let (left, right) = self.widths(back.s);
        if ahead && back.l < left - WIDENING && back.l > WIDENING - right {
            return Some(true);
        }
        let front = self.line.glance(pose.to_world(body.front), &mut hint.clone())?;
        let (low, high) = (back.l.min(front.l), back.l.max(front.l));
        let (left, right) = self.widths(back.s.min(front.s));
        let beside = low - body.beside > left + WIDENING || high + body.beside < -right - WIDENING;
        beside.then_some(false)
    }
}

/// An obstacle's outline in its own frame.
struct Body<'a> {
    vertices: &'a [Vec2],
    /// The middles of the vertices at its back and at its front.
    back: Vec2,
    front: Vec2,
    /// How far a vertex is at most from the nearer of these two, m. Nor is it nearer to the line by more.
    beside: f64,
}

impl<'a> Body<'a> {
    fn of(obstacle: &'a Obstacle) -> Self {
        let vertices = obstacle.shape.vertices();
        let middle_of = |half: &dyn Fn(&Vec2) -> bool| {
            let (sum, count) = vertices
                .iter()
                .filter(|vertex| half(vertex))
                .fold((Vec2::zeros(), 0.0), |(sum, count), vertex| {
                    (sum + vertex, count + 1.0)
                });
            sum / f64::max(count, 1.0)
        };
        let middle = middle_of(&|_| true);
        let (back, front) = (
            middle_of(&|vertex| vertex.x <= middle.x),
            middle_of(&|vertex| vertex.x >= middle.x),
        );
        let from_end = |vertex: &Vec2| (vertex - back).norm().min((vertex - front).norm());
        Self {
            vertices,
            back,
            front,
            beside: vertices.iter().map(from_end).fold(0.0, f64::max),
        }
    }
}

/// A pose with its direction, for many points of one body.
#[derive(Clone, Copy)]
struct Posed {
    position: Vec2,
    forward: Vec2,
}

impl From<Pose> for Posed {
    fn from(pose: Pose) -> Self {
        Self {
            position: pose.position(),
            forward: pose.forward(),
        }
    }
}

impl Posed {
    fn to_world(self, local: Vec2) -> Vec2 {
        let left = Vec2::new(-self.forward.y, self.forward.x);
        self.position + self.forward * local.x + left * local.y
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::ObstacleKind;
    use crate::geometry::ConvexPolygon;
    use crate::reference_line::testing;
    use proptest::prelude::*;

    proptest! {
        /// What a glance says, all corners say.
        #[test]
        fn a_glance_is_never_wrong(
            s in 5.0..240.0, l in -6.0..6.0, theta in -3.2..3.2, length in 0.3..12.0, width in 0.3..2.6, ego in 0.0..100.0,
        ) {
            let line = testing::s_curve();
            let at = line.to_cartesian(SlPoint { s, l });
            let obstacle = Obstacle {
                id: ObstacleId(0),
                kind: ObstacleKind::Car,
                pose: Pose::new(at.x, at.y, theta),
                shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), length / 2.0, length / 2.0, width / 2.0),
                velocity: Vec2::zeros(),
                is_static: false,
                prediction: Vec::new(),
            };
            let table = LineTable::sampled(&line, 0.0, 300.0).unwrap();
            let lane_width = |s| line.lane_width(s);
            let project = |point: Vec2, _: f64| line.to_frenet(point);
            let survey = Survey { s: ego, line: &table, lane_width: &lane_width, project: &project };
            let (body, pose) = (Body::of(&obstacle), Posed::from(obstacle.pose));
            let measured = survey.touches(&survey.extent(&body, pose, &mut { f64::NAN }));
            let glance = survey.at_a_glance(&body, pose, &mut table.nearest_place(at));
            prop_assert!(glance.is_none_or(|glance| glance == measured), "{glance:?} for {measured}");
        }
    }
}
