//! Words for what a decision holds: causes, assessments, commands, outcomes. For the terminal and the page.

use crate::trace::{EventKind, Trace};
use corridor_decider::decision::{
    Assessment, ContextFailure, Fallback, FallbackCause, Outcome, PathRung, Rejection, SpeedRung, Stop,
    StopCause,
};
use corridor_decider::frame::Command;
use corridor_decider::lattice::{self, Violation};
use corridor_decider::road::Side;
use corridor_decider::tasks::path_bounds::{BoundPoint, EdgeCause, PathBound};

/// Where a limit comes from.
pub(crate) fn cause(trace: &Trace, cause: EdgeCause) -> String {
    match cause {
        EdgeCause::Unbounded => "nothing".to_owned(),
        EdgeCause::LaneLine => "lane line".to_owned(),
        EdgeCause::BorrowedLane => "far line of the borrowed lane".to_owned(),
        EdgeCause::RoadEdge => "road edge".to_owned(),
        EdgeCause::Ego => "ego's own extent".to_owned(),
        EdgeCause::Obstacle(id) => format!("obstacle `{}`", trace.obstacle(id)),
        EdgeCause::LaneChangeZone => "lane-change zone".to_owned(),
        EdgeCause::PullOverTarget => "pull-over target".to_owned(),
    }
}

/// What became of a candidate.
pub(crate) fn assessment(trace: &Trace, assessment: Assessment) -> String {
    match assessment {
        Assessment::Chosen => "chosen".to_owned(),
        Assessment::Drivable { reach } => format!("drivable for {reach:.1} m, another was preferred"),
        Assessment::NoPath(Rejection::Infeasible) => {
            "no path: no curve that the car can follow stays inside".to_owned()
        }
        Assessment::NoPath(Rejection::NotSolved) => "no path: the optimiser gave up".to_owned(),
        Assessment::NoPath(Rejection::LeavesBound) => "no path: it leaves the bound".to_owned(),
        Assessment::NoPath(Rejection::LeavesRoad) => "no path: the body leaves the road".to_owned(),
        Assessment::NoPath(Rejection::Curvature) => "no path: it bends more than the steering can".to_owned(),
        Assessment::NoPath(Rejection::Touches(id)) => {
            format!("no path: it touches `{}`", trace.obstacle(id))
        }
        Assessment::NoPath(Rejection::TooShort) => "no path: too short to drive".to_owned(),
        Assessment::Occupied(id) => format!("occupied by `{}`", trace.obstacle(id)),
        Assessment::NotTried => "not tried".to_owned(),
    }
}

/// Why the car does not simply drive on, and where it comes to rest.
pub(crate) fn stop(trace: &Trace, stop: Stop) -> String {
    format!("in {:.1} m: {}", stop.distance, stop_cause(trace, stop.cause))
}

/// What the car stops, follows or yields for.
pub(crate) fn stop_cause(trace: &Trace, cause: StopCause) -> String {
    match cause {
        StopCause::Blocked(id) => format!("blocked by `{}`", trace.obstacle(id)),
        StopCause::Follow(id) => format!("follows `{}`", trace.obstacle(id)),
        StopCause::Yield(id) => format!("yields to `{}`", trace.obstacle(id)),
        StopCause::SidePass => "a look into the lane of oncoming traffic".to_owned(),
        StopCause::LaneChangeUrgency => "the other lane is not free and this one ends".to_owned(),
        StopCause::PullOver => "place to pull over".to_owned(),
        StopCause::Destination => "end of the route".to_owned(),
        StopCause::PathEnd => "end of the path".to_owned(),
    }
}

/// What the ego is asked to do.
pub(crate) fn command(command: Command) -> String {
    match command {
        Command::Cruise => "cruise".to_owned(),
        Command::ChangeLane(Side::Left) => "change lane to the left".to_owned(),
        Command::ChangeLane(Side::Right) => "change lane to the right".to_owned(),
        Command::PullOver(at) => format!("pull over at ({:.1}, {:.1})", at.x, at.y),
        Command::EmergencyPullOver => "pull over as soon as possible".to_owned(),
    }
}

/// How a tick ended.
pub(crate) fn outcome(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Normal => "normal: a path and a speed of this tick",
        Outcome::PathReused => "path reused: the way of the tick before, a speed of this tick",
        Outcome::SpeedFallback => "speed fallback: a path of this tick, a speed that only stops",
        Outcome::PathFallback => "path fallback: a path from elsewhere, a speed that only stops",
        Outcome::BlindStop => "blind stop: along the trajectory of the tick before",
        Outcome::Hold => "hold: stays where it is",
        Outcome::EmergencyStop => "emergency stop: full braking, the wheels as they are",
    }
}

/// What failed and what is driven instead.
pub(crate) fn fallback(trace: &Trace, fallback: Fallback) -> String {
    let cause = fallback_cause(trace, fallback.cause);
    let path = fallback.path.map(|rung| format!("path: {}", path_rung(rung)));
    let speed = fallback.speed.map(|rung| format!("speed: {}", speed_rung(rung)));
    let parts = [Some(cause), path, speed];
    parts.into_iter().flatten().collect::<Vec<String>>().join("; ")
}

/// What failed.
pub(crate) fn fallback_cause(trace: &Trace, cause: FallbackCause) -> String {
    match cause {
        FallbackCause::Task(task) => format!("the task `{task}` failed"),
        FallbackCause::Trajectory(unfit) => format!("the trajectory is not fit to be driven: {unfit}"),
        FallbackCause::NoSampledTrajectory => "no sampled trajectory may be driven".to_owned(),
        FallbackCause::Context(ContextFailure::NoLocalisation) => "the ego's place is not known".to_owned(),
        FallbackCause::Context(ContextFailure::NoReferenceLine) => "there is no reference line".to_owned(),
        FallbackCause::Context(ContextFailure::Overlap(id)) => {
            format!("the ego stands inside `{}`", trace.obstacle(id))
        }
    }
}

/// Where the path of a fallback comes from.
pub(crate) fn path_rung(rung: PathRung) -> &'static str {
    match rung {
        PathRung::LastPath => "of the tick before",
        PathRung::SelfLane => "in the own lane",
        PathRung::OffsetLine => "beside the reference line",
        PathRung::HeldArc => "on as the wheels are set",
    }
}

/// Where the speed of a fallback comes from.
pub(crate) fn speed_rung(rung: SpeedRung) -> &'static str {
    match rung {
        SpeedRung::Optimised => "optimised stop",
        SpeedRung::EmergencyJerk => "optimised stop with emergency jerk",
        SpeedRung::Ramp => "braking ramp",
        SpeedRung::ConstantDeceleration => "constant braking",
        SpeedRung::LatticeBackup => "the gentlest constant braking that touches nothing",
        SpeedRung::LatticeLastResort => "the hardest braking, though it is not free",
    }
}

/// Why a pair of curves may not be driven (lattice planner).
pub(crate) fn rejection(trace: &Trace, rejection: lattice::Rejection) -> String {
    match rejection {
        lattice::Rejection::LeavesLine => "leaves the line".to_owned(),
        lattice::Rejection::Violates(violation) => match violation {
            Violation::Speed => "too fast, or backwards",
            Violation::Acceleration => "speeds up or brakes too hard",
            Violation::Curvature => "bends more than the steering can",
            Violation::Jerk => "too much jerk",
            Violation::LateralAcceleration => "too fast for its bend",
        }
        .to_owned(),
        lattice::Rejection::Touches(id) => format!("touches `{}`", trace.obstacle(id)),
    }
}

/// Class of an event.
pub(crate) fn event(kind: EventKind) -> &'static str {
    match kind {
        EventKind::LabelChanged => "label",
        EventKind::Collision => "collision",
        EventKind::OffRoad => "off road",
        EventKind::Fallback => "fallback",
        EventKind::PullOverTarget => "pull over",
        EventKind::Arrived => "arrived",
        EventKind::Note => "note",
    }
}

/// The station at which a bound is narrowest, padding aside; the first of equals.
pub(crate) fn narrowest(bound: &PathBound) -> Option<&BoundPoint> {
    let count = bound.points.len() - bound.padding.min(bound.points.len());
    let width = |p: &BoundPoint| p.l_max - p.l_min;
    bound.points[..count]
        .iter()
        .min_by(|a, b| width(a).total_cmp(&width(b)))
}
