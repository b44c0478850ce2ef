//! What one call of the path-bounds decider reads, and what it remembers.

use super::bound::Borrow;
use super::config::PathBoundsConfig;
use crate::frame::ObstacleId;
use crate::geometry::{Pose, Vec2, angle};
use crate::reference_line::{LineQuery, SlPoint};
use crate::road::Side;
use crate::vehicle::VehicleParams;
use serde::{Deserialize, Serialize};

/// Everything about one tick except the reference line.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// The ego at the planning start point.
    pub ego: EgoFrenet,
    /// Station of the front bumper, m.
    pub ego_end_s: f64,
    /// Obstacles around the line, in a stable order.
    pub obstacles: &'a [ObstacleSl],
    /// Settings.
    pub config: &'a PathBoundsConfig,
    /// The ego's body.
    pub vehicle: &'a VehicleParams,
    /// Cruise speed, m/s; not positive: the configured default.
    pub cruise_speed: f64,
    /// Whether the line leads into another lane.
    pub is_change_lane: bool,
    /// Whether the last path will be driven again.
    pub path_reusable: bool,
    /// Sides on which a neighbouring lane may be borrowed, in order of preference.
    pub borrow: &'a [Borrow],
    /// The end of the route.
    pub destination: Option<Vec2>,
}

/// Motion of the ego in the Frenet frame of the line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EgoFrenet {
    /// Station, m.
    pub s: f64,
    /// Speed along the line, m/s.
    pub s_dot: f64,
    /// Lateral offset, m.
    pub l: f64,
    /// Lateral speed, m/s.
    pub l_dot: f64,
}

impl EgoFrenet {
    /// The Frenet state of a point that moves along its heading (the original's `ToFrenetFrame`).
    ///
    /// `s` is that of the projection; `l' = (1 − κ l) tan Δθ` and `ds/dt = v cos Δθ / (1 − κ l)`.
    pub fn at<L: LineQuery + ?Sized>(line: &L, pose: Pose, v: f64) -> Self {
        let SlPoint { s, l } = line.to_frenet(pose.position());
        let at = line.point(s);
        let (sin, cos) = angle::sin_cos(angle::difference(pose.theta, at.theta));
        let stretch = 1.0 - at.kappa * l;
        // l_dot = l' · s_dot: the stretch cancels.
        Self {
            s,
            s_dot: v * cos / stretch,
            l,
            l_dot: v * sin,
        }
    }
}

/// The box around an obstacle in the Frenet frame of the line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ObstacleSl {
    /// Which obstacle.
    pub id: ObstacleId,
    /// Nearest station, m.
    pub start_s: f64,
    /// Farthest station, m.
    pub end_s: f64,
    /// Right edge, m.
    pub start_l: f64,
    /// Left edge, m.
    pub end_l: f64,
    /// Speed, m/s.
    pub speed: f64,
    /// Whether it stands for good.
    pub is_static: bool,
    /// Whether it is a stop line or the like, not a body.
    pub is_virtual: bool,
    /// Whether earlier tasks decided to ignore it both along and across the line.
    pub is_ignored: bool,
}

/// What path bounds carry from tick to tick.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// The change of lane under way.
    pub change_lane: ChangeLane,
    /// The pull-over under way.
    pub pull_over: PullOver,
    /// On which side the last driven bound passed each obstacle: `Left` means that the car drove left of it.
    pub passed: Vec<(ObstacleId, Side)>,
}

/// State of a change of lane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ChangeLane {
    /// Whether the target lane is free now.
    pub is_clear: bool,
    /// Where the change may start.
    pub start: Option<Vec2>,
}

/// State of a pull-over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PullOver {
    /// Whether a pull-over path is wanted.
    pub is_requested: bool,
    /// Where to.
    pub kind: PullOverKind,
    /// The place, once chosen.
    pub place: Option<PullOverPlace>,
}

/// Where to pull over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PullOverKind {
    /// Near the destination.
    #[default]
    Destination,
    /// As soon as possible.
    Emergency,
}

/// A place to pull over: the rear axle's position and the room around it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PullOverPlace {
    /// Position of the rear axle.
    pub position: Vec2,
    /// Heading of the car.
    pub theta: f64,
    /// Room ahead, m.
    pub length_front: f64,
    /// Room behind, m.
    pub length_back: f64,
    /// Room to the left, m.
    pub width_left: f64,
    /// Room to the right, m.
    pub width_right: f64,
}
