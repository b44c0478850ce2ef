//! temporary
use crate::st_graph::{SpeedData, SpeedPoint};

pub(super) fn standstill() -> SpeedData {
    SpeedData::new((0..=30_u32).map(|k| SpeedPoint { t: f64::from(k) * 0.1, ..SpeedPoint::default() }).collect())
}

pub(super) fn ramp(mut v: f64, mut a: f64, max_deceleration: f64, jerk: (f64, f64)) -> SpeedData {
    let mut s = 0.0;
    let points = (0..=80_u32).map(|k| {
        let point = SpeedPoint { t: f64::from(k) * 0.1, s, v, a, da: 0.0 };
        a = (a + jerk.0 * 0.1).max(max_deceleration);
        let next = (v + a * 0.1).max(0.0);
        if next <= 0.0 { a = 0.0; }
        s += f64::midpoint(v, next) * 0.1;
        v = next;
        point
    });
    SpeedData::new(points.collect())
}

pub(super) fn constant_deceleration(v: f64, a: f64) -> SpeedData {
    ramp(v, a, a, (0.0, 0.0))
}

pub(super) fn extract(delta: f64, s: &[f64], v: &[f64], a: &[f64]) -> SpeedData {
    SpeedData::new((0..s.len()).map(|k| SpeedPoint { t: k as f64 * delta, s: s[k], v: v[k].max(0.0), a: a[k], da: 0.0 }).collect())
}
