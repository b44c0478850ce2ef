//! Constant braking, for when nothing else is left (the original's `BackupTrajectoryGenerator`).

use super::curve::{ConstantDeceleration, Curve};
use super::grid::HORIZON;

/// Decelerations that are tried, m/s².
pub const BACKUP_DECELERATIONS: [f64; 5] = [-0.1, -1.0, -2.0, -3.0, -4.0];

/// Braking along a lateral curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BackupPair {
    /// Braking, m/s², negative.
    pub deceleration: f64,
    /// Place of the lateral curve.
    pub lateral: usize,
    /// Speed at the horizon, m/s.
    pub end_speed: f64,
}

/// All pairs in the order in which they are tried: the gentlest braking first; where all come to stand, still the
/// gentlest, then the lateral curve that ends nearest to the line, then the shortest.
pub fn backup_order(s: f64, v: f64, laterals: &[Curve]) -> Vec<BackupPair> {
    let braking = BACKUP_DECELERATIONS
        .into_iter()
        .filter_map(|deceleration| Some((deceleration, ConstantDeceleration::new(s, v, deceleration)?)));
    let mut pairs: Vec<BackupPair> = braking
        .flat_map(|(deceleration, curve)| {
            (0..laterals.len()).map(move |lateral| BackupPair {
                deceleration,
                lateral,
                end_speed: curve.at(HORIZON)[1],
            })
        })
        .collect();
    let end = |pair: &BackupPair| {
        (
            laterals[pair.lateral].end().abs(),
            laterals[pair.lateral].length(),
        )
    };
    pairs.sort_by(|a, b| {
        let braking = b
            .end_speed
            .total_cmp(&a.end_speed)
            .then(b.deceleration.total_cmp(&a.deceleration));
        let (a, b) = (end(a), end(b));
        braking.then(a.0.total_cmp(&b.0)).then(a.1.total_cmp(&b.1))
    });
    pairs
}

/// The lateral curve that turns least away from where the car heads, over a way.
pub(super) fn straightest(laterals: &[Curve], way: f64) -> Option<usize> {
    let turning = |curve: &Curve| {
        let [_, heading, ..] = curve.at(0.0);
        let mut sum = 0.0;
        let mut p = 0.0;
        while p <= way {
            let off = curve.at(p)[1] - heading;
            sum += off * off;
            p += 1.0;
        }
        sum
    };
    let turnings: Vec<f64> = laterals.iter().map(turning).collect();
    (0..laterals.len()).min_by(|a, b| turnings[*a].total_cmp(&turnings[*b]))
}
