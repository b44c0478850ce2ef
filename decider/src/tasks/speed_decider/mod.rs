//! `SPEED_DECIDER`: on which side of each obstacle a speed profile passes, as a decision about the obstacle.
//!
//! `s` of the profile and of the boundaries is metres along the path, `t` seconds from the planning start; fences are
//! stations on the reference line. Against the original: a pedestrian before whom one need not stop, because something
//! nearer is stopped for, is ignored rather than left undecided; fences are placed where the front bumper is when the
//! rear axle is at the boundary's place on the path, which the original only guesses by adding path lengths to stations.
//! As there, a profile through an obstacle is an error, and the stop before it stays decided.

mod gaps;
mod location;
mod pedestrian;
mod task;
#[cfg(test)]
mod tests;

pub use gaps::{following_gap, overtaking_gap, yielding_gap};
pub use location::{Location, location};
pub use pedestrian::PedestrianTimers;
pub use task::run;

use super::object_decision::{Fence, Longitudinal, ObjectDecision};
use crate::frame::ObstacleId;
use crate::geometry::{Vec2, angle};
use crate::st_graph::{BoundaryType, SpeedData, StBoundary};

/// Distance to what one stops for, m (the original's `min_stop_distance_obstacle`).
const STOP_DISTANCE: f64 = 6.0;

/// Whoever is farther beside the line than this is not followed, m (`follow_min_obs_lateral_distance`).
const FOLLOW_LATERAL: f64 = 2.5;

/// Whoever is on the path for less than this is not followed, s (`follow_min_time_sec`).
const FOLLOW_DURATION: f64 = 2.0;

/// Whoever enters the path later than this is not followed, s.
const FOLLOW_ENTRY: f64 = 0.5;

/// Whoever has left the path by this time is not followed, s.
const FOLLOW_EXIT: f64 = 1e-3;

/// Braking by which a leader is too close, m/s².
const TOO_CLOSE_BRAKING: f64 = 3.0;

/// An obstacle to decide about.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts")]
pub struct Object<'a> {
    /// Which.
    pub id: ObstacleId,
    /// What it occupies of the path, if anything.
    pub boundary: Option<&'a StBoundary>,
    /// Whether it is a fence or a zone, not a body.
    pub is_virtual: bool,
    /// Whether it is someone on foot.
    pub is_pedestrian: bool,
    /// Whether it blocks the path: all do that are on it but zones to keep clear.
    pub is_blocking: bool,
    /// Whether its middle is on the lane of the line.
    pub is_on_lane: bool,
    /// Speed, m/s.
    pub speed: f64,
    /// Velocity in world axes, m/s.
    pub velocity: Vec2,
    /// First and last station on the line, m.
    pub station: (f64, f64),
    /// Right and left edge beside the line, m.
    pub offset: (f64, f64),
    /// What has been decided so far, and then what is decided here.
    pub decision: ObjectDecision,
    /// Why, if something was decided along the path here.
    pub reason: Option<Reason>,
}

/// What led to a decision along the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The side on which the profile passes.
    Profile,
    /// The profile passes before it.
    Overtake,
    /// It is someone on foot.
    Pedestrian,
    /// A zone in which one would have to stand.
    KeepClear,
    /// A leader who is too close to follow.
    TooClose,
    /// The profile goes through it.
    Cross,
}

/// What a decision depends on beside the obstacles.
#[derive(Clone, Copy)]
pub struct Question<'a> {
    /// The profile.
    pub profile: &'a SpeedData,
    /// Speed at the planning start, m/s.
    pub init_v: f64,
    /// Heading there, rad.
    pub init_theta: f64,
    /// Station of the ego's rear bumper, m.
    pub ego_start_s: f64,
    /// Length of the ego, m.
    pub ego_length: f64,
    /// Station of the nearest stop decided so far, m; infinite without one.
    pub main_stop_s: f64,
    /// Time of the tick, s.
    pub now: f64,
    /// Station of the front bumper with the rear axle at a distance along the path.
    pub front_station: &'a dyn Fn(f64) -> f64,
}

/// Why a profile is not usable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SpeedDeciderError {
    /// Fewer than two points.
    #[error("the speed profile has fewer than two points")]
    NoProfile,
    /// It goes through an obstacle; those behind it in the list are undecided.
    #[error("the speed profile goes through obstacle {}", .0.0)]
    Crossing(ObstacleId),
}

/// Decides about all objects, in their order.
///
/// # Errors
///
/// When the profile is no profile or goes through an obstacle. What was decided until then stays.
pub fn decide(
    question: &Question,
    objects: &mut [Object],
    timers: &mut PedestrianTimers,
) -> Result<(), SpeedDeciderError> {
    let [.., last] = question.profile.points[..] else {
        return Err(SpeedDeciderError::NoProfile);
    };
    if question.profile.points.len() < 2 {
        return Err(SpeedDeciderError::NoProfile);
    }
    for k in 0..objects.len() {
        let object = objects[k];
        let on_path = object.boundary.filter(|boundary| {
            boundary.max_s() >= 0.0 && boundary.max_t() >= 0.0 && boundary.min_t() < last.t
        });
        let outcome = match on_path {
            Some(_) if object.decision.longitudinal.is_some() => Ok(None),
            Some(_) if object.is_virtual && !object.is_on_lane => continue,
            Some(boundary) => question.about(&object, boundary, objects, timers),
            None => Ok(None),
        };
        let (decided, result) = match outcome {
            Ok(decided) => (decided, Ok(())),
            Err(stop) => (stop, Err(SpeedDeciderError::Crossing(object.id))),
        };
        let object = &mut objects[k];
        if let Some((decision, reason)) = decided {
            object.decision.add_longitudinal(decision);
            object.reason = Some(reason);
        }
        result?;
        // Someone on foot who is stopped for may still be nudged.
        if object.reason != Some(Reason::Pedestrian) {
            object.ignore_the_rest();
        }
    }
    Ok(())
}

/// A decision with its reason; none where a nearer stop makes it needless.
type Decided = Option<(Longitudinal, Reason)>;

impl Object<'_> {
    fn ignore_the_rest(&mut self) {
        if self.decision.longitudinal.is_none() {
            self.reason = Some(Reason::Profile);
        }
        self.decision.ignore_the_rest();
    }
}

impl Question<'_> {
    /// The decision about one object on the path; as an error, the stop before one that the profile goes through.
    fn about(
        &self,
        object: &Object,
        boundary: &StBoundary,
        all: &[Object],
        timers: &mut PedestrianTimers,
    ) -> Result<Decided, Decided> {
        if timers.must_stop(self, object, boundary) {
            return Ok(self.stop(object, boundary, -STOP_DISTANCE, Reason::Pedestrian));
        }
        let is_zone = boundary.kind == BoundaryType::KeepClear;
        let place = if is_zone && self.has_queue_behind(object, all) {
            Location::Below
        } else {
            location(self.profile, boundary)
        };
        match place {
            Location::Below => Ok(self.stay_behind(object, boundary)),
            Location::Above if is_zone => Ok(Some((Longitudinal::Ignore, Reason::Profile))),
            Location::Above => Ok(self.overtake(object, boundary)),
            Location::Cross if object.is_blocking => {
                Err(self.stop(object, boundary, -STOP_DISTANCE, Reason::Cross))
            }
            Location::Cross => Ok(None),
        }
    }

    fn stay_behind(&self, object: &Object, boundary: &StBoundary) -> Decided {
        if boundary.kind == BoundaryType::KeepClear {
            return self.stop(object, boundary, 0.0, Reason::KeepClear);
        }
        if !is_leader(object, boundary) {
            let distance = (-boundary.min_s()).max(-yielding_gap());
            let fence = self.fence(boundary, distance)?;
            return Some((Longitudinal::Yield(fence), Reason::Profile));
        }
        if self.is_too_close(object, boundary) {
            return self.stop(object, boundary, -STOP_DISTANCE, Reason::TooClose);
        }
        let fence = self.fence(boundary, -following_gap(self.init_v))?;
        Some((Longitudinal::Follow(fence), Reason::Profile))
    }

    fn overtake(&self, object: &Object, boundary: &StBoundary) -> Decided {
        let (sin, cos) = angle::sin_cos(self.init_theta);
        let along = object.velocity.x * cos + object.velocity.y * sin;
        let fence = self.fence(boundary, overtaking_gap(along, self.init_v))?;
        Some((Longitudinal::Overtake(fence), Reason::Overtake))
    }

    fn stop(&self, object: &Object, boundary: &StBoundary, distance: f64, reason: Reason) -> Decided {
        let fence = match boundary.kind {
            BoundaryType::KeepClear => self.not_past_main_stop(Fence {
                distance,
                s: object.station.0,
            }),
            _ => self.fence(boundary, distance),
        };
        fence.map(|fence| (Longitudinal::Stop(fence), reason))
    }

    /// The fence at a distance from where the bumper would meet a boundary.
    fn fence(&self, boundary: &StBoundary, distance: f64) -> Option<Fence> {
        self.not_past_main_stop(Fence {
            distance,
            s: (self.front_station)(boundary.min_s()) + distance,
        })
    }

    /// A fence behind the nearest stop decides nothing.
    fn not_past_main_stop(&self, fence: Fence) -> Option<Fence> {
        (self.main_stop_s >= fence.s).then_some(fence)
    }

    /// Whether something stands so shortly behind a zone that one would have to stand in it.
    fn has_queue_behind(&self, zone: &Object, all: &[Object]) -> bool {
        all.iter().any(|object| {
            let gap = object.station.0 - zone.station.1;
            object.id != zone.id && object.is_blocking && gap > 0.0 && gap < self.ego_length / 2.0
        })
    }

    /// Whether braking for a slower leader could not wait.
    fn is_too_close(&self, object: &Object, boundary: &StBoundary) -> bool {
        let closing = self.init_v - object.speed;
        object.is_blocking
            && boundary.min_t() <= 0.0
            && closing >= 0.0
            && boundary.min_s() - STOP_DISTANCE < closing * closing * 0.5 / TOO_CLOSE_BRAKING
    }
}

/// Whether an object drives ahead on the path for a while, rather than crossing it or coming towards the ego.
fn is_leader(object: &Object, boundary: &StBoundary) -> bool {
    object.offset.0.abs().min(object.offset.1.abs()) <= FOLLOW_LATERAL
        && boundary.first().lower <= boundary.last().lower
        && boundary.min_t() <= FOLLOW_ENTRY
        && boundary.max_t() >= FOLLOW_EXIT
        && boundary.max_t() - boundary.min_t() >= FOLLOW_DURATION
}
