//! `delta_v`, `impact_energy`: how hard the hardest contact was.
//!
//! Both bodies have the same mass and stay together, as nuPlan reckons: the ego then loses half of the difference of
//! the velocities. SI units, energy in kJ.

use super::measure::{Extreme, Measure};
use crate::verdict::Collision;
use corridor_decider::frame::ObstacleId;

/// Mass of either body, kg (nuPlan).
const MASS: f64 = 2000.0;

/// The measures of the hardest of these contacts; `touched` are their obstacles.
pub(super) fn measures(collisions: &[Collision], touched: &[ObstacleId]) -> Vec<Measure> {
    let mut hardest = Extreme::default();
    for (collision, id) in collisions.iter().zip(touched) {
        hardest.raise(collision.delta_v, collision.time, Some(*id));
    }
    let lost = hardest.value.map(|relative| relative / 2.0);
    let reduced_mass = MASS / 2.0;
    let energy = hardest
        .value
        .map(|relative| 0.5 * reduced_mass * relative * relative / 1000.0);
    vec![
        hardest.measure("delta_v").value(lost),
        hardest.measure("impact_energy").value(energy),
    ]
}
