//! Braking with limited jerk to standstill, in closed form: brakes are applied as fast as they may, held at their
//! hardest, and released so that speed and acceleration come to 0 together.

use super::speed_profile::{FALLBACK_STEP, filled};
use crate::st_graph::{SpeedData, SpeedPoint};
use crate::steps;

/// What a stop may ask of the brakes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrakingLimits {
    /// Hardest braking, m/s², negative.
    pub max_deceleration: f64,
    /// Jerk while the brakes are applied, m/s³, negative.
    pub apply: f64,
    /// Jerk while they are released, m/s³, positive.
    pub release: f64,
}

impl BrakingLimits {
    /// Limits of a normal stop (the original's jerk limits and hardest braking).
    pub const NORMAL: Self = Self {
        max_deceleration: -6.0,
        apply: -4.0,
        release: 2.0,
    };

    /// Limits of an emergency: brakes at their hardest within a fifth of a second.
    pub const EMERGENCY: Self = Self {
        max_deceleration: -6.0,
        apply: -30.0,
        release: 10.0,
    };

    /// The same with the brakes of some vehicle.
    #[must_use]
    pub fn with_max_deceleration(self, max_deceleration: f64) -> Self {
        Self {
            max_deceleration,
            ..self
        }
    }
}

/// A time of constant jerk.
#[derive(Clone, Copy)]
struct Phase {
    jerk: f64,
    lasts: f64,
}

/// Brakes from speed `v` and acceleration `a` to standstill. A negative speed counts as 0; an acceleration beyond the
/// brakes counts as theirs. Where the brakes cannot be released in time the car stands with them applied.
pub fn braking_profile(v: f64, a: f64, limits: BrakingLimits) -> SpeedData {
    let v = v.max(0.0);
    let a = if v > 0.0 {
        a.max(limits.max_deceleration)
    } else {
        a.min(0.0)
    };
    let start = SpeedPoint {
        v,
        a,
        ..SpeedPoint::default()
    };
    let phases = if v > 0.0 { phases(v, a, limits) } else { Vec::new() };
    sampled(start, &phases)
}

/// Apply, hold and release.
fn phases(v: f64, a: f64, limits: BrakingLimits) -> Vec<Phase> {
    let BrakingLimits {
        max_deceleration,
        apply,
        release,
    } = limits;
    // Applying the brakes from `a` to `-b` takes (b² - a²) / 2|apply| off the speed, releasing them b² / 2 release.
    let (apply, weight) = (apply.abs(), 0.5 / apply.abs() + 0.5 / release);
    let peak = ((v + 0.5 * a * a / apply) / weight).sqrt().min(-max_deceleration);
    if peak < -a {
        return vec![Phase {
            jerk: release,
            lasts: -a / release,
        }];
    }
    let left = v - ((peak * peak - a * a) * 0.5 / apply + peak * peak * 0.5 / release);
    let phase = |jerk, lasts: f64| Phase {
        jerk,
        lasts: lasts.max(0.0),
    };
    vec![
        phase(-apply, (a + peak) / apply),
        phase(0.0, left / peak),
        phase(release, peak / release),
    ]
}

/// Points of the phases up to standstill, which comes at the end of the step in which the car stops.
fn sampled(start: SpeedPoint, phases: &[Phase]) -> SpeedData {
    let mut points = vec![start];
    let ends = |phase: &Phase| phase.lasts;
    let duration: f64 = phases.iter().map(ends).sum();
    let mut step = 1.0;
    loop {
        steps::count();
        let t = step * FALLBACK_STEP;
        let before = points[points.len() - 1];
        if t - FALLBACK_STEP >= duration {
            break;
        }
        let mut point = at(start, phases, t.min(duration));
        let stands = point.v <= 0.0 || t >= duration;
        if stands {
            point = SpeedPoint {
                s: standing_place(start, phases, t.min(duration)),
                ..SpeedPoint::default()
            };
        }
        point.t = t;
        point.s = point.s.max(before.s);
        point.da = (point.a - before.a) / FALLBACK_STEP;
        points.push(point);
        if stands {
            break;
        }
        step += 1.0;
    }
    filled(points)
}

/// The motion at a time.
fn at(start: SpeedPoint, phases: &[Phase], t: f64) -> SpeedPoint {
    let mut now = start;
    let mut left = t;
    for phase in phases {
        let dt = left.min(phase.lasts);
        now = SpeedPoint {
            s: now.s + dt * (now.v + dt * (now.a / 2.0 + dt * phase.jerk / 6.0)),
            v: now.v + dt * (now.a + dt * phase.jerk / 2.0),
            a: now.a + dt * phase.jerk,
            ..now
        };
        left -= dt;
    }
    now
}

/// Where the car is when its speed first comes to 0, by halving the time up to `t`, at which it has.
fn standing_place(start: SpeedPoint, phases: &[Phase], t: f64) -> f64 {
    let (mut moving, mut standing) = ((t - FALLBACK_STEP).max(0.0), t);
    for _ in 0..50 {
        let middle = f64::midpoint(moving, standing);
        if at(start, phases, middle).v > 0.0 {
            moving = middle;
        } else {
            standing = middle;
        }
    }
    at(start, phases, moving).s
}
