//! Quintic candidates: from the ego's lateral state to several offsets at several distances.
//!
//! The original lattice planner samples ends at fixed offsets of the line; here they are fractions of the
//! corridor, and every candidate is clamped to the corridor point by point.

use super::corridor::Corridor;
use super::profile::Profile;
use super::table::STEP;
use crate::geometry::Quintic;

/// Where candidates end, m ahead (the original's lateral bundle).
const DISTANCES: [f64; 4] = [10.0, 20.0, 40.0, 80.0];

/// Where in the corridor candidates end, from its right to its left limit. The last station of a candidate's
/// distance rules.
const FRACTIONS: [f64; 5] = [0.5, 0.25, 0.75, 0.05, 0.95];

/// All candidates of a corridor.
pub(super) fn sample(corridor: &Corridor) -> Vec<Profile> {
    let mut profiles = Vec::with_capacity(DISTANCES.len() * (FRACTIONS.len() + 1));
    let reach = (corridor.len() - 1) as f64 * STEP;
    for distance in DISTANCES.into_iter().filter(|distance| *distance <= reach) {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number below 100"
        )]
        let k = (distance / STEP) as usize;
        let (lo, hi) = corridor.limits[k];
        let inside = corridor.pulls[k].l.clamp(lo, hi);
        let ends = FRACTIONS.map(|fraction| lo + (hi - lo) * fraction);
        for end in ends.into_iter().chain([inside]) {
            profiles.push(profile(corridor, end, distance));
        }
    }
    profiles
}

fn profile(corridor: &Corridor, end: f64, distance: f64) -> Profile {
    let curve = Quintic::between(corridor.start, [end, 0.0, 0.0], distance);
    let offsets: Vec<f64> = corridor
        .limits
        .iter()
        .zip(&corridor.tolerance)
        .enumerate()
        .map(|(k, ((lo, hi), tolerance))| {
            curve.evaluate(k as f64 * STEP)[0]
                .max(lo - tolerance)
                .min(hi + tolerance)
        })
        .collect();
    Profile::from_offsets(&offsets, corridor.start)
}
