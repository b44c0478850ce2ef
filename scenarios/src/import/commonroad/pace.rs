//! How fast to drive so as to be at the goal when it counts.
//!
//! A goal asks for a time as well as for a place. The decider knows only a speed to drive where nothing limits it;
//! this is the one that brings the ego from its start into the goal's stretch of lane within the goal's time.

use super::route::{Step, station};
use crate::goal::{GoalRegion, GoalState};
use corridor_decider::geometry::Vec2;
use corridor_decider::road::{LaneId, RoadMap};
use std::collections::BTreeMap;

/// Slowest and fastest speed asked for, m/s: walking pace, and 180 km/h.
const SPEEDS: (f64, f64) = (1.5, 50.0);

/// How far inside its stretch the goal is aimed at, m, and as a share of the stretch where that is short.
const INSIDE: (f64, f64) = (5.0, 0.25);

/// Share of the time that is left for the way, the rest is for lags; and what getting off to a start takes, s.
const IN_TIME: (f64, f64) = (0.9, 0.5);

/// Shorter stretches are where a lane touches the goal's place, m; they count where there is no other.
const TOUCHES: f64 = 2.0;

/// How far below the goal's largest speed to drive, m/s.
const BELOW: f64 = 0.3;

/// First and last station of each lane at which its middle is in one of the goal's places, m. A goal beside the
/// middle of all lanes is in the lanes it lies on.
pub(super) fn stretches(map: &RoadMap, goal: &GoalRegion) -> BTreeMap<LaneId, (f64, f64)> {
    let mut found = BTreeMap::new();
    let placed: Vec<&GoalState> = goal
        .alternatives
        .iter()
        .filter(|goal| !goal.areas.is_empty())
        .collect();
    for (id, lane) in (0..).map(LaneId).zip(map.lanes()) {
        let is_in = |point: Vec2| placed.iter().any(|goal| goal.is_in_place(point));
        let mut inside = lane.points.iter().filter(|p| is_in(p.offset(0.0))).map(|p| p.s);
        if let Some(first) = inside.next().filter(|_| lane.kind.is_drivable()) {
            found.insert(id, (first, inside.next_back().unwrap_or(first)));
        }
    }
    if found.values().any(|(first, last)| last - first >= TOUCHES) {
        found.retain(|_, (first, last)| *last - *first >= TOUCHES);
    }
    if !found.is_empty() {
        return found;
    }
    for area in placed.iter().flat_map(|goal| &goal.areas) {
        for (lane, _) in map.lanes_at(area.middle()) {
            let s = station(map, lane, area.middle());
            found.insert(lane, (s, s));
        }
    }
    found
}

/// What the speed depends on.
pub(super) struct Pace<'a> {
    pub(super) map: &'a RoadMap,
    pub(super) way: &'a [Step],
    /// Middle of the ego at the start.
    pub(super) start: Vec2,
    /// The goal's stretch on the last lane of the way.
    pub(super) stretch: Option<(f64, f64)>,
    /// Acceleration of the ego, m/s².
    pub(super) acceleration: f64,
}

impl Pace<'_> {
    /// The speed of now where that will do, else the nearest that does, m/s.
    pub(super) fn cruise_speed(&self, now: f64, goal: &GoalRegion) -> f64 {
        let Some(goal) = goal.alternatives.first() else {
            return now.clamp(SPEEDS.0, SPEEDS.1);
        };
        let mut speed = now;
        if let Some((near, far)) = self.distances() {
            let (early, late) = (goal.time.0.max(0.0), goal.time.1);
            if early > 0.0 {
                speed = speed.min(far.max(0.0) / early);
            }
            if near > now * late {
                let in_time = (IN_TIME.0 * late - IN_TIME.1).max(early);
                speed = speed_to_cover(near, in_time, now, self.acceleration);
            }
        }
        if let Some((low, high)) = goal.speed {
            speed = speed.min(high - BELOW).max(low);
        }
        speed.clamp(SPEEDS.0, SPEEDS.1)
    }

    /// From the start to where the goal's stretch begins and ends, m, a little inside of it.
    fn distances(&self) -> Option<(f64, f64)> {
        let (first, last) = self.stretch?;
        let mut before = -station(self.map, self.way.first()?.lane, self.start);
        for (from, to) in self.way.iter().zip(self.way.get(1..)?) {
            let lane = self.map.lane(from.lane);
            before += lane.length();
            if to.change.is_some() {
                // A change goes to the same place of the lane beside.
                let end = lane.at(lane.length()).offset(0.0);
                before -= station(self.map, to.lane, end);
            }
        }
        let inside = INSIDE.0.min(INSIDE.1 * (last - first));
        Some((before + first + inside, before + last - inside))
    }
}

/// The speed that, reached from `now` at constant acceleration and then kept, covers `distance` in `time`.
/// Where none does: the one that the whole time of accelerating leads to.
fn speed_to_cover(distance: f64, time: f64, now: f64, acceleration: f64) -> f64 {
    let (d, t, a) = (distance, time.max(0.0), acceleration);
    if d <= now * t {
        return if t > 0.0 { d / t } else { now };
    }
    let rest = a * a * t * t - 2.0 * a * (d - now * t);
    now + a * t - rest.max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The oracle drives: small steps of accelerating up to the speed and keeping it.
    #[test]
    fn the_speed_covers_the_distance_in_the_time() {
        for (distance, time, now) in [
            (45.0, 10.0, 0.0),
            (60.0, 5.0, 10.0),
            (30.0, 6.0, 8.0),
            (5.0, 1.0, 4.0),
        ] {
            let wanted = speed_to_cover(distance, time, now, 2.0);
            let (mut way, mut v) = (0.0, if wanted < now { wanted } else { now });
            for _ in 0..100_000 {
                v = f64::min(v + 2.0 * time * 1e-5, wanted.max(v));
                way += v * time * 1e-5;
            }
            assert!(
                (way - distance).abs() < 0.01,
                "{distance} in {time}: {way} at {wanted}"
            );
        }
        assert!(
            (speed_to_cover(1000.0, 2.0, 3.0, 2.0) - 7.0).abs() < 1e-12,
            "as fast as it gets"
        );
    }
}
