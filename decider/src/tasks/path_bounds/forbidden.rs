//! Which lateral positions of the rear axle the obstacles forbid, and where along the bound.
//!
//! A widened obstacle forbids one interval of `l` at the stations beside it. Frame: the reference line.

use super::bound::BoundPoint;
use super::input::Input;
use super::obstacles::{Beside, Widening};
use crate::frame::ObstacleId;
use crate::road::Side;
use std::ops::Range;

/// How near to its own place the ego keeps a relaxed limit, m.
const EGO_SLACK: f64 = 0.02;

/// A widened obstacle in terms of the rear axle: the interval of `l` that it forbids.
#[derive(Clone, Copy, Debug)]
pub(super) struct Forbidden {
    pub id: ObstacleId,
    /// Near edge of the obstacle itself, m.
    pub start_s: f64,
    pub first: usize,
    pub past: usize,
    pub l_min: f64,
    pub l_max: f64,
    pub remembered: Option<Side>,
    /// The only side left to an ego that is beside it.
    pub only: Option<Side>,
}

impl Forbidden {
    /// On which side of it a gap lies whose right limit is `right`.
    pub(super) fn side_of(&self, right: f64) -> Side {
        if self.l_max <= right {
            Side::Left
        } else {
            Side::Right
        }
    }
}

/// What each obstacle forbids, by first station.
pub(super) fn intervals(input: &Input, beside: &[Beside], widening: Widening) -> Vec<Forbidden> {
    let mut all = Vec::with_capacity(beside.len());
    all.extend(
        beside
            .iter()
            .filter_map(|obstacle| forbidden_by(obstacle, input, widening)),
    );
    all
}

/// What one obstacle forbids, if that is anything.
fn forbidden_by(obstacle: &Beside, input: &Input, widening: Widening) -> Option<Forbidden> {
    let half_width = input.vehicle.half_width();
    let right = obstacle.start_l.min(obstacle.end_l);
    let left = obstacle.start_l.max(obstacle.end_l);
    let (mut buffer_right, mut buffer_left) = (widening.lateral, widening.lateral);
    let mut only = None;
    if obstacle.first == 0 {
        // Beside the ego the buffer gives way rather than demand a jump, and the side is chosen.
        let kept = |room: f64| {
            (room - half_width - EGO_SLACK)
                .max(widening.hard.min(widening.lateral))
                .min(widening.lateral)
        };
        let (room_left, room_right) = (input.ego.l - left, right - input.ego.l);
        (buffer_right, buffer_left) = (kept(room_right), kept(room_left));
        only = match (room_left >= 0.0, room_right >= 0.0) {
            (true, _) => Some(Side::Left),
            (_, true) => Some(Side::Right),
            _ => None,
        };
    }
    let l_min = right - half_width - buffer_right;
    let l_max = left + half_width + buffer_left;
    (l_min < l_max).then_some(Forbidden {
        id: obstacle.id,
        start_s: obstacle.start_s,
        first: obstacle.first,
        past: obstacle.past,
        l_min,
        l_max,
        remembered: obstacle.remembered,
        only,
    })
}

/// The obstacles beside one station, moved along the bound.
pub(super) struct Active<'a> {
    /// By ascending right edge.
    pub beside: Vec<&'a Forbidden>,
    /// The next station at which an obstacle begins or ends.
    pub next_change: usize,
    /// All that matter, by first station.
    all: Vec<&'a Forbidden>,
    /// Those of `all` that begin at the station.
    begun: Range<usize>,
}

impl<'a> Active<'a> {
    /// All that narrow the bound somewhere, or that the ego is beside: what lies outside changes no gap.
    pub(super) fn of(all: &'a [Forbidden], bound: &[BoundPoint]) -> Self {
        let (mut right, mut left) = (f64::MAX, -f64::MAX);
        for point in bound {
            right = if point.l_min < right { point.l_min } else { right };
            left = if point.l_max > left { point.l_max } else { left };
        }
        let matters = |o: &&Forbidden| (o.l_max > right && o.l_min < left) || o.only.is_some();
        let mut relevant = Vec::with_capacity(all.len());
        relevant.extend(all.iter().filter(matters));
        Self {
            beside: Vec::with_capacity(relevant.len()),
            next_change: 0,
            all: relevant,
            begun: 0..0,
        }
    }

    pub(super) fn move_to(&mut self, station: usize) {
        self.begun.start = self.begun.end;
        if station < self.next_change {
            return;
        }
        self.beside.retain(|obstacle| obstacle.past > station);
        let ahead = &self.all[self.begun.start..];
        for obstacle in ahead.iter().take_while(|obstacle| obstacle.first <= station) {
            let before = self
                .beside
                .iter()
                .rposition(|other| other.l_min <= obstacle.l_min);
            self.beside.insert(before.map_or(0, |place| place + 1), obstacle);
            self.begun.end += 1;
        }
        let next = self
            .all
            .get(self.begun.end)
            .map_or(usize::MAX, |obstacle| obstacle.first);
        let ends = self.beside.iter().map(|obstacle| obstacle.past);
        self.next_change = ends.fold(next, usize::min);
    }

    /// Those that begin at the station.
    pub(super) fn begun(&self) -> &[&'a Forbidden] {
        &self.all[self.begun.clone()]
    }
}
