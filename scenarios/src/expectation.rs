//! How a drawn scenario should end, from what the file says and what the road bears out.
//!
//! A file may leave the end to geometry (`progress_by_gap`, `pulled_over_by_gap`): then a way or a gap that is wide
//! enough for any careful driver must be used, one that is narrower than the car must not, and between the two
//! both ends are right; so they are where something is seen so late that braking for it may end too near to steer around
//! it. An end that the file names outright is checked against the same geometry, so that a
//! sweep never counts the impossible as a failure.

use crate::scenario::Expectation;
use crate::schema::task::{Expect, Task};
use crate::validity::approach;
use crate::validity::kerb::{self, KerbGap};
use crate::validity::passage::Passage;
use crate::validity::{Rejection, Scene};
use corridor_decider::reference_line::LineQuery;

/// Share of what cruising reaches in the time that is expected where the file names no distance: the rest is for
/// speeding up, slowing down and waiting.
const PROGRESS_SHARE: f64 = 0.6;

/// Length of route that must be left beyond a goal, m, so that the end of the road does not slow the ego down.
pub(crate) const BEYOND_GOAL: f64 = 30.0;

/// Least distance from the front bumper to the place to pull over, m: the original's
/// `pull_over_destination_to_adc_buffer`.
const LEAST_AHEAD: f64 = 25.0;

/// What must be planned beyond the place to pull over, m: the original's `pull_over_destination_to_pathend_buffer`.
const BEYOND_DESTINATION: f64 = 4.0;

/// The end to expect.
///
/// # Errors
/// [`Rejection`] where the road does not bear out what the file says.
pub(crate) fn expectation(
    scene: &Scene<'_>,
    task: &Task,
    expect: &Expect,
    distance: Option<f64>,
) -> Result<Expectation, Rejection> {
    match expect {
        Expect::Progress(_) => progress(scene, distance, false),
        Expect::ProgressByGap(_) => progress(scene, distance, true),
        Expect::PulledOver => pulled_over(scene, false),
        Expect::PulledOverByGap => pulled_over(scene, true),
        Expect::Refusal => refusal(scene, task),
        Expect::Standstill => standstill(scene),
        Expect::LaneChanged if scene.road.target_line.is_none() => Err(Rejection::NoTargetLane),
        Expect::LaneChanged => Ok(Expectation::LaneChanged),
    }
}

/// The end that a task is for, where the file names none.
pub(crate) fn usual(task: &Task) -> Expect {
    match task {
        Task::Cruise => Expect::Progress(None),
        Task::ChangeLane(_) => Expect::LaneChanged,
        Task::PullOver(_) | Task::EmergencyPullOver => Expect::PulledOver,
    }
}

fn progress(scene: &Scene<'_>, distance: Option<f64>, by_gap: bool) -> Result<Expectation, Rejection> {
    let draft = scene.draft;
    let available = scene.road.line.length() - draft.ego_s - BEYOND_GOAL;
    let distance = match distance {
        Some(distance) if distance > available => {
            return Err(Rejection::GoalBeyondRoute { distance, available });
        }
        Some(distance) => distance,
        None => (PROGRESS_SHARE * draft.cruise_speed * draft.timeout)
            .min(available)
            .max(0.0),
    };
    let passage = Passage::measure(scene, distance);
    let width = draft.vehicle.width;
    match (passage.is_closed(width), by_gap) {
        (true, true) => Ok(Expectation::Standstill),
        (true, false) => Err(Rejection::NoWayThrough {
            widest: passage.strict,
            needed: width,
        }),
        (false, true) if !passage.is_open(width) || approach::may_stop_too_near(scene) => {
            Ok(Expectation::ProgressOrStandstill(distance))
        }
        (false, _) => Ok(Expectation::Progress(distance)),
    }
}

fn standstill(scene: &Scene<'_>) -> Result<Expectation, Rejection> {
    let widest = Passage::measure(scene, scene.road.line.length()).strict;
    if widest < scene.draft.vehicle.width {
        return Ok(Expectation::Standstill);
    }
    Err(Rejection::NoReasonToStand { widest })
}

fn pulled_over(scene: &Scene<'_>, by_gap: bool) -> Result<Expectation, Rejection> {
    destination_in_reach(scene)?;
    let gap = KerbGap::measure(scene);
    if gap.roomy >= gap.ample {
        return Ok(Expectation::PulledOver);
    }
    if !by_gap {
        return Err(Rejection::NoKerbGap {
            longest: gap.roomy,
            needed: gap.ample,
        });
    }
    Ok(if gap.strict < gap.least {
        Expectation::Refusal
    } else {
        Expectation::PulledOverOrRefusal
    })
}

/// How far the ego gets, at most, until `time`, m.
fn travelled(scene: &Scene<'_>, time: f64) -> f64 {
    scene.draft.ego.speed.max(scene.draft.cruise_speed) * time
}

/// Whether the destination is one that the original accepts, when the command comes.
fn destination_in_reach(scene: &Scene<'_>) -> Result<(), Rejection> {
    let draft = scene.draft;
    let Some(destination) = draft.destination else {
        return Ok(());
    };
    let distance = destination - scene.front() - travelled(scene, draft.command_time);
    if distance < LEAST_AHEAD {
        return Err(Rejection::DestinationTooNear {
            distance,
            least: LEAST_AHEAD,
        });
    }
    let (distance, most) = (destination - draft.ego_s, kerb::HORIZON - BEYOND_DESTINATION);
    if distance >= most {
        return Err(Rejection::DestinationTooFar { distance, most });
    }
    Ok(())
}

/// A refusal is right where the destination is too near when the command comes, or too far until the run ends,
/// or where no stretch at the road's edge is as long as the car. A lane change is refused where there is no lane.
fn refusal(scene: &Scene<'_>, task: &Task) -> Result<Expectation, Rejection> {
    let draft = scene.draft;
    let no_reason = |longest| Err(Rejection::NoReasonToRefuse { longest });
    match task {
        Task::Cruise => return no_reason(f64::MAX),
        Task::ChangeLane(_) => return Ok(Expectation::Refusal),
        Task::PullOver(_) | Task::EmergencyPullOver => {}
    }
    if let Some(destination) = draft.destination {
        let near = destination - scene.front() - draft.ego.speed.min(draft.cruise_speed) * draft.command_time;
        let far = destination - draft.ego_s - travelled(scene, draft.timeout);
        if near < LEAST_AHEAD || far >= kerb::HORIZON - BEYOND_DESTINATION {
            return Ok(Expectation::Refusal);
        }
    }
    let gap = KerbGap::measure(scene);
    if gap.strict < gap.least {
        return Ok(Expectation::Refusal);
    }
    no_reason(gap.strict)
}
