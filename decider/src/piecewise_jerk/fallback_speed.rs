//! The station over the time when nothing better was found: as short a way as possible.
//!
//! Source: Apollo's `SpeedProfileGenerator`. Metres and seconds. The limits are what the car can, not what is
//! comfortable: this is what is done when all else failed.

use super::problem::{Cost, JerkCoupling, Limits, Problem, State, Term};

/// A stop to be found.
#[derive(Clone, Debug, PartialEq)]
pub struct FallbackSpeedProblem {
    /// Number of knots.
    pub knots: usize,
    /// Their distance, s.
    pub delta_t: f64,
    /// Station, speed and acceleration now.
    pub initial: State,
    /// Where the car is drawn to, m ahead; 0 is the shortest stop.
    pub stop_distance: f64,
    /// Lowest and highest station, m.
    pub s: Limits,
    /// Lowest and highest speed, m/s.
    pub v: Limits,
    /// Hardest braking and acceleration, m/s².
    pub a: Limits,
    /// Fastest change of acceleration down and up, m/s³.
    pub jerk: Limits,
}

impl FallbackSpeedProblem {
    /// The original's problem for a car at this speed and acceleration: 3 s at 10 Hz.
    pub fn shortest_stop(v: f64, a: f64) -> Self {
        /// Highest speed that is ever planned, m/s.
        const UPPER_SPEED: f64 = 31.3;
        Self {
            knots: 31,
            delta_t: 0.1,
            initial: State {
                x: 0.0,
                dx: v,
                ddx: a,
            },
            stop_distance: 0.0,
            s: (0.0, 100.0),
            v: (0.0, v.max(UPPER_SPEED)),
            a: (-6.0, 2.0),
            jerk: (-4.0, 2.0),
        }
    }

    /// The problem as solvers know it.
    pub fn to_problem(&self) -> Problem {
        let n = self.knots;
        Problem {
            delta: self.delta_t,
            initial: self.initial,
            x: vec![self.s; n],
            dx: vec![self.v; n],
            ddx: vec![self.a; n],
            dddx: vec![self.jerk; n.saturating_sub(1)],
            cost: Cost {
                x: vec![Term::new(1.0, self.stop_distance); n],
                dx: vec![Term::default(); n],
                ddx: vec![Term::default(); n],
                dddx: 0.0,
                coupling: JerkCoupling::Symmetric,
                end: [Term::default(); 3],
                constant: 0.0,
            },
        }
    }
}
