//! What one tick sees: everything the decider may know, and nothing of where it comes from.
//!
//! A frame can be written to a file and read back, so any tick of any trace can be decided again alone.

use crate::columns::Row;
use crate::geometry::{ConvexPolygon, Pose, Vec2};
use crate::reference_line::ReferenceLine;
use crate::road::Side;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Identity of an obstacle, the same from tick to tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ObstacleId(pub u32);

impl ObstacleId {
    /// Something without an identity: it is kept clear of, but cannot be named as the cause of anything.
    pub const ANONYMOUS: Self = Self(u32::MAX);
}

/// The inputs of one planning tick.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Number of the tick, from 0.
    pub tick: u32,
    /// Simulated time since the run's start, s.
    pub time: f64,
    /// The ego as localised.
    pub ego: EgoState,
    /// What the ego is asked to do.
    pub command: Command,
    /// Speed to drive where nothing limits it, m/s.
    pub cruise_speed: f64,
    /// Lines to plan along: first the one of the ego's lane, then at most one to change to.
    pub lines: Vec<FrameLine>,
    /// Everything in the way or near it, in a stable order.
    pub obstacles: Vec<Obstacle>,
}

/// A reference line offered to one tick.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrameLine {
    /// The line; shared between the ticks in which it is the same.
    pub line: Arc<ReferenceLine>,
    /// Whether driving along it means changing lanes.
    pub is_change_lane: bool,
}

/// Motion of the ego, at the centre of its rear axle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EgoState {
    /// Where the rear axle is and where the car points.
    pub pose: Pose,
    /// Speed along the heading, m/s.
    pub v: f64,
    /// Acceleration along the heading, m/s².
    pub a: f64,
    /// Yaw rate, rad/s.
    pub yaw_rate: f64,
    /// Road-wheel angle, rad, left positive.
    pub steer: f64,
}

/// What the ego is asked to do.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Command {
    /// Follow the lane, borrow another where needed.
    Cruise,
    /// Change to the neighbouring lane.
    ChangeLane(Side),
    /// Stop at the edge of the road at this place.
    PullOver(Vec2),
    /// Stop at the edge of the road as soon as possible.
    EmergencyPullOver,
}

/// Classes of obstacles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ObstacleKind {
    /// A passenger car.
    Car,
    /// A truck or a bus.
    Truck,
    /// Someone on a bicycle.
    Bicycle,
    /// Someone on foot.
    Pedestrian,
    /// A traffic cone.
    Cone,
    /// Anything else.
    Other,
}

impl ObstacleKind {
    /// Whether this is a vulnerable road user.
    pub fn is_vulnerable(self) -> bool {
        matches!(self, Self::Bicycle | Self::Pedestrian)
    }
}

/// An obstacle as perceived, with its prediction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Obstacle {
    /// Stable identity.
    pub id: ObstacleId,
    /// Its class.
    pub kind: ObstacleKind,
    /// Its centre and heading.
    pub pose: Pose,
    /// Its outline in its own frame (`x` forward).
    pub shape: ConvexPolygon,
    /// Velocity in world axes, m/s.
    pub velocity: Vec2,
    /// Whether it stands and is not expected to move.
    pub is_static: bool,
    /// Where it will probably be; empty for static ones.
    #[serde(with = "crate::columns")]
    pub prediction: Vec<PredictedPose>,
}

impl Obstacle {
    /// Its outline now, in world coordinates.
    pub fn footprint(&self) -> ConvexPolygon {
        self.shape.at(self.pose)
    }

    /// Its speed, m/s.
    pub fn speed(&self) -> f64 {
        self.velocity.norm()
    }
}

/// Where an obstacle is expected at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PredictedPose {
    /// Seconds from the frame's time.
    pub t: f64,
    /// Centre and heading then.
    pub pose: Pose,
}

impl Row for PredictedPose {
    const NAMES: &'static [&'static str] = &["t", "x", "y", "theta"];

    fn number(&self, column: usize) -> f64 {
        [self.t, self.pose.x, self.pose.y, self.pose.theta][column]
    }

    fn from_numbers(number: impl Fn(usize) -> f64) -> Self {
        Self {
            t: number(0),
            pose: Pose::new(number(1), number(2), number(3)),
        }
    }
}
