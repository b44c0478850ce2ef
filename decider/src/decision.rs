//! What one tick decides, and why.

use crate::columns::Row;
use crate::frame::ObstacleId;
use crate::geometry::{Pose, Vec2};
use crate::tasks::path_bounds::PathBound;
use serde::{Deserialize, Serialize};

/// The answer to one frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decision {
    /// Place in the frame's lines of the line planned along.
    pub line: usize,
    /// All bounds that were decided, in the original's order: the fallback first.
    pub candidates: Vec<Candidate>,
    /// Place in `candidates` of the one that is driven; `None` when none can be.
    pub chosen: Option<usize>,
    /// The path inside the chosen bound.
    #[serde(with = "crate::columns")]
    pub path: Vec<PathPoint>,
    /// The path with times: what the tracker follows.
    #[serde(with = "crate::columns")]
    pub trajectory: Vec<TrajectoryPoint>,
    /// Why the car does not simply cruise on, if it does not.
    pub stop: Option<Stop>,
    /// How the tick ended.
    pub outcome: Outcome,
    /// Where the car will stop at the road's edge, once that is decided.
    pub pull_over: Option<PullOverTarget>,
}

/// One bound with the verdict on its paths.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Candidate {
    /// The bound.
    pub bound: PathBound,
    /// What became of it.
    pub assessment: Assessment,
}

/// What became of a candidate bound.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Assessment {
    /// Its path is driven.
    Chosen,
    /// It has a drivable path; another was preferred.
    Drivable {
        /// How far that path leads, m along the line.
        #[serde(with = "crate::columns::number")]
        reach: f64,
    },
    /// No sampled path stays inside it, below the curvature limit and clear of obstacles.
    NoPath(Rejection),
    /// Oncoming traffic leaves no time to use it.
    Occupied(ObstacleId),
    /// Not looked at: an earlier one was good.
    NotTried,
}

/// Why the best sampled path of a bound was turned down.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rejection {
    /// It leaves the bound.
    LeavesBound,
    /// A corner of the body leaves the road.
    LeavesRoad,
    /// It bends more than the steering can.
    Curvature,
    /// The body would touch this obstacle.
    Touches(ObstacleId),
    /// The bound is too short to drive.
    TooShort,
}

/// A point of a path, at the rear axle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// Arc length along the path from its first point, m.
    pub distance: f64,
    /// Station on the reference line.
    pub s: f64,
    /// Lateral offset from the reference line.
    pub l: f64,
    /// World pose.
    pub pose: Pose,
    /// Curvature of the path, 1/m.
    pub kappa: f64,
}

impl Row for PathPoint {
    const NAMES: &'static [&'static str] = &["distance", "s", "l", "x", "y", "theta", "kappa"];

    fn number(&self, column: usize) -> f64 {
        let p = self.pose;
        [self.distance, self.s, self.l, p.x, p.y, p.theta, self.kappa][column]
    }

    fn from_numbers(number: impl Fn(usize) -> f64) -> Self {
        Self {
            distance: number(0),
            s: number(1),
            l: number(2),
            pose: Pose::new(number(3), number(4), number(5)),
            kappa: number(6),
        }
    }
}

/// A point of the trajectory, at the rear axle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrajectoryPoint {
    /// Seconds from the frame's time.
    pub t: f64,
    /// Arc length along the path, m.
    pub distance: f64,
    /// World pose.
    pub pose: Pose,
    /// Curvature, 1/m.
    pub kappa: f64,
    /// Speed, m/s.
    pub v: f64,
    /// Acceleration, m/s².
    pub a: f64,
}

impl Row for TrajectoryPoint {
    const NAMES: &'static [&'static str] = &["t", "distance", "x", "y", "theta", "kappa", "v", "a"];

    fn number(&self, column: usize) -> f64 {
        let p = self.pose;
        [
            self.t,
            self.distance,
            p.x,
            p.y,
            p.theta,
            self.kappa,
            self.v,
            self.a,
        ][column]
    }

    fn from_numbers(number: impl Fn(usize) -> f64) -> Self {
        Self {
            t: number(0),
            distance: number(1),
            pose: Pose::new(number(2), number(3), number(4)),
            kappa: number(5),
            v: number(6),
            a: number(7),
        }
    }
}

/// Why the car slows down or stands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stop {
    /// Arc length along the path at which the rear axle stops or stays behind, m.
    #[serde(with = "crate::columns::number")]
    pub distance: f64,
    /// What for.
    pub cause: StopCause,
}

/// What the car stops, follows or yields for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StopCause {
    /// A static obstacle that closes the corridor.
    Blocked(ObstacleId),
    /// A moving obstacle ahead on the path.
    Follow(ObstacleId),
    /// A moving obstacle that crosses or comes towards us.
    Yield(ObstacleId),
    /// The place to pull over.
    PullOver,
    /// The end of the route.
    Destination,
    /// The end of the path.
    PathEnd,
}

/// How a tick ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// A path inside a wanted bound.
    Normal,
    /// No wanted bound was drivable: a path inside the fallback bound.
    PathFallback,
    /// No path at all: the last one, braking.
    LastPath,
    /// Nothing to drive on: full braking straight ahead.
    EmergencyStop,
}

/// Where and how the car will stand at the road's edge.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PullOverTarget {
    /// Place of the rear axle.
    pub position: Vec2,
    /// Heading of the car there.
    pub theta: f64,
}
