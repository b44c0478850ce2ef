//! What one tick decides, and why.

mod fallback;
mod points;

pub use fallback::{ContextFailure, Fallback, FallbackCause, PathRung, SpeedRung};
pub use points::{PathPoint, TrajectoryPoint};

use crate::frame::ObstacleId;
use crate::geometry::Vec2;
use crate::planner::TaskName;
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
    /// What failed and what is driven instead, if anything failed.
    pub fallback: Option<Fallback>,
    /// Where the car will stop at the road's edge, once that is decided.
    pub pull_over: Option<PullOverTarget>,
    /// What each task was given, what it found and why it failed, in the order in which they ran.
    pub tasks: Vec<TaskReport>,
}

impl Decision {
    /// A decision without bounds and path.
    pub(crate) fn without_path(
        outcome: Outcome,
        cause: FallbackCause,
        speed: Option<SpeedRung>,
        trajectory: Vec<TrajectoryPoint>,
    ) -> Self {
        Self {
            line: 0,
            candidates: Vec::new(),
            chosen: None,
            path: Vec::new(),
            trajectory,
            stop: None,
            outcome,
            fallback: Some(Fallback {
                cause,
                path: None,
                speed,
            }),
            pull_over: None,
            tasks: Vec::new(),
        }
    }
}

/// What one task had to say.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TaskReport {
    /// Which task.
    pub task: TaskName,
    /// What it was given.
    pub input: String,
    /// What it found.
    pub output: String,
    /// Why it failed, if it did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
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
    /// No curve that the car can follow stays inside the bound.
    Infeasible,
    /// The optimiser gave up.
    NotSolved,
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

impl Rejection {
    /// The obstacle that it is about, if it is.
    pub fn obstacle(self) -> Option<ObstacleId> {
        match self {
            Self::Touches(id) => Some(id),
            _ => None,
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
    /// A look at the lane of oncoming traffic before the car goes out into it.
    SidePass,
    /// The end of the lane from which lanes must be changed, while the other one is not free.
    LaneChangeUrgency,
    /// The place to pull over.
    PullOver,
    /// The end of the route.
    Destination,
    /// The end of the path.
    PathEnd,
}

/// How a tick ended (the original's trajectory type).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// A path and a speed found in this tick.
    Normal,
    /// The path of the tick before, with a speed found in this tick.
    PathReused,
    /// A path found in this tick, and a speed that only stops.
    SpeedFallback,
    /// A path from further down the chain of fallbacks, and a speed that only stops.
    PathFallback,
    /// The tick could not be planned at all: a stop along the trajectory of the tick before.
    BlindStop,
    /// The same for a car that stands: it stays where it is.
    Hold,
    /// Nothing to drive on: full braking, the wheels as they are.
    EmergencyStop,
}

impl Outcome {
    /// Whether this tick's own path and speed are driven.
    pub fn is_planned(self) -> bool {
        matches!(self, Self::Normal | Self::PathReused)
    }
}

/// Where and how the car will stand at the road's edge.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PullOverTarget {
    /// Place of the rear axle.
    pub position: Vec2,
    /// Heading of the car there.
    pub theta: f64,
}
