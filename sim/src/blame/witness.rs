//! A motion that survives, how to tell of it, and its check by a code of its own.

use super::car::{CarState, Limits};
use super::search::samples_in;
use super::tracks::Surroundings;
use corridor_decider::frame::EgoState;
use corridor_decider::geometry::{Pose, angle, cross};
use corridor_decider::reference_line::LineQuery;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Room for rounding in the check of a motion's limits, relative.
const ROUNDING: f64 = 1e-6;

/// How far a step of a motion may be from the arc that it claims to be, m and rad per step.
const OFF_ARC: f64 = 1e-6;

/// Less sideways than this is no swerve, m: less than trackers are wrong by; less change of speed no braking, m/s.
const SWERVE: f64 = 0.1;
const SPEEDING: f64 = 0.5;

/// How often the edge of the road is looked at, s: as the monitor does.
const ROAD_PERIOD: f64 = 0.1;

/// A motion of the car, sample by sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// Sample at which it begins.
    pub first: usize,
    /// The car from there on, one state a sample.
    pub states: Vec<CarState>,
}

/// What a motion comes to at the moment of the bad end, against what the run did.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manoeuvre {
    /// How much faster the car is then, m/s; negative: it has braked.
    pub speed: f64,
    /// How much farther left it is, m; negative: farther right.
    pub left: f64,
}

impl fmt::Display for Manoeuvre {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let speed = if self.speed < -SPEEDING {
            Some("braking")
        } else if self.speed > SPEEDING {
            Some("driving faster")
        } else {
            None
        };
        let side = if self.left > SWERVE {
            Some("going left")
        } else if self.left < -SWERVE {
            Some("going right")
        } else {
            None
        };
        match (speed, side) {
            (Some(speed), Some(side)) => write!(f, "{speed} and {side}"),
            (Some(only), None) | (None, Some(only)) => f.write_str(only),
            (None, None) => f.write_str("driving on along the road"),
        }
    }
}

impl Witness {
    /// What the motion has come to by a sample, against a run in which the ego was as given then.
    pub fn manoeuvre(&self, surroundings: &Surroundings, by: usize, against: &EgoState) -> Manoeuvre {
        let line = &surroundings.scenario.line;
        let there = &self.states[by.saturating_sub(self.first).min(self.states.len() - 1)];
        let driven = line.to_frenet(against.pose.position());
        Manoeuvre {
            speed: there.v - against.v,
            left: line.to_frenet_near(there.place, driven.s).l - driven.l,
        }
    }

    /// Checks the motion with nothing of the search: that each step is one that the car can make, that the true
    /// footprints overlap at no sample, and that all corners are on the road. The first thing that is wrong, in words.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn check(&self, surroundings: &Surroundings, limits: &Limits) -> Result<(), String> {
        for (k, pair) in self.states.windows(2).enumerate() {
            step_is_possible(&pair[0], &pair[1], limits, surroundings.dt)
                .map_err(|problem| format!("step {k}: {problem}"))?;
        }
        let period = samples_in(ROAD_PERIOD, surroundings.dt);
        for (k, car) in self.states.iter().enumerate().skip(1) {
            let sample = self.first + k;
            let ego = surroundings.scenario.vehicle.footprint(car.pose());
            for (obstacle, track) in surroundings.scenario.obstacles.iter().zip(&surroundings.tracks) {
                let at = track.pose(sample);
                let theta = libm::atan2(at.forward.y, at.forward.x);
                let other = obstacle.shape.at(Pose::new(at.place.x, at.place.y, theta));
                if ego.overlaps(&other) {
                    return Err(format!("overlaps `{}` at sample {sample}", obstacle.name));
                }
            }
            let off = |c| surroundings.scenario.map.distance_off_road(c);
            let worst = ego.vertices().iter().map(|c| off(*c)).fold(0.0, f64::max);
            if sample.is_multiple_of(period) && worst > surroundings.off_road + ROUNDING {
                return Err(format!("is {worst:.3} m off the road at sample {sample}"));
            }
        }
        Ok(())
    }
}

/// Whether the car can get from one state to the next in `dt` seconds.
fn step_is_possible(from: &CarState, to: &CarState, limits: &Limits, dt: f64) -> Result<(), String> {
    let within = |value: f64, low: f64, high: f64| value >= low - ROUNDING && value <= high + ROUNDING;
    let a = (to.v - from.v) / dt;
    if !within(a, limits.braking, limits.acceleration) || to.v < 0.0 {
        return Err(format!("accelerates by {a} m/s²"));
    }
    let steer = |kappa: f64| libm::atan(kappa * limits.wheel_base);
    let rate = (steer(to.kappa) - steer(from.kappa)) / dt;
    // The rate is that at the step's beginning; over a step it changes by less than a percent.
    if !within(rate.abs(), 0.0, 1.01 * limits.steer_rate) {
        return Err(format!("turns the wheels by {rate} rad/s"));
    }
    let lateral = to.v * to.v * to.kappa;
    let eases = to.kappa.abs() < from.kappa.abs();
    if !(within(lateral.abs(), 0.0, limits.lateral) || eases) || to.kappa.abs() > limits.kappa + ROUNDING {
        return Err(format!("bends by {} 1/m at {} m/s", to.kappa, to.v));
    }
    let way = f64::midpoint(from.v, to.v) * dt;
    let (here, there) = (from.pose(), to.pose());
    let turn = angle::difference(there.theta, here.theta);
    if (turn - to.kappa * way).abs() > OFF_ARC {
        return Err(format!("turns by {turn} rad on {way} m"));
    }
    let moved = there.position() - here.position();
    let along = Pose::new(0.0, 0.0, here.theta + turn / 2.0).forward();
    if cross(along, moved).abs() > OFF_ARC || (moved.dot(&along) - way).abs() > OFF_ARC {
        return Err(format!("moves by {moved:?}"));
    }
    Ok(())
}
