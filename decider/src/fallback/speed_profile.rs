//! Fallback profiles by points a tenth of a second apart (the original's `SpeedProfileGenerator`).
//!
//! Against the original: constant braking ends at the exact moment at which the car stands and then stays there, for as
//! long as that takes; a negative speed counts as 0.

use crate::st_graph::{SpeedData, SpeedPoint};

/// Profiles are filled with standstill up to this time, s (`fallback_total_time`).
pub(super) const FALLBACK_TIME: f64 = 3.0;

/// Time between two points, s (`fallback_time_unit`).
pub(super) const FALLBACK_STEP: f64 = 0.1;

/// Nobody brakes for longer than this, s: however weak the brakes, a profile ends.
const LONGEST: f64 = 120.0;

/// The profile of a car that stands and stays.
pub fn standstill() -> SpeedData {
    filled(vec![SpeedPoint::default()])
}

/// Braking with `deceleration` (m/s², negative) from speed `v` at once, to standstill. `a` is the acceleration before.
pub fn constant_deceleration(v: f64, a: f64, deceleration: f64) -> SpeedData {
    let mut now = SpeedPoint {
        v: v.max(0.0),
        a,
        ..SpeedPoint::default()
    };
    let mut points = vec![now];
    while now.v > 0.0 && now.t < LONGEST && deceleration < 0.0 {
        let next_v = now.v + FALLBACK_STEP * deceleration;
        let stands = next_v <= 0.0;
        let moved = if stands {
            now.v * now.v / (-2.0 * deceleration)
        } else {
            0.5 * (now.v + next_v) * FALLBACK_STEP
        };
        now = SpeedPoint {
            t: now.t + FALLBACK_STEP,
            s: now.s + moved,
            v: next_v.max(0.0),
            a: if stands { 0.0 } else { deceleration },
            da: 0.0,
        };
        points.push(now);
    }
    filled(points)
}

/// The profile of optimised knots `delta` apart: up to the first knot that does not move on, then standing. The arrays
/// hold places, speeds and accelerations, and count as far as the shortest of them.
pub fn extract(s: &[f64], v: &[f64], a: &[f64], delta: f64) -> SpeedData {
    let mut points: Vec<SpeedPoint> = Vec::with_capacity(s.len());
    for (k, ((s, v), a)) in s.iter().zip(v).zip(a).enumerate() {
        let before = points.last().copied();
        if before.is_some_and(|before| s - before.s <= 0.0 || *v <= 0.0) {
            break;
        }
        #[expect(clippy::cast_precision_loss, reason = "few knots")]
        points.push(SpeedPoint {
            t: delta * k as f64,
            s: *s,
            v: *v,
            a: *a,
            da: before.map_or(0.0, |before| (a - before.a) / delta),
        });
    }
    filled(points)
}

/// Points with standstill where the last one is, up to the fallback time.
pub fn filled(mut points: Vec<SpeedPoint>) -> SpeedData {
    if let Some(last) = points.last().copied() {
        let mut t = last.t + FALLBACK_STEP;
        while last.t < FALLBACK_TIME && t < FALLBACK_TIME {
            points.push(SpeedPoint {
                t,
                s: last.s,
                ..SpeedPoint::default()
            });
            t += FALLBACK_STEP;
        }
    }
    SpeedData::new(points)
}
