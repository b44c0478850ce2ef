//! `LANE_CHANGE_DECIDER`: whether the target lane is free, and which line is planned along.
//!
//! The gaps are the original's (`IsClearToChangeLane`): by relative speed, with a hysteresis per obstacle.

use super::scene::Scene;
use crate::context::Context;
use crate::frame::{Frame, ObstacleId};
use crate::planner::{LinePlan, TaskError};
use crate::reference_line::LineQuery;

/// Least gap ahead and behind among traffic of our direction, m.
const SAME_DIRECTION_GAP: f64 = 10.0;

/// Further gap per difference of speeds, s.
const SAME_DIRECTION_TIME: f64 = 3.0;

/// Least gap ahead to oncoming traffic, m, and per sum of speeds, s; and behind it, m.
const ONCOMING: (f64, f64, f64) = (50.0, 5.0, 1.0);

/// Half the width of the hysteresis on a gap, m.
const HYSTERESIS: f64 = 0.5;

/// How many ticks the target lane must have been clear: a gap that is there for one tick is none.
const CLEAR_CYCLES: u32 = 4;

/// Once the car overlaps the target lane by this much it does not turn back, m.
const COMMITTED: f64 = 0.3;

/// What the decider remembers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LaneChangeState {
    /// Obstacles that blocked the change in the last tick.
    pub blocking: Vec<ObstacleId>,
    /// Ticks in a row without one.
    pub clear_cycles: u32,
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
    if scene.is_change_lane {
        let is_clear = is_clear(scene, &mut context.lane_change);
        context.bounds.change_lane.is_clear = is_clear;
        return if is_clear { Ok(()) } else { Err(TaskError::LaneChangeNotClear) };
    }
    if target_line(scene.frame).is_some() {
        // Who keeps the speed of the traffic beside him never meets another gap.
        scene.cruise_speed *= scene.config.speed.gap_seeking_share;
    }
    Ok(())
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

fn blocks(scene: &Scene, moving: &super::scene::Moving, blocked_before: bool) -> bool {
    let now = moving.boxes[0];
    let Some((left, right)) = scene.line.lane_width(now.at.s.clamp(0.0, scene.line.length())) else {
        return false;
    };
    if now.at.l + now.half_width < -right || now.at.l - now.half_width > left {
        return false;
    }
    let v = scene.frame.ego.v;
    let (ahead, behind) = if now.s_dot >= 0.0 {
        let gap = |closing: f64| SAME_DIRECTION_GAP.max(SAME_DIRECTION_TIME * closing);
        (gap(v - now.s_dot), gap(now.s_dot - v))
    } else {
        (ONCOMING.0.max(ONCOMING.1 * (v - now.s_dot)), ONCOMING.2)
    };
    let margin = if blocked_before { HYSTERESIS } else { -HYSTERESIS };
    let ego_start_s = scene.ego.s - scene.vehicle.back_edge_to_center;
    let to_rear = ego_start_s - (now.at.s + now.half_length);
    let to_front = (now.at.s - now.half_length) - scene.ego_end_s();
    to_rear < behind + margin && to_front < ahead + margin
}
