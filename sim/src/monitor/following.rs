//! `ssm_ttc`, `drac`, `mdrac_count`: how near the ego comes to running into what is ahead of it.
//!
//! SUMO's surrogate safety measures of following, with SUMO's thresholds. Ahead is what lies in the strip along the
//! line that the ego's front covers; who passes beside it is not. SI units.

use super::measure::{Extreme, Measure};
use super::surroundings::{Ahead, Surroundings};
use corridor_decider::frame::ObstacleId;
use std::collections::BTreeSet;

/// Smallest good time to collision, s (SUMO SSM).
pub(super) const TTC_LIMIT: f64 = 3.0;

/// Largest good deceleration to avoid a crash, m/s² (SUMO SSM).
pub(super) const DRAC_LIMIT: f64 = 3.0;

/// The same after the reaction time, m/s² (SUMO SSM, `MDRAC`).
const MDRAC_LIMIT: f64 = 3.4;

/// Perception and reaction time, s (SUMO SSM, `mdrac.prt`).
const REACTION: f64 = 1.0;

/// Watches what is ahead.
#[derive(Clone, Debug, Default)]
pub(super) struct FollowingWatch {
    ttc: Extreme,
    drac: Extreme,
    /// Those that needed too much after the reaction time, and when the last of them first did.
    critical: BTreeSet<ObstacleId>,
    last_critical: Option<(f64, ObstacleId)>,
}

impl FollowingWatch {
    pub(super) fn sample(&mut self, time: f64, surroundings: &Surroundings) {
        for ahead in surroundings.ahead().filter(|ahead| ahead.closing > 0.0) {
            self.ttc.lower(ahead.gap / ahead.closing, time, Some(ahead.id));
            self.drac.raise(drac(&ahead), time, Some(ahead.id));
            if mdrac(&ahead).is_none_or(|needed| needed > MDRAC_LIMIT) && self.critical.insert(ahead.id) {
                self.last_critical = Some((time, ahead.id));
            }
        }
    }

    pub(super) fn measures(&self) -> Vec<Measure> {
        let critical = Measure::new("mdrac_count", Some(self.critical.len() as f64));
        vec![
            self.ttc.measure("ssm_ttc"),
            self.drac.measure("drac"),
            critical
                .at(self.last_critical.map(|(time, _)| time))
                .with(self.last_critical.map(|(_, id)| id)),
        ]
    }
}

/// Deceleration that just avoids the crash, begun now.
fn drac(ahead: &Ahead) -> f64 {
    ahead.closing * ahead.closing / (2.0 * ahead.gap)
}

/// The same begun after the reaction time; `None`: it is over by then.
fn mdrac(ahead: &Ahead) -> Option<f64> {
    let rest = ahead.gap - ahead.closing * REACTION;
    (rest > 0.0).then(|| ahead.closing * ahead.closing / (2.0 * rest))
}
