//! The ladder of speed profiles that only stop, gentlest first.
//!
//! The original minimises the way to standstill within 3 s, which a car faster than 13.5 m/s cannot do, brakes as hard as
//! the car can for whatever reason it fell back, and ends in constant braking that begins with a jolt. Here the horizon
//! is as long as the stop takes, braking is as hard as the way that is left asks for, and every profile ends at rest.

use super::{BrakingLimits, braking_profile, speed_profile};
use crate::decision::SpeedRung;
use crate::piecewise_jerk::{FallbackSpeedProblem, Riccati, Solver, State, Term};
use crate::planner::{LinePlan, Part};
use crate::st_graph::{SpeedData, SpeedPoint};
use crate::tasks::path::Path;
use crate::tasks::start_point::StartPoint;
use crate::vehicle::VehicleParams;

/// Braking without need for more, m/s².
const COMFORTABLE: f64 = 2.5;

/// How much harder than the way that is left asks for one brakes, for the time that it takes to brake at all.
const MARGIN: f64 = 1.2;

/// Jerk of the usual ladder and of an emergency, m/s³: down, up.
const JERK: (f64, f64) = (-4.0, 2.0);
const EMERGENCY_JERK: (f64, f64) = (-30.0, 15.0);

/// Speed and acceleration that count as none at the end of a stop, m/s and m/s².
const AT_REST: (f64, f64) = (0.02, 0.05);

/// Weight of acceleration and jerk beside that of the way: without it acceleration ripples where the car stands, with
/// more of it the way grows longer for comfort.
const SMOOTH: f64 = 0.01;

/// Time between two knots, s, and the shortest horizon, s.
const STEP: f64 = 0.1;
const LEAST_TIME: f64 = 3.0;

/// Nobody takes longer to stop, s: a start point that asks for that is wrong.
const MOST_TIME: f64 = 60.0;

/// Time beyond that of constant braking that a stop takes: braking has to rise and to fade, s.
const RAMPS: f64 = 2.5;

/// Constant braking of the last rung, m/s² (the original's `slowdown_profile_deceleration`).
const CONSTANT: f64 = -4.0;

/// Slower than this, and not speeding up, a car stands, m/s.
const STANDS: f64 = 0.01;

/// Where a stop on a path has to end at the latest, m along it: at the wall, before what will be there, or at its end.
pub(super) fn target(plan: &LinePlan, path: &Path) -> f64 {
    let wall = plan.wall.map_or(path.length(), |wall| wall.distance);
    let ahead = plan.on_path.iter().map(|there| there.boundary.min_s());
    ahead
        .filter(|s| *s >= 0.0)
        .fold(wall.min(path.length()), f64::min)
        .max(0.0)
}

/// A profile from the start point to a standstill, before `target` if that can be, else as hard as the brakes can.
pub(super) fn stopping(
    start: &StartPoint,
    vehicle: &VehicleParams,
    target: Option<f64>,
    fails: &dyn Fn(Part) -> bool,
) -> (SpeedRung, SpeedData) {
    if start.v <= STANDS && start.a <= 0.0 {
        return (SpeedRung::Optimised, speed_profile::standstill());
    }
    let rungs = [
        (SpeedRung::Optimised, JERK, target),
        (SpeedRung::EmergencyJerk, EMERGENCY_JERK, target),
    ];
    let works = |rung: SpeedRung| !fails(Part::Speed(rung));
    let optimum = rungs
        .into_iter()
        .filter(|(rung, ..)| works(*rung))
        .find_map(|(rung, jerk, target)| Some((rung, optimised(start, vehicle, jerk, target)?)));
    optimum.unwrap_or_else(|| {
        if works(SpeedRung::Ramp) {
            let limits = BrakingLimits::EMERGENCY.with_max_deceleration(vehicle.max_deceleration);
            (SpeedRung::Ramp, braking_profile(start.v, start.a, limits))
        } else {
            let profile = speed_profile::constant_deceleration(start.v, start.a, CONSTANT);
            (SpeedRung::ConstantDeceleration, profile)
        }
    })
}

/// The shortest stop, braking no harder than needed.
fn optimised(
    start: &StartPoint,
    vehicle: &VehicleParams,
    jerk: (f64, f64),
    target: Option<f64>,
) -> Option<SpeedData> {
    let braking = braking(start.v, vehicle, target);
    let duration = (start.v / braking + RAMPS).max(LEAST_TIME);
    if duration.is_nan() || duration > MOST_TIME {
        return None;
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a few seconds"
    )]
    let knots = (duration / STEP).ceil() as usize + 1;
    let problem = FallbackSpeedProblem {
        knots,
        delta_t: STEP,
        initial: State {
            x: 0.0,
            dx: start.v,
            ddx: start.a,
        },
        stop_distance: 0.0,
        s: (0.0, target.unwrap_or(f64::INFINITY)),
        v: (0.0, f64::INFINITY),
        a: (-braking, vehicle.max_acceleration),
        jerk,
    };
    let mut problem = problem.to_problem();
    problem.cost.ddx = vec![Term::new(SMOOTH, 0.0); knots];
    problem.cost.dddx = SMOOTH;
    problem.admit_initial_state();
    let last = knots - 1;
    problem.dx[last] = (0.0, AT_REST.0);
    problem.ddx[last] = (-AT_REST.1, AT_REST.1);
    let solution = Riccati::new().solve(&problem).ok()?;
    let profile = speed_profile::extract(&solution.x, &solution.dx, &solution.ddx, STEP);
    Some(at_rest(profile, solution.x[last]))
}

/// A profile whose last knot moves no more to speak of stands from then on.
fn at_rest(mut profile: SpeedData, end: f64) -> SpeedData {
    if let Some(last) = profile.points.last().copied().filter(|last| last.v > 0.0) {
        profile.points.push(SpeedPoint {
            t: last.t + STEP,
            s: end.max(last.s),
            ..SpeedPoint::default()
        });
    }
    profile
}

/// How hard one has to brake, m/s², positive.
fn braking(v: f64, vehicle: &VehicleParams, target: Option<f64>) -> f64 {
    let hardest = -vehicle.max_deceleration;
    let needed = target.map_or(hardest, |way| MARGIN * v * v / (2.0 * way.max(f64::EPSILON)));
    needed.clamp(COMFORTABLE.min(hardest), hardest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose;
    use proptest::prelude::*;

    fn start(v: f64, a: f64) -> StartPoint {
        StartPoint {
            pose: Pose::new(0.0, 0.0, 0.0),
            kappa: 0.0,
            v,
            a,
        }
    }

    /// Held against the shortest stop with the same brakes and the same jerk, in closed form.
    #[test]
    fn who_has_to_stop_at_once_does_not_weigh_comfort() {
        let vehicle = VehicleParams::default();
        for v in [1.0, 2.0, 4.0, 8.0, 15.0] {
            let (_, profile) = stopping(&start(v, 0.0), &vehicle, None, &|_| false);
            let shortest = braking_profile(v, 0.0, BrakingLimits::NORMAL);
            let way = |profile: &SpeedData| profile.points[profile.points.len() - 1].s;
            let longer = way(&profile) / way(&shortest);
            assert!(longer < 1.1, "{longer} times as long from {v} m/s");
        }
    }

    proptest! {
        /// Every profile moves forward to a standstill; with room enough the first rung does; before a target where that
        /// can be, and where it cannot, within what the brakes need.
        #[test]
        fn every_stop_ends_at_rest(v in 0.0..30.0, a in -3.0..2.0, room in 0.0..2.0) {
            let vehicle = VehicleParams::default();
            let start = start(v, a);
            let way = room * v * v / 2.0 / COMFORTABLE;
            let (rung, profile) = stopping(&start, &vehicle, Some(way), &|_| false);
            let last = profile.points[profile.points.len() - 1];
            prop_assert!(last.v.abs() < 1e-6 && last.a.abs() < 1e-6, "{rung:?} ends with {last:?}");
            for pair in profile.points.windows(2) {
                prop_assert!(pair[1].s >= pair[0].s && pair[1].v >= 0.0 && pair[1].t > pair[0].t);
            }
            let gentle = a > -1.0 && v > 1.0 && way > v * 3.0 + v * v / 2.0 / COMFORTABLE;
            prop_assert!(!gentle || rung == SpeedRung::Optimised, "{rung:?} from {v}, {a} within {way} m");
            // The brakes are on within a third of a second, and let go as softly as they may at the end.
            let shortest = v * v / 2.0 / -vehicle.max_deceleration + 0.6 * v + 0.5;
            prop_assert!(last.s <= way.max(shortest), "{rung:?} takes {} m from {v}, {a} for {way}", last.s);
        }
    }
}
