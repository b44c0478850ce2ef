//! The path-time graph: when which part of the line is occupied by what touches the lane.
//!
//! An obstacle is a quadrilateral in the `(t, s)` plane, from where it is when it comes into the lane to where it is when
//! it leaves it. In the original the corners were lost and the graph was always empty.

use super::grid::{HORIZON, SAMPLES, TIMES};
use super::lateral_bounds::StaticBox;
use super::prediction::pose_at;
use crate::frame::{Obstacle, ObstacleId};
use crate::geometry::{Pose, Vec2};
use crate::reference_line::SlPoint;
use crate::st_graph::{StPair, StPoint};

/// How far ahead obstacles matter, m (`speed_lon_decision_horizon`).
const RANGE: f64 = 200.0;

/// Half the width of a lane that the map does not tell, m (half `default_reference_line_width`).
const HALF_WIDTH: f64 = 2.0;

/// Time between two points beside an entry, s (`time_min_density`).
const DENSITY: f64 = 1.0;

/// Times nearer than this are one, s.
const SAME_TIME: f64 = 1e-6;

/// Half-widths of the lane (left, right) at a station, m; `None` where it is not known.
pub type LaneWidth<'a> = &'a dyn Fn(f64) -> Option<(f64, f64)>;

/// Frenet coordinates of a point near a station.
pub type Project<'a> = &'a dyn Fn(Vec2, f64) -> SlPoint;

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
    pub fn new(obstacles: &[Obstacle], s: f64, lane_width: LaneWidth, project: Project) -> Self {
        let survey = Survey {
            s,
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
        let Some(extent) = survey.extent(obstacle, obstacle.pose, radius(obstacle), &mut None) else {
            return;
        };
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
    pub fn blocked(&self) -> Vec<Vec<(f64, f64)>> {
        TIMES.iter().map(|t| self.blocked_at(*t).collect()).collect()
    }

    /// Whether an obstacle is in it.
    pub fn contains(&self, id: ObstacleId) -> bool {
        self.entries.iter().any(|entry| entry.id == id)
    }
}

/// What obstacles are held against.
struct Survey<'a> {
    s: f64,
    lane_width: LaneWidth<'a>,
    project: Project<'a>,
}

impl Survey<'_> {
    /// The extent of a body at a pose, if it touches the lane ahead. `near` is the station of its middle a moment ago.
    fn extent(&self, obstacle: &Obstacle, pose: Pose, radius: f64, near: &mut Option<f64>) -> Option<Extent> {
        let middle = (self.project)(pose.position(), near.unwrap_or(f64::NAN));
        *near = Some(middle.s);
        // No corner is farther from the middle than the radius, so none is nearer to the line by more.
        let (left, right) = (self.lane_width)(middle.s).unwrap_or((HALF_WIDTH, HALF_WIDTH));
        if middle.l.abs() - radius > 2.0 * left.max(right) {
            return None;
        }
        let mut extent = Extent {
            s: (f64::MAX, -f64::MAX),
            l: (f64::MAX, -f64::MAX),
        };
        for vertex in obstacle.shape.vertices() {
            let at = (self.project)(pose.to_world(*vertex), middle.s);
            extent.s = (extent.s.0.min(at.s), extent.s.1.max(at.s));
            extent.l = (extent.l.0.min(at.l), extent.l.1.max(at.l));
        }
        let (left, right) = (self.lane_width)(extent.s.0).unwrap_or((HALF_WIDTH, HALF_WIDTH));
        let beside = extent.l.0 > left || extent.l.1 < -right;
        let beyond = extent.s.0 > self.s + RANGE || extent.s.1 < self.s;
        (!beside && !beyond).then_some(extent)
    }

    fn moving(&self, obstacle: &Obstacle) -> Option<PathTimeEntry> {
        let radius = radius(obstacle);
        let (mut near, mut place) = (None, 0);
        let mut entry: Option<PathTimeEntry> = None;
        for t in &TIMES[..SAMPLES] {
            let pose = pose_at(&obstacle.prediction, *t, &mut place)?;
            match (self.extent(obstacle, pose, radius, &mut near), &mut entry) {
                (Some(extent), known) => {
                    let pair = StPair::new(*t, extent.s.0, extent.s.1);
                    let enters = known.map_or(pair, |known| known.enters);
                    entry = Some(PathTimeEntry {
                        id: obstacle.id,
                        enters,
                        leaves: pair,
                    });
                }
                (None, Some(_)) => break,
                (None, None) => {}
            }
        }
        entry
    }
}

/// Radius of a circle around the middle of an obstacle, m.
fn radius(obstacle: &Obstacle) -> f64 {
    let corners = obstacle.shape.vertices().iter();
    corners.map(nalgebra::Matrix::norm).fold(0.0, f64::max)
}
