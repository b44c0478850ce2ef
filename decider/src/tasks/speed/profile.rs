//! The speed profile: integrated forward, accelerating as the tightest constraint allows.

use super::limits::Envelope;
use super::overlap::Claim;
use super::rules::{self, BRAKE_LATE, Motion};
use super::SpeedConfig;
use crate::decision::{Stop, StopCause};
use crate::frame::ObstacleId;
use crate::st_graph::{SpeedData, SpeedPoint};
use crate::tasks::scene::Scene;

/// Time between trajectory points, s.
const STEP: f64 = 0.1;

/// Number of steps: eight seconds.
const STEPS: u32 = 80;

/// Slower than this the car stands, m/s.
const STANDSTILL: f64 = 0.02;

/// A standing car moves up to its stop again for more than this, m.
const RESTART: f64 = 0.3;

/// A standing car follows traffic again for more than this, m.
const RESTART_IN_TRAFFIC: f64 = 1.5;

/// How much longer a crossing obstacle that was yielded to a tick ago is yielded to, s.
const YIELD_HYSTERESIS: f64 = 0.7;

/// An obstacle slower than this along the path crosses it rather than leads, m/s.
const LEADER_SPEED: f64 = 0.5;

/// Motion along the path at one time.
#[derive(Clone, Copy)]
struct State {
    t: f64,
    distance: f64,
    v: f64,
    a: f64,
}

impl State {
    fn motion(&self) -> Motion {
        Motion { v: self.v, a: self.a }
    }
}

/// How a claim is dealt with.
#[derive(Clone, Copy, PartialEq)]
enum Response {
    /// Stay behind it, wherever it is at the time.
    Follow,
    /// Stop before its stretch until it has gone.
    Yield,
    /// Be gone before it comes, or it is gone before we come.
    Ignore,
}

pub(super) fn integrate(
    scene: &Scene,
    envelope: &Envelope,
    stop: Stop,
    claims: &[Claim],
    yielded_to: Option<ObstacleId>,
) -> (SpeedData, Option<Stop>) {
    let planner = Planner {
        scene,
        envelope,
        stop,
        config: &scene.config.speed,
    };
    let mut responses: Vec<Response> = claims.iter().map(first_response).collect();
    let mut states = planner.run(claims, &responses, false);
    let margin = |id: ObstacleId| {
        let held = yielded_to == Some(id);
        planner.config.yield_time + if held { YIELD_HYSTERESIS } else { 0.0 }
    };
    // A claim that can be ignored is, until the profile made so meets it.
    for _ in 0..claims.len() {
        let Some(hit) = first_hit(claims, &responses, &states, &margin) else {
            break;
        };
        responses[hit] = Response::Yield;
        states = planner.run(claims, &responses, false);
    }
    if meets_any(claims, &states) {
        states = planner.run(claims, &responses, true);
    }
    let reason = planner.reason(claims, &responses, &states);
    let point = |state: &State| SpeedPoint {
        t: state.t,
        s: state.distance,
        v: state.v,
        a: state.a,
        da: 0.0,
    };
    (SpeedData::new(states.iter().map(point).collect()), reason)
}

/// Something that is on the path and goes our way is followed; what stands on it or comes at us is yielded to.
fn first_response(claim: &Claim) -> Response {
    match claim {
        _ if claim.s_dot > LEADER_SPEED => Response::Follow,
        _ if claim.is_present => Response::Yield,
        _ => Response::Ignore,
    }
}

struct Planner<'a> {
    scene: &'a Scene<'a>,
    envelope: &'a Envelope,
    stop: Stop,
    config: &'a SpeedConfig,
}

impl Planner<'_> {
    fn run(&self, claims: &[Claim], responses: &[Response], emergency: bool) -> Vec<State> {
        let start = &self.scene.start;
        let mut state = State {
            t: 0.0,
            distance: 0.0,
            v: start.v,
            a: start.a,
        };
        let mut states = Vec::with_capacity(STEPS as usize + 1);
        states.push(state);
        for _ in 0..STEPS {
            let wanted = if emergency {
                self.scene.vehicle.max_deceleration
            } else {
                self.acceleration(&state, claims, responses)
            };
            state = self.advance(&state, wanted);
            states.push(state);
        }
        states
    }

    /// The acceleration that the tightest constraint allows.
    fn acceleration(&self, state: &State, claims: &[Claim], responses: &[Response]) -> f64 {
        let own = self.cruise(state).min(self.brake(state));
        let constraints = claims.iter().zip(responses);
        constraints.fold(own, |wanted, (claim, response)| {
            wanted.min(self.give_way(state, claim, *response))
        })
    }

    /// Towards the speed that the road allows here and shortly ahead.
    fn cruise(&self, state: &State) -> f64 {
        let here = self.envelope.at(state.distance);
        let ahead = self.envelope.at(state.distance + state.v * STEP * 2.0);
        rules::cruise(self.config, state.v, here.min(ahead))
    }

    /// For the stop. The end of a path that is not closed moves on as the car does: it can wait.
    fn brake(&self, state: &State) -> f64 {
        let patience = if self.stop.cause == StopCause::PathEnd {
            1.0
        } else {
            BRAKE_LATE
        };
        rules::stop(
            self.config,
            state.motion(),
            self.stop.distance - state.distance,
            patience,
            RESTART,
        )
    }

    /// For a moving obstacle.
    fn give_way(&self, state: &State, claim: &Claim, response: Response) -> f64 {
        let free = f64::MAX;
        match response {
            Response::Ignore => free,
            Response::Follow => claim.at(state.t).map_or(free, |there| {
                let gap = there.low - state.distance;
                rules::follow(self.config, state.v, claim.s_dot, gap, self.scene.cruise_speed)
            }),
            Response::Yield => fence(claim, state).map_or(free, |fence| {
                let ahead = fence - state.distance;
                let gap = rules::stop_before(self.config, state.v, ahead, self.config.follow_distance);
                rules::stop(self.config, state.motion(), gap, BRAKE_LATE, RESTART_IN_TRAFFIC)
            }),
        }
    }

    /// One step with limited jerk; hard braking may come fast.
    fn advance(&self, state: &State, wanted: f64) -> State {
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
        let distance = state.distance + f64::midpoint(state.v, v) * STEP;
        State {
            t: state.t + STEP,
            distance,
            v,
            a,
        }
    }

    /// The constraint that rules at the start or, failing that, the stop within the horizon.
    fn reason(&self, claims: &[Claim], responses: &[Response], states: &[State]) -> Option<Stop> {
        let (start, end) = (&states[0], &states[states.len() - 1]);
        let mut tightest = (self.cruise(start) - 1e-9, None);
        for (claim, response) in claims.iter().zip(responses) {
            let wanted = self.give_way(start, claim, *response);
            if wanted < tightest.0 {
                let cause = match response {
                    Response::Follow => StopCause::Follow(claim.id),
                    _ => StopCause::Yield(claim.id),
                };
                tightest = (
                    wanted,
                    Some(Stop {
                        distance: claim.occupied[0].low,
                        cause,
                    }),
                );
            }
        }
        let stops = self.brake(start) <= tightest.0;
        let stands = tightest.1.is_none() && end.v <= STANDSTILL;
        if stops || stands {
            Some(self.stop)
        } else {
            tightest.1
        }
    }
}

/// The nearest place before a claim's stretch that is still to be kept free at this time.
fn fence(claim: &Claim, state: &State) -> Option<f64> {
    let to_come = claim
        .occupied
        .iter()
        .filter(|o| o.t + claim.period >= state.t && o.high > state.distance);
    to_come.map(|o| o.low).min_by(f64::total_cmp)
}

/// The first ignored claim that the profile comes too near to in time.
fn first_hit(
    claims: &[Claim],
    responses: &[Response],
    states: &[State],
    margin: &dyn Fn(ObstacleId) -> f64,
) -> Option<usize> {
    claims.iter().zip(responses).position(|(claim, response)| {
        *response == Response::Ignore
            && states.iter().any(|state| {
                claim.occupied.iter().any(|o| {
                    (o.t - state.t).abs() <= margin(claim.id)
                        && state.distance > o.low
                        && state.distance < o.high
                })
            })
    })
}

/// Whether the profile enters any claimed stretch at its time.
fn meets_any(claims: &[Claim], states: &[State]) -> bool {
    let hits = |claim: &Claim, state: &State| {
        claim
            .at(state.t)
            .is_some_and(|o| state.distance > o.low && state.distance < o.high)
    };
    claims.iter().any(|claim| {
        states
            .iter()
            .any(|state| state.v > STANDSTILL && hits(claim, state))
    })
}
