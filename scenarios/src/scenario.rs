//! One concrete scenario: every number drawn, every name resolved, ready to run.

use crate::goal::GoalRegion;
use corridor_decider::frame::{Command, ObstacleId, ObstacleKind};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2};
use corridor_decider::reference_line::{LineProvider, ReferenceLine};
use corridor_decider::road::{LaneId, RoadMap};
use corridor_decider::vehicle::VehicleParams;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A situation to drive: where, who, what for, and how it should end.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// Name of the family.
    pub name: String,
    /// One sentence for people.
    pub description: String,
    /// The seed that drew the numbers.
    pub seed: u64,
    /// The road.
    pub map: Arc<RoadMap>,
    /// Lanes to follow, each a successor of the one before.
    pub route: Vec<LaneId>,
    /// Follows the router's answer, where there is a destination: the decider's lines then come from it, tick by tick.
    pub provider: Option<LineProvider>,
    /// The line along the route.
    pub line: Arc<ReferenceLine>,
    /// The line along the lanes to change to, for a lane-change command.
    pub target_line: Option<Arc<ReferenceLine>>,
    /// Where and how the ego starts.
    pub ego: EgoStart,
    /// What the ego is asked to do.
    pub command: Command,
    /// When the command is given, s; before that the ego cruises.
    pub command_time: f64,
    /// Speed to drive where nothing limits it, m/s.
    pub cruise_speed: f64,
    /// Everything else on the road.
    pub obstacles: Vec<Obstacle>,
    /// The ego's body.
    pub vehicle: VehicleParams,
    /// How long the run may take, s.
    pub timeout: f64,
    /// How it should end.
    pub expect: Expectation,
}

/// Where and how the ego starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EgoStart {
    /// Pose of the rear axle.
    pub pose: Pose,
    /// Speed along the heading, m/s.
    pub speed: f64,
}

/// One obstacle of a scenario.
#[derive(Clone, Debug)]
pub struct Obstacle {
    /// Identity in frames and traces: its place in the scenario's list.
    pub id: ObstacleId,
    /// Its name in the file.
    pub name: String,
    /// Its class.
    pub kind: ObstacleKind,
    /// Its outline in its own frame (`x` forward), around its centre.
    pub shape: ConvexPolygon,
    /// How it moves.
    pub behaviour: Behaviour,
}

impl Obstacle {
    /// Where it is at the start of the run, if it is somewhere then and a pose is named for it.
    pub(crate) fn start(&self) -> Option<Pose> {
        match &self.behaviour {
            Behaviour::Parked(pose) => Some(*pose),
            Behaviour::Recorded { states, .. } => {
                let first = states.iter().take_while(|state| state.t <= 0.0).last();
                first.map(|state| state.pose)
            }
            _ => None,
        }
    }
}

/// How an obstacle moves.
#[derive(Clone, Debug)]
pub enum Behaviour {
    /// Stands for the whole run.
    Parked(Pose),
    /// Drives along a line at constant speed and lateral offset.
    ConstantSpeed(AlongLine),
    /// Passes through poses at given times, on straight legs; stands before the first and after the last.
    Waypoints(Vec<Waypoint>),
    /// Passes through poses at given times after something sets it off; until then it stands at the first.
    Triggered {
        /// What its time begins with.
        trigger: Trigger,
        /// Where it is at times from then on.
        waypoints: Vec<Waypoint>,
    },
    /// Follows a line by the Intelligent Driver Model, behind whatever is ahead on it, the ego included.
    Idm {
        /// Where it starts.
        start: AlongLine,
        /// Its parameters.
        params: IdmParams,
        /// A lateral move it makes on the way.
        lane_change: Option<LateralMove>,
        /// How it chooses among lanes, if it does.
        mobil: Option<Mobil>,
    },
    /// Crosses on foot along a straight line.
    Pedestrian {
        /// Where it waits.
        from: Vec2,
        /// Where it goes.
        to: Vec2,
        /// Walking speed, m/s.
        speed: f64,
        /// When it starts.
        trigger: Trigger,
    },
    /// Moves as recorded, whatever happens around it. Before its first state it is not in the scene.
    Recorded {
        /// Its states by strictly ascending time; at least one.
        states: Arc<[RecordedState]>,
        /// What becomes of it after the last one.
        after: AfterRecord,
    },
}

/// A state of motion at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordedState {
    /// Seconds from the start of the run; negative for what was before.
    pub t: f64,
    /// Place and heading.
    pub pose: Pose,
    /// Speed along the heading, m/s; negative when it backs up.
    pub speed: f64,
}

/// What becomes of an obstacle when its record ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AfterRecord {
    /// It is taken out of the scene: nothing is known of it any more. What CommonRoad's own tools do.
    Leaves,
    /// It stands at its last place.
    Holds,
}

/// A place and a speed on a line.
#[derive(Clone, Debug)]
pub struct AlongLine {
    /// The line, in the obstacle's driving direction.
    pub line: Arc<ReferenceLine>,
    /// Station of its centre at the start, m.
    pub s: f64,
    /// Lateral offset of its centre, m, left of its driving direction positive.
    pub l: f64,
    /// Speed at the start, m/s.
    pub speed: f64,
}

/// A smooth lateral move: a cut-in or a lane change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LateralMove {
    /// What starts it.
    pub trigger: Trigger,
    /// Offset at its end, m.
    pub to_l: f64,
    /// How long it takes, s.
    pub duration: f64,
}

/// A pose to be in at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// Seconds from the start of the run.
    pub t: f64,
    /// Centre and heading then.
    pub pose: Pose,
}

/// What sets an obstacle moving.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trigger {
    /// A time since the start of the run, s.
    Time(f64),
    /// The ego's reference point comes this near, m.
    EgoWithin(f64),
}

/// Parameters of the Intelligent Driver Model (Treiber, Hennecke, Helbing 2000).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct IdmParams {
    /// Speed on a free road, m/s.
    pub desired_speed: f64,
    /// Time gap to the leader, s.
    pub time_gap: f64,
    /// Bumper-to-bumper gap at standstill, m.
    pub min_gap: f64,
    /// Acceleration on a free road, m/s².
    pub max_acceleration: f64,
    /// Comfortable braking, m/s², positive.
    pub comfortable_braking: f64,
}

impl Default for IdmParams {
    fn default() -> Self {
        Self {
            desired_speed: 13.9,
            time_gap: 1.5,
            min_gap: 2.0,
            max_acceleration: 1.4,
            comfortable_braking: 2.0,
        }
    }
}

/// Parameters of the lane-change model MOBIL (Kesting, Treiber, Helbing 2007), with the lanes to choose among.
#[derive(Clone, Debug, PartialEq)]
pub struct Mobil {
    /// Offsets of the lanes' centres from the line that is driven along, m.
    pub lanes: Vec<f64>,
    /// How much the acceleration of the others counts, compared with one's own.
    pub politeness: f64,
    /// Gain in acceleration from which on a change is worth its while, m/s².
    pub threshold: f64,
    /// Hardest braking that may be asked of the new follower, m/s², positive.
    pub safe_braking: f64,
    /// How long a change takes, s.
    pub duration: f64,
}

impl Default for Mobil {
    fn default() -> Self {
        Self {
            lanes: Vec::new(),
            politeness: 0.2,
            threshold: 0.1,
            safe_braking: 4.0,
            duration: 4.0,
        }
    }
}

/// How a run should end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Expectation {
    /// Reach the goal: this far along the route from the start, m.
    Progress(f64),
    /// Stand at the road's edge.
    PulledOver,
    /// Be in the target lane.
    LaneChanged,
    /// Refuse the command for lack of a place or a gap, and come to no harm.
    Refusal,
    /// Stand behind something that cannot be passed.
    Standstill,
    /// Reach the goal this far from the start, m, or stand: the way is wide enough for the car, but not for all
    /// clearances.
    ProgressOrStandstill(f64),
    /// Stand at the road's edge or refuse: the gap is long enough for the car, but not for all clearances.
    PulledOverOrRefusal,
    /// Meet a goal given by place, time, heading and speed.
    Goal(GoalRegion),
}

impl Expectation {
    /// How far to get, if getting there is a right end, m.
    pub fn goal(&self) -> Option<f64> {
        match self {
            Self::Progress(distance) | Self::ProgressOrStandstill(distance) => Some(*distance),
            _ => None,
        }
    }

    /// The region to get to, if getting there is the right end.
    pub fn goal_region(&self) -> Option<&GoalRegion> {
        match self {
            Self::Goal(region) => Some(region),
            _ => None,
        }
    }

    /// Whether standing behind a blocker is a right end.
    pub fn allows_standstill(&self) -> bool {
        matches!(self, Self::Standstill | Self::ProgressOrStandstill(_))
    }

    /// Whether standing at the road's edge is a right end.
    pub fn allows_pull_over(&self) -> bool {
        matches!(self, Self::PulledOver | Self::PulledOverOrRefusal)
    }

    /// Whether refusing the command is a right end.
    pub fn allows_refusal(&self) -> bool {
        matches!(self, Self::Refusal | Self::PulledOverOrRefusal)
    }
}
