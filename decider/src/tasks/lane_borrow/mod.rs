//! `PATH_LANE_BORROW_DECIDER`: when a neighbouring lane may be used to pass something that blocks our own.
//!
//! Slow enough, blocked for long enough, and the line may be crossed; then until the own lane has been usable
//! for a while. Whether traffic leaves time for it is asked when a path is chosen.

mod conditions;

use super::path_bounds::{Borrow, ObstacleSl};
use super::scene::Scene;
use crate::context::Context;
use crate::frame::ObstacleId;
use crate::planner::{LinePlan, TaskError};
use crate::reference_line::LineQuery;
use crate::road::BoundaryType;
use serde::{Deserialize, Serialize};

/// Settings of the lane-borrow decider.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LaneBorrowConfig {
    /// Whether lanes are borrowed at all.
    pub allow_lane_borrowing: bool,
    /// Not faster than this, m/s.
    pub lane_borrow_max_speed: f64,
    /// Not faster than this where nobody else moves, m/s: there is no gap in the traffic to judge, and who slows
    /// down first only takes longer.
    pub lane_borrow_max_speed_alone: f64,
    /// How many ticks the own lane must have been blocked.
    pub long_term_blocking_obstacle_cycle_threshold: u32,
    /// How many ticks the own lane must have been usable to give the borrowed one back.
    pub usable_self_lane_cycle_threshold: u32,
    /// What stands nearer before a junction is not passed, m.
    pub junction_clearance_distance: f64,
}

impl Default for LaneBorrowConfig {
    fn default() -> Self {
        Self {
            allow_lane_borrowing: true,
            lane_borrow_max_speed: 5.0,
            lane_borrow_max_speed_alone: 20.0,
            long_term_blocking_obstacle_cycle_threshold: 3,
            usable_self_lane_cycle_threshold: 6,
            junction_clearance_distance: 15.0,
        }
    }
}

impl LaneBorrowConfig {
    /// The original as shipped.
    pub fn apollo() -> Self {
        let config = Self::default();
        Self {
            lane_borrow_max_speed_alone: config.lane_borrow_max_speed,
            ..config
        }
    }
}

/// What the decider remembers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BorrowState {
    /// Ticks in a row in which the own lane was blocked.
    pub blocked_cycles: u32,
    /// Ticks in a row in which the own lane would have done.
    pub usable_cycles: u32,
    /// What blocked it in the last of them, if that has a name.
    pub blocker: Option<ObstacleId>,
    /// Ticks in a row in which traffic left time to go out.
    pub free_cycles: u32,
    /// Sides that may be borrowed now, in order of preference; empty: none.
    pub sides: Vec<Borrow>,
}

/// How far ahead the lane line is read, m.
const LOOK_AHEAD: f64 = 100.0;

/// How far beyond what is passed it is read, m: the way back into the own lane at the speeds of a borrow. The original reads
/// on to the end of its look, and stands for good behind a car in a street whose line becomes solid long after it.
const WAY_BACK: f64 = 25.0;

/// How often it is read, m.
const STEP: f64 = 2.0;

/// Finds the sides that may be borrowed.
///
/// # Errors
/// None.
pub fn run(plan: &mut LinePlan, context: &mut Context) -> Result<(), TaskError> {
    plan.borrow = decide(&plan.scene, &mut context.borrow);
    Ok(())
}

/// Sides that may be borrowed in this tick.
fn decide(scene: &Scene, state: &mut BorrowState) -> Vec<Borrow> {
    let config = &scene.config.lane_borrow;
    let leaves = state.usable_cycles >= config.usable_self_lane_cycle_threshold;
    if !config.allow_lane_borrowing || scene.is_change_lane || leaves {
        state.sides.clear();
    }
    let waited = state.blocked_cycles >= config.long_term_blocking_obstacle_cycle_threshold;
    let max_speed = if scene.moving.is_empty() {
        config.lane_borrow_max_speed_alone
    } else {
        config.lane_borrow_max_speed
    };
    let may_begin = config.allow_lane_borrowing
        && !scene.is_change_lane
        && scene.frame.lines.len() == 1
        && waited
        && scene.start.v < max_speed
        && conditions::may_be_passed(scene, state);
    if state.sides.is_empty() && may_begin {
        let blocker = state.blocker.and_then(|id| scene.obstacle(id));
        state.sides = crossable_sides(scene, blocker);
        state.usable_cycles = 0;
    }
    state.sides.clone()
}

/// Whether a neighbouring lane may be borrowed here at all, if not now.
pub fn is_permitted(scene: &Scene) -> bool {
    let has_neighbour = scene
        .line
        .sample_at(scene.ego.s)
        .neighbours
        .iter()
        .any(Option::is_some);
    scene.config.lane_borrow.allow_lane_borrowing && has_neighbour && !crossable_sides(scene, None).is_empty()
}

/// What the own lane alone would have been good for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OwnLane {
    /// It leads on.
    Usable,
    /// It is blocked, by this obstacle if it is one.
    Blocked(Option<ObstacleId>),
}

/// Takes note of the own lane; `None`: it was not looked at.
pub fn observe(state: &mut BorrowState, own_lane: Option<OwnLane>) {
    match own_lane {
        Some(OwnLane::Blocked(blocker)) => {
            state.blocker = blocker;
            state.blocked_cycles += 1;
            state.usable_cycles = 0;
        }
        Some(OwnLane::Usable) => {
            state.blocker = None;
            state.blocked_cycles = 0;
            state.usable_cycles += 1;
        }
        None => {}
    }
}

/// How many ticks traffic must have left time before the car goes out: a gap that is there for one tick is
/// none.
pub const FREE_CYCLES: u32 = 4;

/// Takes note of whether traffic left time to go out; `None`: that was not asked.
pub fn observe_traffic(state: &mut BorrowState, is_free: Option<bool>) {
    state.free_cycles = if is_free == Some(true) {
        state.free_cycles + 1
    } else {
        0
    };
}

/// Sides whose line may be crossed all the way past the blocker and back, the left first. Of a blocker without a name: all
/// the way ahead. Double yellow forbids either side.
fn crossable_sides(scene: &Scene, blocker: Option<&ObstacleSl>) -> Vec<Borrow> {
    let solid = |kind: BoundaryType| {
        matches!(
            kind,
            BoundaryType::SolidYellow | BoundaryType::SolidWhite | BoundaryType::DoubleYellow
        )
    };
    let passed = blocker.map_or(f64::INFINITY, |blocker| blocker.end_s + WAY_BACK);
    let end = (scene.ego_end_s() + LOOK_AHEAD)
        .min(passed)
        .min(scene.line.length());
    let (mut left, mut right) = (true, true);
    let mut s = scene.ego_end_s();
    while s < end {
        let Some(marks) = scene.line.boundary_types(s) else {
            return Vec::new();
        };
        left &= !solid(marks.0);
        right &= !solid(marks.1);
        s += STEP;
    }
    let sides = [(left, Borrow::Left), (right, Borrow::Right)];
    sides
        .into_iter()
        .filter(|(may, _)| *may)
        .map(|(_, side)| side)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference_line::ReferenceLine;
    use crate::tasks::testing::Stage;
    use std::sync::Arc;

    /// The sides that are borrowed at last to pass a car from 48 to 52 m.
    fn borrowed(junction_from: f64) -> Vec<Borrow> {
        let mut stage = Stage::new(200.0, junction_from);
        let mut state = BorrowState {
            blocked_cycles: stage
                .config
                .lane_borrow
                .long_term_blocking_obstacle_cycle_threshold,
            blocker: Some(stage.park(50.0)),
            ..BorrowState::default()
        };
        decide(&stage.scene(), &mut state)
    }

    #[test]
    fn no_lane_is_borrowed_close_before_a_junction() {
        assert_eq!(borrowed(f64::MAX), [Borrow::Left]);
        assert_eq!(borrowed(66.0), []);
    }

    /// The sides that are borrowed at last to pass a car from 48 to 52 m where no line may be crossed from a station on.
    fn borrowed_before_solid(from: f64) -> Vec<Borrow> {
        let mut stage = Stage::new(200.0, f64::MAX);
        let mut samples = stage.frame.lines[0].line.samples().to_vec();
        for sample in samples.iter_mut().filter(|sample| sample.s >= from) {
            sample.marks = (BoundaryType::SolidWhite, BoundaryType::SolidWhite);
        }
        stage.frame.lines[0].line = Arc::new(ReferenceLine::from(samples));
        let mut state = BorrowState {
            blocked_cycles: stage
                .config
                .lane_borrow
                .long_term_blocking_obstacle_cycle_threshold,
            blocker: Some(stage.park(50.0)),
            ..BorrowState::default()
        };
        decide(&stage.scene(), &mut state)
    }

    #[test]
    fn a_line_is_read_as_far_as_it_has_to_be_crossed() {
        assert_eq!(borrowed_before_solid(52.0 + WAY_BACK), [Borrow::Left]);
        assert_eq!(borrowed_before_solid(50.0 + WAY_BACK), []);
    }
}
