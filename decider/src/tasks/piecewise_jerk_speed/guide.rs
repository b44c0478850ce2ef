//! The guide of the speed optimiser: integrated forward, accelerating as the tightest constraint allows.
//!
//! The search over the ST graph says before or after whom the car passes, on a grid of seconds and whole metres; what
//! jumps from node to node from one tick to the next is nothing to be drawn to. The guide keeps what was decided and
//! drives as a driver would.

use super::rules::{self, BRAKE_LATE, Motion};
use crate::decision::{Stop, StopCause};
use crate::planner::{LinePlan, TaskError};
use crate::st_graph::{BoundaryType, SpeedData, SpeedPoint, StBoundary, StPoint};
use crate::steps;
use crate::tasks::piecewise_jerk_speed::SpeedConfig;
use crate::tasks::scene::Scene;
use crate::tasks::speed_bounds::{Envelope, OnPath};

/// Time between two steps, s.
pub(super) const STEP: f64 = 0.1;

/// Nothing is planned for longer than this, s.
const LONGEST: f64 = 30.0;

/// Slower than this the car stands, m/s.
const STANDSTILL: f64 = 0.02;

/// A leader slower than this is not crept after, m/s: the car stands until there is room to drive.
const CREEPING: f64 = 0.5;

/// A standing car moves up to its stop again for more than this, m.
const RESTART: f64 = 0.3;

/// A standing car follows traffic again for more than this, m.
const RESTART_IN_TRAFFIC: f64 = 2.0;

fn motion(state: &SpeedPoint) -> Motion {
    Motion {
        v: state.v,
        a: state.a,
    }
}

/// A profile to be followed, and what holds the car back most on it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Guide {
    /// Place, speed and acceleration at every step.
    pub profile: SpeedData,
    /// The constraint that rules.
    pub stop: Option<Stop>,
}

/// Integrates the profile of a plan whose obstacles are decided about. An obstacle that was to be passed before, and
/// that the profile meets, is yielded to after all.
///
/// # Errors
/// [`TaskError::Unavoidable`] where the profile meets an obstacle whatever is yielded to.
pub(super) fn integrate(plan: &mut LinePlan, wall: Stop) -> Result<Guide, TaskError> {
    loop {
        steps::count();
        let planner = Planner {
            scene: &plan.scene,
            envelope: plan.envelope.as_ref().ok_or(TaskError::NoPath)?,
            wall,
            on_path: &plan.on_path,
            config: &plan.scene.config.speed,
        };
        let states = planner.run();
        let Some(met) = first_met(&plan.on_path, &states) else {
            let stop = planner.reason(&states);
            return Ok(Guide {
                profile: SpeedData::new(states),
                stop,
            });
        };
        let boundary = &mut plan.on_path[met].boundary;
        if is_stayed_behind(boundary.kind) {
            return Err(TaskError::Unavoidable(plan.on_path[met].id));
        }
        boundary.kind = BoundaryType::Yield;
    }
}

/// Whether the car is to stay behind an obstacle rather than pass before it.
fn is_stayed_behind(kind: BoundaryType) -> bool {
    matches!(
        kind,
        BoundaryType::Follow | BoundaryType::Yield | BoundaryType::Stop
    )
}

/// The first obstacle that a profile meets while the car moves.
fn first_met(on_path: &[OnPath], states: &[SpeedPoint]) -> Option<usize> {
    let meets = |boundary: &StBoundary, state: &SpeedPoint| {
        let moves = state.v > STANDSTILL;
        moves && boundary.contains(StPoint::new(state.t, state.s))
    };
    on_path
        .iter()
        .position(|there| states.iter().any(|state| meets(&there.boundary, state)))
}

struct Planner<'a> {
    scene: &'a Scene<'a>,
    envelope: &'a Envelope,
    wall: Stop,
    on_path: &'a [OnPath],
    config: &'a SpeedConfig,
}

impl Planner<'_> {
    fn run(&self) -> Vec<SpeedPoint> {
        let start = &self.scene.start;
        let mut state = SpeedPoint {
            v: start.v,
            a: start.a,
            ..SpeedPoint::default()
        };
        let mut states = vec![state];
        for k in 1..=steps(self.config) {
            state = self.advance(&state, self.acceleration(&state));
            state.t = k as f64 * STEP;
            states.push(state);
        }
        states
    }

    /// The acceleration that the tightest constraint allows.
    fn acceleration(&self, state: &SpeedPoint) -> f64 {
        let own = self.cruise(state).min(self.brake(state));
        let others = self.on_path.iter().map(|there| self.give_way(state, there));
        others.fold(own, f64::min)
    }

    /// Towards the speed that the road allows here and shortly ahead.
    fn cruise(&self, state: &SpeedPoint) -> f64 {
        let here = self.envelope.at(state.s);
        let ahead = self.envelope.at(state.s + state.v * STEP * 2.0);
        rules::cruise(self.config, state.v, here.min(ahead))
    }

    /// For the stop. The end of a path that is not closed moves on as the car does: it can wait.
    fn brake(&self, state: &SpeedPoint) -> f64 {
        let patience = if self.wall.cause == StopCause::PathEnd {
            1.0
        } else {
            BRAKE_LATE
        };
        rules::stop(
            self.config,
            motion(state),
            self.wall.distance - state.s,
            patience,
            RESTART,
        )
    }

    /// For a moving obstacle.
    fn give_way(&self, state: &SpeedPoint, there: &OnPath) -> f64 {
        let free = f64::MAX;
        match there.boundary.kind {
            BoundaryType::Follow if there.s_dot > CREEPING => {
                there.boundary.edges_at(state.t).map_or(free, |edges| {
                    let gap = edges.lower - state.s;
                    rules::follow(self.config, state.v, there.s_dot, gap, self.scene.cruise_speed)
                })
            }
            BoundaryType::Follow | BoundaryType::Yield | BoundaryType::Stop => fence(&there.boundary, state)
                .map_or(free, |fence| {
                    let ahead = fence - state.s;
                    let gap = rules::stop_before(self.config, state.v, ahead, self.config.follow_distance);
                    rules::stop(self.config, motion(state), gap, BRAKE_LATE, RESTART_IN_TRAFFIC)
                }),
            BoundaryType::Overtake | BoundaryType::KeepClear | BoundaryType::Unknown => free,
        }
    }

    /// One step with limited jerk; hard braking may come fast.
    fn advance(&self, state: &SpeedPoint, wanted: f64) -> SpeedPoint {
        let config = self.config;
        let vehicle = self.scene.vehicle;
        let wanted = wanted.clamp(
            vehicle.max_deceleration,
            config.acceleration.min(vehicle.max_acceleration),
        );
        let jerk = if wanted < -config.hard_braking {
            config.emergency_jerk
        } else {
            config.jerk
        };
        let release = jerk.max(rules::release(state.a));
        let mut a = wanted.clamp(state.a - jerk * STEP, state.a + release * STEP);
        let mut v = state.v + a * STEP;
        if v < STANDSTILL && a <= 0.0 {
            v = 0.0;
            a = 0.0;
        }
        let s = state.s + f64::midpoint(state.v, v) * STEP;
        SpeedPoint {
            t: state.t + STEP,
            s,
            v,
            a,
            da: (a - state.a) / STEP,
        }
    }

    /// The constraint that rules at the start or, failing that, the wall if it is reached.
    fn reason(&self, states: &[SpeedPoint]) -> Option<Stop> {
        let (start, end) = (&states[0], &states[states.len() - 1]);
        let mut tightest = (self.cruise(start) - 1e-9, None);
        for there in self.on_path {
            let wanted = self.give_way(start, there);
            if wanted < tightest.0 {
                let cause = match there.boundary.kind {
                    BoundaryType::Follow => StopCause::Follow(there.id),
                    _ => StopCause::Yield(there.id),
                };
                let distance = there.boundary.first().lower;
                tightest = (wanted, Some(Stop { distance, cause }));
            }
        }
        let stops = self.brake(start) <= tightest.0;
        let stands = tightest.1.is_none() && end.v <= STANDSTILL;
        if stops || stands {
            Some(self.wall)
        } else {
            tightest.1
        }
    }
}

/// Number of steps.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a few seconds"
)]
pub(super) fn steps(config: &SpeedConfig) -> usize {
    (config.total_time.clamp(STEP, LONGEST) / STEP).round() as usize
}

/// The nearest place before what an obstacle will yet occupy of the path ahead.
fn fence(boundary: &StBoundary, state: &SpeedPoint) -> Option<f64> {
    let now = boundary.edges_at(state.t).map(|edges| (edges.lower, edges.upper));
    let later = boundary.pairs().iter().filter(|pair| pair.t >= state.t);
    let to_come = now.into_iter().chain(later.map(|pair| (pair.lower, pair.upper)));
    to_come
        .filter(|(_, upper)| *upper > state.s)
        .map(|(lower, _)| lower)
        .min_by(f64::total_cmp)
}
