//! The records of a trace, in the order in which they are written.

use crate::verdict::Verdict;
use corridor_decider::decision::Decision;
use corridor_decider::frame::{EgoState, Frame, ObstacleId};
use corridor_decider::geometry::Vec2;
use corridor_decider::reference_line::ReferenceLine;
use corridor_decider::road::{BoundaryType, LaneKind};
use corridor_decider::vehicle::VehicleParams;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// One line of a trace.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Record {
    /// What was run; the first line.
    Header(Box<Header>),
    /// One planning tick.
    Tick(Box<TickRecord>),
    /// How the run ended; the last line, unless the run was killed.
    Verdict(Box<Verdict>),
}

/// What was run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Header {
    /// Version of this layout.
    pub format: u32,
    /// Version of the program.
    pub build: String,
    /// Name of the scenario.
    pub scenario: String,
    /// Text of the scenario file, so that the trace can be run again anywhere.
    pub source: String,
    /// Text of the map file.
    pub map: String,
    /// The seed that drew its numbers.
    pub seed: u64,
    /// Settings given on the command line, `key=value`.
    pub overrides: Vec<String>,
    /// The ego's body.
    pub vehicle: VehicleParams,
    /// Names of the obstacles, by [`ObstacleId`].
    pub obstacle_names: Vec<String>,
    /// Lines that the frames refer to by place. Those that come up on the way are in the tick that first needs them;
    /// who reads a trace has them all here.
    pub lines: Vec<Arc<ReferenceLine>>,
    /// The road, to draw.
    pub lanes: Vec<LaneOutline>,
    /// Planning period, s.
    pub tick: f64,
}

/// The outline of a lane.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct LaneOutline {
    /// Name in the map.
    pub name: String,
    /// What it is for.
    pub kind: LaneKind,
    /// Left edge, in driving direction.
    pub left: Vec<Vec2>,
    /// Right edge, in driving direction; as many points as on the left.
    pub right: Vec<Vec2>,
    /// Lines on the left edge: the place of the first point of each, and its kind.
    #[serde(default)]
    pub left_marks: Vec<(usize, BoundaryType)>,
    /// Lines on the right edge.
    #[serde(default)]
    pub right_marks: Vec<(usize, BoundaryType)>,
    /// Whether it leads through a junction.
    #[serde(default)]
    pub in_junction: bool,
}

/// One planning tick: what was seen, what was decided, what the car then did.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TickRecord {
    /// What the decider saw. Its lines are left out: see `lines`.
    pub frame: Frame,
    /// Places of the frame's lines in the header, and whether each is a change of lane.
    pub lines: Vec<(usize, bool)>,
    /// Lines that no tick before this one had.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub new_lines: Vec<Arc<ReferenceLine>>,
    /// What it decided.
    pub decision: Decision,
    /// What the tracker asked of the car in the last physics step of the tick.
    pub controls: Controls,
    /// The ego at the end of the tick.
    pub ego: EgoState,
    /// Hash over the whole state of the world at the end of the tick, hexadecimal.
    pub hash: String,
    /// Smallest distance to an obstacle during the tick, m, and to which.
    pub clearance: Option<(f64, ObstacleId)>,
    /// What happened.
    pub events: Vec<Event>,
}

/// Commands to the actuators.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Controls {
    /// Wanted road-wheel angle, rad, left positive.
    pub steer: f64,
    /// Wanted acceleration, m/s².
    pub acceleration: f64,
}

/// Something worth a line in the story of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// Seconds since the start of the run.
    pub time: f64,
    /// What it was.
    pub kind: EventKind,
    /// For people.
    pub text: String,
}

/// Classes of events.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EventKind {
    /// The chosen bound is another one.
    LabelChanged,
    /// The bodies of the ego and an obstacle overlap.
    Collision,
    /// The ego left the road.
    OffRoad,
    /// The decider fell back.
    Fallback,
    /// The place to pull over was chosen or changed.
    PullOverTarget,
    /// The ego stands where it should.
    Arrived,
    /// Anything else.
    Note,
}
