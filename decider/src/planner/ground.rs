//! What a planner along one line starts from: where the car is on it, how fast it may drive and where it has to stop.
//!
//! Shared by the planners that need no path bounds. Frenet frame of the line, metres and seconds.

use crate::decision::{PathPoint, StopCause};
use crate::frame::{Command, Frame, ObstacleId};
use crate::geometry::frenet::{FrenetMotion, PlaneMotion};
use crate::lattice::{self, Curve, LineTable, PlanningTarget};
use crate::reference_line::{LineQuery, LineSample, ReferenceLine};
use crate::tasks::path_bounds::{Borrow, Label, LaneType};
use crate::tasks::start_point::StartPoint;
use crate::vehicle::VehicleParams;

/// A slower car stands, m/s: it no longer slows down, whatever was measured.
pub(super) const STANDS: f64 = 0.05;

/// Lateral acceleration that the cruise speed allows in bends, m/s²: half of what may be driven.
const BEND_ACCELERATION: f64 = 2.0;

/// Braking with which a lower limit ahead is reached, m/s².
const EASY_BRAKING: f64 = 1.5;

/// The way that is looked ahead for lower limits, m.
const LOOK_AHEAD: f64 = 100.0;

/// Speed limits are told as far as this, m: beyond it the last one counts.
const FARTHEST: u32 = 200;

/// Curvature below this limits no speed, 1/m.
const STRAIGHT: f64 = 1e-4;

/// The car stops this far before the end of its line, m: its last point is still on it.
const LINE_END: f64 = 0.1;

/// The line is known this far behind the car and beyond what it can reach, m.
const BEHIND: f64 = 10.0;
const BEYOND: f64 = 40.0;

/// The path is told at least as far as this, m: a car that stands has one, too.
const LEAST_PATH: f64 = 5.0;

/// Slower than this at its end a trajectory stops, m/s.
pub(super) const STOPPED: f64 = 0.2;

/// The own lane, as a bound would be labelled.
pub(super) const OWN_LANE: Label = Label::Regular {
    borrow: Borrow::None,
    lane: LaneType::Own,
};

/// What a plan along one line starts from.
pub(super) struct Ground {
    pub(super) initial: FrenetMotion,
    pub(super) target: PlanningTarget,
    pub(super) table: LineTable,
}

impl Ground {
    /// Along a line of a frame; `None` where the car's motion has no place on it.
    pub(super) fn of(
        frame: &Frame,
        place: usize,
        start: &StartPoint,
        vehicle: &VehicleParams,
    ) -> Option<Self> {
        let line = &*frame.lines[place].line;
        let initial = initial_state(line, start)?;
        let [s, v, _] = initial.s;
        let target = target(frame, line, s);
        let reach = (v.max(target.cruise_speed) + vehicle.max_acceleration) * lattice::HORIZON + BEYOND;
        Some(Self {
            initial,
            target,
            table: LineTable::sampled(line, s - BEHIND, s + reach)?,
        })
    }
}

/// How fast the car may drive along a line, and where it has to stop.
fn target(frame: &Frame, line: &ReferenceLine, s: f64) -> PlanningTarget {
    let end = line.length() - LINE_END;
    let cruise_speed = cruise_speed(line, s).min(frame.cruise_speed);
    let (cruise_speed, place) = match frame.command {
        Command::PullOver(place) => (cruise_speed, line.to_frenet(place).s),
        // Anywhere will do, so there is no place that could be missed.
        Command::EmergencyPullOver => (0.0, end),
        Command::Cruise | Command::ChangeLane(_) => (cruise_speed, end),
    };
    PlanningTarget {
        cruise_speed,
        stop_s: Some(place.min(end)),
    }
}

/// The motion along a line at its exact foot.
fn initial_state(line: &ReferenceLine, start: &StartPoint) -> Option<FrenetMotion> {
    let at = line.to_frenet(start.pose.position());
    let a = if start.v < STANDS {
        start.a.max(0.0)
    } else {
        start.a
    };
    lattice::foot_on(line, at.s).to_frenet(&PlaneMotion {
        pose: start.pose,
        kappa: start.kappa,
        v: start.v,
        a,
    })
}

/// The highest speed from which all limits ahead can be kept with easy braking, m/s.
fn cruise_speed(line: &ReferenceLine, s: f64) -> f64 {
    let samples = line.samples();
    let here = samples.partition_point(|sample| sample.s <= s).saturating_sub(1);
    let ahead = samples[here..]
        .iter()
        .take_while(|sample| sample.s <= s + LOOK_AHEAD);
    let reachable = |sample: &LineSample| {
        let bend = (BEND_ACCELERATION / sample.point.kappa.abs().max(STRAIGHT)).sqrt();
        let limit = sample.speed_limit.unwrap_or(f64::MAX).min(bend);
        (limit * limit + 2.0 * EASY_BRAKING * (sample.s - s).max(0.0)).sqrt()
    };
    ahead.map(reachable).fold(f64::MAX, f64::min)
}

/// The highest speed at stations from `from` on, m/s: metre by metre, since many are asked for.
pub(super) fn speed_limits(line: &ReferenceLine, from: f64) -> impl Fn(f64) -> f64 + use<> {
    let limits: Vec<f64> = (0..FARTHEST)
        .map(|k| cruise_speed(line, from + f64::from(k)))
        .collect();
    move |s| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "saturates"
        )]
        let metre = (s - from).max(0.0) as usize;
        limits[metre.min(limits.len() - 1)]
    }
}

/// Why a car stops behind an obstacle.
pub(super) fn stop_behind(frame: &Frame, id: ObstacleId) -> StopCause {
    let stands = |obstacle: &crate::frame::Obstacle| obstacle.id == id && obstacle.is_static;
    if frame.obstacles.iter().any(stands) {
        StopCause::Blocked(id)
    } else {
        StopCause::Follow(id)
    }
}

/// Why a car stops that nothing stops.
pub(super) fn end_of_drive(frame: &Frame) -> StopCause {
    if matches!(frame.command, Command::PullOver(_) | Command::EmergencyPullOver) {
        StopCause::PullOver
    } else {
        StopCause::Destination
    }
}

/// The way along a line up to where it ends, and a little further.
pub(super) fn path(line: &LineTable, lateral: &Curve, from: f64, to: f64) -> Vec<PathPoint> {
    lattice::path(line, lateral, from, to.max(from + LEAST_PATH) + 1.0)
}
