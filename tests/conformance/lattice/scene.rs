//! The worlds of the cases: lines by rows, obstacles with their predictions, entries of the path-time graph.

use corridor_decider::frame::{Obstacle, ObstacleId, ObstacleKind, PredictedPose};
use corridor_decider::geometry::frenet::{Foot, FrenetMotion};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2};
use corridor_decider::lattice::{LineTable, PathTimeEntry, PlanningTarget, PredictedMotion};
use corridor_decider::st_graph::StPair;
use serde::Deserialize;

/// A line from rows of `s`, then what the columns hold; all else is 0.
pub(super) fn line<const N: usize>(
    rows: &[[f64; N]],
    foot: fn(&[f64; N]) -> Foot,
) -> Result<LineTable, String> {
    LineTable::polyline(rows.iter().map(foot).collect()).ok_or_else(|| "a line without a length".to_owned())
}

/// Rows of `s`, `x`, `y`, `theta`, `kappa`, `dkappa`.
pub(super) fn full([s, x, y, theta, kappa, dkappa]: &[f64; 6]) -> Foot {
    Foot {
        s: *s,
        pose: Pose::new(*x, *y, *theta),
        kappa: *kappa,
        dkappa: *dkappa,
    }
}

/// Rows of `s`, `theta`.
pub(super) fn directions([s, theta]: &[f64; 2]) -> Foot {
    full(&[*s, *s, 0.0, *theta, 0.0, 0.0])
}

/// Rows of `s`, `kappa`.
pub(super) fn bends([s, kappa]: &[f64; 2]) -> Foot {
    full(&[*s, *s, 0.0, 0.0, *kappa, 0.0])
}

/// Rows of `s`, `theta`, `kappa`.
pub(super) fn directions_and_bends([s, theta, kappa]: &[f64; 3]) -> Foot {
    full(&[*s, *s, 0.0, *theta, *kappa, 0.0])
}

/// Where a plan starts.
#[derive(Deserialize)]
pub(super) struct Start {
    pub(super) init_s: [f64; 3],
    #[serde(default)]
    pub(super) init_d: [f64; 3],
}

impl Start {
    pub(super) fn motion(&self) -> FrenetMotion {
        FrenetMotion {
            s: self.init_s,
            l: self.init_d,
        }
    }
}

/// What a plan is for.
#[derive(Clone, Copy, Deserialize)]
pub(super) struct Target {
    pub(super) cruise_speed: f64,
    pub(super) stop_point: Option<f64>,
}

impl Target {
    pub(super) fn planning(self) -> PlanningTarget {
        PlanningTarget {
            cruise_speed: self.cruise_speed,
            stop_s: self.stop_point,
        }
    }
}

/// A box with its prediction.
#[derive(Deserialize)]
pub(super) struct Body {
    pub(super) id: String,
    x: f64,
    y: f64,
    theta: f64,
    length: f64,
    width: f64,
    /// Rows of `t`, `x`, `y`, `theta`, `v`.
    trajectory: Vec<[f64; 5]>,
}

impl Body {
    /// As a frame holds it; its number is its place.
    pub(super) fn obstacle(&self, place: usize) -> Obstacle {
        let shape = ConvexPolygon::rectangle(
            Pose::new(0.0, 0.0, 0.0),
            self.length / 2.0,
            self.length / 2.0,
            self.width / 2.0,
        );
        let predicted = |[t, x, y, theta, _]: &[f64; 5]| PredictedPose {
            t: *t,
            pose: Pose::new(*x, *y, *theta),
        };
        Obstacle {
            id: id(place),
            kind: ObstacleKind::Car,
            pose: Pose::new(self.x, self.y, self.theta),
            shape,
            velocity: Vec2::zeros(),
            is_static: self.trajectory.is_empty(),
            prediction: self.trajectory.iter().map(predicted).collect(),
        }
    }
}

/// The number of the obstacle at a place of a list.
pub(super) fn id(place: usize) -> ObstacleId {
    ObstacleId(u32::try_from(place).expect("few obstacles"))
}

/// An obstacle of which only the predicted motion matters.
#[derive(Deserialize)]
pub(super) struct Mover {
    pub(super) id: String,
    #[serde(alias = "trajectory")]
    trajectory_t_v_theta: Vec<[f64; 3]>,
}

/// The motion of the mover of a name.
pub(super) fn motions(movers: &[Mover], name: &str) -> Vec<PredictedMotion> {
    let motion = |[t, v, theta]: &[f64; 3]| PredictedMotion {
        t: *t,
        v: *v,
        theta: *theta,
    };
    let mover = movers.iter().find(|mover| mover.id == name);
    mover
        .map(|mover| mover.trajectory_t_v_theta.iter().map(motion).collect())
        .unwrap_or_default()
}

/// An entry of the path-time graph by its corners `(t, s)`.
#[derive(Clone, Deserialize)]
pub(super) struct Entry {
    pub(super) id: String,
    pub(super) bottom_left: (f64, f64),
    pub(super) bottom_right: (f64, f64),
    pub(super) upper_left: (f64, f64),
    pub(super) upper_right: (f64, f64),
}

impl Entry {
    pub(super) fn entry(&self, place: usize) -> PathTimeEntry {
        PathTimeEntry {
            id: id(place),
            enters: StPair::new(self.bottom_left.0, self.bottom_left.1, self.upper_left.1),
            leaves: StPair::new(self.bottom_right.0, self.bottom_right.1, self.upper_right.1),
        }
    }
}
