//! `rss_lon`, `rss_lat`, `rss_dangerous`, `rss_violation`: a run against the safe distances.
//!
//! Boxes along and across the scenario's line. Dangerous is who is neither at a safe distance along it nor across it.
//! A response is due from the tick from which that holds; it is to be a braking where the distance along the line was
//! the last to become unsafe and the other one is ahead. Sampled at 10 Hz; metres and seconds.

use super::super::SAMPLE_PERIOD;
use super::super::measure::{Extreme, Measure};
use super::super::surroundings::{Body, Neighbour, Surroundings};
use super::super::view::Sample;
use super::{Lateral, RssProfile};
use corridor_decider::frame::EgoState;
use corridor_decider::frame::ObstacleId;
use std::collections::BTreeMap;

/// Slower than this a body stands, m/s (nuPlan).
const STANDS: f64 = 0.05;

/// A sample belongs to a time if it is nearer than this, s: rounding must not decide whether a response is due.
const TIME_TOLERANCE: f64 = 1e-6;

/// Gap beyond the safe distance of one pair, m; negative where unsafe.
#[derive(Clone, Copy, Debug)]
struct Margins {
    lon: f64,
    lat: f64,
}

impl Margins {
    fn is_dangerous(&self) -> bool {
        self.lon < 0.0 && self.lat < 0.0
    }
}

/// What is remembered of one obstacle.
#[derive(Clone, Copy, Debug)]
struct Danger {
    /// Whether it was not safe to the side at the last look.
    lat_unsafe: bool,
    /// Since when it has been dangerous.
    since: Option<f64>,
    /// Whether the ego has to brake for it.
    must_brake: bool,
}

/// Watches the distances.
#[derive(Clone, Debug, Default)]
pub(in super::super) struct RssWatch {
    profile: RssProfile,
    lon: Extreme,
    lat: Extreme,
    dangers: BTreeMap<ObstacleId, Danger>,
    dangerous: u32,
    violated: u32,
    /// The deepest danger and the weakest response.
    deepest: Extreme,
    weakest: Extreme,
}

impl RssWatch {
    pub(in super::super) fn new(profile: RssProfile) -> Self {
        Self {
            profile,
            ..Self::default()
        }
    }

    pub(in super::super) fn sample(&mut self, sample: &Sample, surroundings: &Surroundings) {
        let borrows = sample.plan.is_some_and(super::super::plan::Plan::borrows);
        let (mut any_danger, mut any_violation) = (false, false);
        for (ego, other) in surroundings.pairs() {
            let margins = self.margins(ego, other, borrows);
            if margins.lat < 0.0 {
                self.lon.lower(margins.lon, sample.time(), Some(other.id));
            }
            if margins.lon < 0.0 {
                self.lat.lower(margins.lat, sample.time(), Some(other.id));
            }
            if margins.is_dangerous() {
                any_danger = true;
                let depth = margins.lon.max(margins.lat);
                self.deepest.lower(depth, sample.time(), Some(other.id));
            }
            let danger = self.remember(ego, other, margins, sample.time());
            any_violation |= self.violates(danger, other.id, sample.time(), sample.ego());
        }
        self.dangerous += u32::from(any_danger);
        self.violated += u32::from(any_violation);
    }

    fn margins(&self, ego: &Body, other: &Neighbour, borrows: bool) -> Margins {
        Margins {
            lon: ego.gap_s(&other.body) - self.safe_along(ego, other, borrows),
            lat: ego.gap_l(&other.body) - self.safe_across(ego, other),
        }
    }

    fn safe_along(&self, ego: &Body, other: &Neighbour, borrows: bool) -> f64 {
        let profile = &self.profile;
        let (own, theirs) = (profile.response_time, profile.response_time_others);
        let (v, their_v) = (ego.v_s.max(0.0), other.body.v_s);
        let is_ahead = ego.is_behind(&other.body);
        if their_v < -STANDS {
            let (ego, other) = ((v, own), (-their_v, theirs));
            return match (is_ahead, borrows) {
                (false, _) => 0.0,
                (true, false) => profile.opposite_direction(ego, other),
                (true, true) => profile.opposite_direction(other, ego),
            };
        }
        let their_v = their_v.max(0.0);
        if is_ahead {
            profile.same_direction(v, their_v, own)
        } else if other.is_parked {
            0.0
        } else {
            profile.same_direction(their_v, v, theirs)
        }
    }

    fn safe_across(&self, ego: &Body, other: &Neighbour) -> f64 {
        let own = Lateral {
            v: ego.v_l,
            response: self.profile.response_time,
        };
        let theirs = Lateral {
            v: other.body.v_l,
            response: if other.is_parked {
                0.0
            } else {
                self.profile.response_time_others
            },
        };
        if ego.is_right_of(&other.body) {
            self.profile.lateral(own, theirs)
        } else {
            self.profile.lateral(theirs, own)
        }
    }

    fn remember(&mut self, ego: &Body, other: &Neighbour, margins: Margins, time: f64) -> Danger {
        let before = self.dangers.get(&other.id).copied();
        let since = before.and_then(|danger| danger.since);
        let was_beside = before.is_none_or(|danger| danger.lat_unsafe);
        let danger = Danger {
            lat_unsafe: margins.lat < 0.0,
            since: margins.is_dangerous().then(|| since.unwrap_or(time)),
            must_brake: match (since, before) {
                (Some(_), Some(danger)) => danger.must_brake,
                _ => was_beside && ego.is_behind(&other.body),
            },
        };
        self.dangers.insert(other.id, danger);
        danger
    }

    /// Whether the ego, at this moment, fails to brake as it must.
    fn violates(&mut self, danger: Danger, id: ObstacleId, time: f64, ego: &EgoState) -> bool {
        let due = self.profile.response_time - TIME_TOLERANCE;
        let is_due = danger.since.is_some_and(|since| time - since >= due);
        let missing = self.profile.min_braking + ego.a;
        let violates = is_due && danger.must_brake && ego.v > STANDS && missing > 0.0;
        if violates {
            self.weakest.raise(missing, time, Some(id));
        }
        violates
    }

    pub(in super::super) fn measures(&self) -> Vec<Measure> {
        let seconds = |samples: u32| Some(f64::from(samples) * SAMPLE_PERIOD);
        vec![
            self.lon.measure("rss_lon"),
            self.lat.measure("rss_lat"),
            self.deepest
                .measure("rss_dangerous")
                .value(seconds(self.dangerous)),
            self.weakest
                .measure("rss_violation")
                .value(seconds(self.violated)),
        ]
    }
}
