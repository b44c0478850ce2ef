//! The speed that longitudinal curves are held against: the cruise speed, or a comfortable stop at the stop point (the
//! original's `PiecewiseBrakingTrajectoryGenerator`).

use super::PlanningTarget;
use super::grid::{HORIZON, SAMPLES, TIMES};
use super::piecewise_acceleration::{PiecewiseAcceleration, PiecewiseError};

/// Comfortable acceleration and braking, m/s², positive: half of what is allowed (`comfort_acceleration_factor`).
const ACCELERATION: f64 = 2.0;
const BRAKING: f64 = 3.0;

/// A car nearer to its stop point than this is there, m; a slower one stands, m/s.
const EPSILON: f64 = 1e-6;

/// Why there is no guide.
pub type GuideError = PiecewiseError;

/// What a stop is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Braking {
    /// Acceleration, m/s².
    pub acceleration: f64,
    /// Braking, m/s², positive.
    pub braking: f64,
    /// The profile lasts at least so long, s.
    pub duration: f64,
}

/// From `s` with speed `v` to a standstill at `stop_s`, at `cruise_speed` in between where there is room for it.
///
/// A car that cannot stop in comfort brakes evenly as hard as it must; one beyond its stop point brakes with what is
/// comfortable.
///
/// # Errors
/// [`GuideError`] for speeds that are negative.
pub fn braking_profile(
    (s, stop_s): (f64, f64),
    (v, cruise_speed): (f64, f64),
    with: Braking,
) -> Result<PiecewiseAcceleration, GuideError> {
    let mut profile = PiecewiseAcceleration::from(s, v);
    for (a, duration) in pieces(stop_s - s, v, cruise_speed, with) {
        profile.push(a, duration)?;
    }
    let left = with.duration - profile.length();
    if left > 0.0 {
        profile.push(0.0, left)?;
    }
    Ok(profile)
}

/// Accelerations and how long they last.
fn pieces(way: f64, v: f64, cruise: f64, with: Braking) -> Vec<(f64, f64)> {
    let Braking {
        acceleration: up,
        braking: down,
        ..
    } = with;
    let braking_way = v * v / (2.0 * down);
    if v > 0.0 && (way <= 0.0 || (cruise <= EPSILON && braking_way <= way)) {
        return vec![(-down, v / down)];
    }
    if way <= 0.0 || cruise <= EPSILON && v <= 0.0 {
        return Vec::new();
    }
    if braking_way > way {
        return vec![(-v * v / (2.0 * way), 2.0 * way / v)];
    }
    if v > cruise {
        return vec![
            (-down, (v - cruise) / down),
            (0.0, (way - braking_way) / cruise),
            (-down, cruise / down),
        ];
    }
    let (to_cruise, back) = ((cruise - v) / up, (cruise - v) / down);
    let rest = way - (v + cruise) * (to_cruise + back) / 2.0 - braking_way;
    if rest > 0.0 {
        return vec![(up, to_cruise), (0.0, rest / cruise), (-down, cruise / down)];
    }
    let peak = (v * v + 2.0 * up * down * (way - braking_way) / (up + down)).sqrt();
    vec![(up, (peak - v) / up), (-down, peak / down)]
}

/// The guide at the times of the grid, m/s, for a car at `s` with speed `v`; a negative speed counts as 0.
pub fn guide_speeds(target: &PlanningTarget, s: f64, v: f64) -> [f64; SAMPLES] {
    let Some(stop_s) = target.stop_s else {
        return [target.cruise_speed; SAMPLES];
    };
    if stop_s - s < EPSILON {
        return [0.0; SAMPLES];
    }
    let with = Braking {
        acceleration: ACCELERATION,
        braking: BRAKING,
        duration: HORIZON + EPSILON,
    };
    let profile = braking_profile((s, stop_s), (v.max(0.0), target.cruise_speed), with);
    let speed = |t: f64| {
        profile
            .as_ref()
            .ok()
            .and_then(|profile| profile.at(t))
            .map_or(0.0, |[_, v, _]| v)
    };
    TIMES.map(speed)
}
