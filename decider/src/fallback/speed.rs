//! The ladder of speed profiles that only stop, gentlest first.

use crate::decision::SpeedRung;
use crate::planner::LinePlan;
use crate::st_graph::{SpeedData, SpeedPoint};
use crate::tasks::path::Path;
use crate::vehicle::VehicleParams;

/// Where a stop on a path has to end at the latest, m along it.
pub(super) fn target(plan: &LinePlan, path: &Path) -> Option<f64> {
    let wall = plan.wall.map_or(path.length(), |wall| wall.distance);
    Some(wall.min(path.length()))
}

/// A profile from `v`, `a` to a standstill.
pub(super) fn stopping(v: f64, a: f64, vehicle: &VehicleParams, _target: Option<f64>) -> (SpeedRung, SpeedData) {
    let (mut v, mut a, mut s) = (v, a, 0.0);
    let points = (0..=80_u32).map(|k| {
        let point = SpeedPoint { t: f64::from(k) * 0.1, s, v, a, da: 0.0 };
        a = (a - 2.0).max(vehicle.max_deceleration);
        let next = (v + a * 0.1).max(0.0);
        if next <= 0.0 { a = 0.0; }
        s += f64::midpoint(v, next) * 0.1;
        v = next;
        point
    });
    (SpeedRung::Ramp, SpeedData::new(points.collect()))
}
