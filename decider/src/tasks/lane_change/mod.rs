//! `LANE_CHANGE_DECIDER`: whether the target lane is free, and which line is planned along.
//!
//! The gaps are the original's (`IsClearToChangeLane`): by relative speed, with a hysteresis per obstacle.

pub mod clear;
pub mod perception;
pub mod state;

pub use state::StateConfig as LaneChangeConfig;

use super::scene::{Moving, Scene};
use crate::context::Context;
use crate::frame::{Frame, FrameLine, ObstacleId};
use crate::planner::{LinePlan, TaskError};
use crate::reference_line::LineQuery;
use clear::{Changer, Neighbour};
use state::{Line, Phase, Status};
use std::f64::consts::PI;

/// How many ticks the target lane must have been clear: a gap that is there for one tick is none.
const CLEAR_CYCLES: u32 = 4;

/// Once the car overlaps the target lane by this much it does not turn back, m.
const COMMITTED: f64 = 0.3;

/// Difference of speeds that brings another gap beside the car in time, m/s.
const SEEKING_DIFFERENCE: f64 = 2.0;

/// What the decider remembers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LaneChangeState {
    /// Obstacles that blocked the change in the last tick.
    pub blocking: Vec<ObstacleId>,
    /// Ticks in a row without one.
    pub clear_cycles: u32,
    /// How far a change has come; lines have no names that last, so there is none to tell.
    pub status: Option<Status<()>>,
}

/// Place of the line to change to, if the frame offers one.
pub fn target_line(frame: &Frame) -> Option<usize> {
    frame.lines.iter().position(|line| line.is_change_lane)
}

/// Lets a plan along the target line go on only while that is free.
///
/// # Errors
/// [`TaskError::LaneChangeNotClear`] where it is not.
pub fn run(plan: &mut LinePlan, context: &mut Context) -> Result<(), TaskError> {
    let scene = &mut plan.scene;
    let may_change = advance(scene, &mut context.lane_change);
    if scene.is_change_lane {
        let is_clear = is_clear(scene, &mut context.lane_change);
        context.bounds.change_lane.is_clear = is_clear;
        // Who is over the line already neither waits nor turns back.
        return if is_clear && (may_change || is_committed(scene)) {
            Ok(())
        } else {
            Err(TaskError::LaneChangeNotClear)
        };
    }
    if target_line(scene.frame).is_some() {
        scene.cruise_speed = gap_seeking_speed(scene, &context.lane_change.blocking);
    }
    Ok(())
}

/// Who keeps the speed of the traffic beside him never meets another gap: a share of the own speed, and clearly less
/// than that of anyone in the way who drives about as fast.
fn gap_seeking_speed(scene: &Scene, blocking: &[ObstacleId]) -> f64 {
    let share = scene.cruise_speed * scene.config.speed.gap_seeking_share;
    let of_blockers = scene
        .moving
        .iter()
        .filter(|moving| blocking.contains(&moving.id))
        .map(|moving| moving.boxes[0].s_dot);
    of_blockers
        .filter(|v| (v - share).abs() < SEEKING_DIFFERENCE)
        .map(|v| v - SEEKING_DIFFERENCE)
        .fold(share, f64::min)
        .max(0.0)
}

/// Takes the state on by one tick; whether a change is under way. Only the first line of a tick does that.
fn advance(scene: &Scene, state: &mut LaneChangeState) -> bool {
    let is_first = scene.is_change_lane || scene.frame.lines.len() == 1;
    if is_first {
        let line = |line: &FrameLine| Line {
            id: (),
            is_change_lane: line.is_change_lane,
        };
        let lines: Vec<Line<()>> = scene.frame.lines.iter().map(line).collect();
        // Without a line of its own the ego follows the one there is.
        let _ = state::advance(
            &scene.config.lane_change,
            &mut state.status,
            &lines,
            scene.frame.time,
        );
    }
    state
        .status
        .as_ref()
        .is_some_and(|status| status.phase == Phase::Changing)
}

/// Takes note that a change that was under way could not be planned: the next attempt has to wait.
pub fn give_up(state: &mut LaneChangeState, now: f64) {
    if let Some(status) = state
        .status
        .as_mut()
        .filter(|status| status.phase == Phase::Changing)
    {
        status.phase = Phase::Failed;
        status.since = now;
    }
}

/// Whether the change along this scene's line may be driven now.
pub fn is_clear(scene: &Scene, state: &mut LaneChangeState) -> bool {
    let before = std::mem::take(&mut state.blocking);
    for moving in &scene.moving {
        if blocks(scene, moving, before.contains(&moving.id)) {
            state.blocking.push(moving.id);
        }
    }
    state.clear_cycles = if state.blocking.is_empty() {
        state.clear_cycles + 1
    } else {
        0
    };
    state.clear_cycles >= CLEAR_CYCLES || is_committed(scene)
}

/// Whether the car is already too far over the line to turn back.
fn is_committed(scene: &Scene) -> bool {
    let Some((left, right)) = scene.line.lane_width(scene.ego.s) else {
        return false;
    };
    let half_width = scene.vehicle.half_width();
    let overlap = (left - (scene.ego.l - half_width)).min(scene.ego.l + half_width + right);
    overlap > COMMITTED
}

fn blocks(scene: &Scene, moving: &Moving, blocked_before: bool) -> bool {
    let now = moving.boxes[0];
    let along = scene.line.point(now.at.s).theta;
    let neighbour = Neighbour {
        station: (now.at.s - now.half_length, now.at.s + now.half_length),
        offset: (now.at.l - now.half_width, now.at.l + now.half_width),
        is_moving: true,
        speed: now.s_dot.abs(),
        heading: Some(if now.s_dot < 0.0 { along + PI } else { along }),
        is_blocking: blocked_before,
    };
    let ego = Changer {
        station: (scene.ego.s - scene.vehicle.back_edge_to_center, scene.ego_end_s()),
        speed: scene.frame.ego.v,
        heading: along,
        is_reversing: false,
    };
    let lane = scene.line.lane_width(now.at.s.clamp(0.0, scene.line.length()));
    lane.is_some_and(|width| !neighbour.is_beside(width)) && neighbour.blocks(&ego)
}
