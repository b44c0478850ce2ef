//! Recognises drawn scenarios that nobody could pass, and expectations that the road does not bear out.
//!
//! The judge here is plain geometry and braking distance; the decider is never asked. What is rejected is
//! counted by its reason and drawn again. A scenario that can be survived only by swerving, at a distance too
//! short to brake, counts as impossible.

pub(crate) mod approach;
mod course;
mod footprint;
pub(crate) mod kerb;
pub(crate) mod passage;
mod start;

use crate::resolve::Draft;
use crate::route::Road;
use crate::schema::obstacle::LaneChoice;
pub(crate) use footprint::FrenetBox;

/// Why a drawn scenario is not run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Rejection {
    /// Two bodies are in each other at the start.
    #[error("`{first}` and `{second}` overlap at the start")]
    Overlap {
        /// One body.
        first: String,
        /// The other.
        second: String,
    },
    /// The ego does not stand on the road.
    #[error("the ego starts {distance:.2} m off the road")]
    EgoOffRoad {
        /// How far its farthest corner is outside, m.
        distance: f64,
    },
    /// Something lies beyond the route's ends or far beside the road.
    #[error("`{obstacle}` is off the map, at station {s:.1} m of the route")]
    OffMap {
        /// What.
        obstacle: String,
        /// Station on the route's line, m.
        s: f64,
    },
    /// Something is to be in a lane that is not there.
    #[error("`{obstacle}`: no lane `{lane:?}` at station {s:.1} m of the route")]
    NoLane {
        /// What.
        obstacle: String,
        /// The lane it asks for.
        lane: LaneChoice,
        /// Station on the route's line, m.
        s: f64,
    },
    /// What stands in the way is nearer than the car can stop.
    #[error("`{obstacle}` stands {gap:.1} m ahead; stopping takes {needed:.1} m")]
    TooNearToStop {
        /// What.
        obstacle: String,
        /// Clear distance to it, m.
        gap: f64,
        /// Distance that braking takes, m.
        needed: f64,
    },
    /// What moves into the way does so nearer than the car can brake.
    #[error("`{obstacle}` comes into the way {gap:.1} m ahead; braking takes {needed:.1} m")]
    TooNearToBrake {
        /// What.
        obstacle: String,
        /// Clear distance to it then, m.
        gap: f64,
        /// Distance that braking takes, m.
        needed: f64,
    },
    /// Something drives into the ego's side.
    #[error("`{obstacle}` runs into the ego's side after {time:.1} s")]
    HitFromTheSide {
        /// What.
        obstacle: String,
        /// When, s.
        time: f64,
    },
    /// Something that never brakes comes up behind.
    #[error("`{obstacle}` runs into the ego from behind")]
    HitFromBehind {
        /// What.
        obstacle: String,
    },
    /// The place to pull over is too near.
    #[error("the destination is {distance:.1} m ahead of the front bumper, less than {least:.1} m")]
    DestinationTooNear {
        /// Distance from the front bumper, m.
        distance: f64,
        /// The least one that is accepted, m.
        least: f64,
    },
    /// The place to pull over is beyond what is planned.
    #[error("the destination is {distance:.1} m ahead, more than {most:.1} m")]
    DestinationTooFar {
        /// Distance from the rear axle, m.
        distance: f64,
        /// The greatest one that is accepted, m.
        most: f64,
    },
    /// A pull-over is demanded and nothing is free.
    #[error("the longest gap at the road's edge is {longest:.1} m; pulling over takes {needed:.1} m")]
    NoKerbGap {
        /// Longest free stretch, m.
        longest: f64,
        /// What is needed, m.
        needed: f64,
    },
    /// A refusal is expected and there is no reason for one.
    #[error("a refusal is expected, but {longest:.1} m are free at the road's edge")]
    NoReasonToRefuse {
        /// Longest free stretch, m.
        longest: f64,
    },
    /// Progress is expected and what stands closes the road.
    #[error("the widest way past what stands is {widest:.2} m; the car is {needed:.2} m wide")]
    NoWayThrough {
        /// Width of the way, m.
        widest: f64,
        /// Width of the car, m.
        needed: f64,
    },
    /// A standstill is expected and the way is free.
    #[error("a standstill is expected, but the way past what stands is {widest:.2} m wide")]
    NoReasonToStand {
        /// Width of the way, m.
        widest: f64,
    },
    /// A lane change is demanded and there is no lane.
    #[error("there is no lane to change to beside the ego's")]
    NoTargetLane,
    /// The goal lies beyond the route.
    #[error("the goal is {distance:.1} m ahead, and the route ends after {available:.1} m")]
    GoalBeyondRoute {
        /// Distance of the goal, m.
        distance: f64,
        /// Length of the route from the start, m.
        available: f64,
    },
}

impl Rejection {
    /// The kind of reason, for counting.
    pub fn reason(&self) -> &'static str {
        match self {
            Self::Overlap { .. } => "overlap",
            Self::EgoOffRoad { .. } => "ego_off_road",
            Self::OffMap { .. } => "off_map",
            Self::NoLane { .. } => "no_lane",
            Self::TooNearToStop { .. } => "too_near_to_stop",
            Self::TooNearToBrake { .. } => "too_near_to_brake",
            Self::HitFromTheSide { .. } => "hit_from_the_side",
            Self::HitFromBehind { .. } => "hit_from_behind",
            Self::DestinationTooNear { .. } => "destination_too_near",
            Self::DestinationTooFar { .. } => "destination_too_far",
            Self::NoKerbGap { .. } => "no_kerb_gap",
            Self::NoReasonToRefuse { .. } => "no_reason_to_refuse",
            Self::NoWayThrough { .. } => "no_way_through",
            Self::NoReasonToStand { .. } => "no_reason_to_stand",
            Self::NoTargetLane => "no_target_lane",
            Self::GoalBeyondRoute { .. } => "goal_beyond_route",
        }
    }
}

/// What the judges look at: a draft with the ground that everything covers at the start.
#[derive(Debug)]
pub(crate) struct Scene<'a> {
    pub(crate) draft: &'a Draft<'a>,
    pub(crate) road: &'a Road,
    /// Ground of each obstacle in the frame of the route's line.
    pub(crate) boxes: Vec<FrenetBox>,
}

impl<'a> Scene<'a> {
    pub(crate) fn new(draft: &'a Draft<'a>, road: &'a Road) -> Self {
        let boxes = draft
            .obstacles
            .iter()
            .zip(&draft.spots)
            .map(|(obstacle, spot)| FrenetBox::of(&road.line, &obstacle.shape.at(spot.pose(road)), spot.s))
            .collect();
        Self { draft, road, boxes }
    }

    /// Station of the ego's front bumper at the start, m.
    pub(crate) fn front(&self) -> f64 {
        self.draft.ego_s + self.draft.vehicle.front_edge_to_center
    }

    /// Station of its rear bumper, m.
    pub(crate) fn rear(&self) -> f64 {
        self.draft.ego_s - self.draft.vehicle.back_edge_to_center
    }

    /// Ground of the obstacles that stand for the whole run.
    pub(crate) fn standing(&self) -> impl Iterator<Item = FrenetBox> + '_ {
        let obstacles = self.draft.obstacles.iter().zip(&self.boxes);
        obstacles
            .filter(|(obstacle, _)| matches!(obstacle.behaviour, crate::scenario::Behaviour::Parked(_)))
            .map(|(_, ground)| *ground)
    }
}

/// Whether the ego can come through the first seconds at all.
///
/// # Errors
/// The first [`Rejection`] that applies.
pub(crate) fn check(scene: &Scene<'_>) -> Result<(), Rejection> {
    start::check(scene)?;
    approach::check(scene)
}
