//! Whether the traffic leaves a gap in the lane to change to (the original's `IsClearToChangeLane`).
//!
//! Stations and offsets of the line into that lane, m; speeds in m/s.

use crate::geometry::angle;
use std::f64::consts::{FRAC_PI_2, PI};

/// Least gap ahead and behind among traffic of our direction, m.
const SAME_DIRECTION_GAP: f64 = 10.0;

/// Further gap per difference of speeds, s.
const SAME_DIRECTION_TIME: f64 = 3.0;

/// Least gap ahead to oncoming traffic, m.
const ONCOMING_GAP: f64 = 50.0;

/// Further gap to it per sum of speeds, s.
const ONCOMING_TIME: f64 = 5.0;

/// Gap to oncoming traffic that has passed, m.
const PASSED_GAP: f64 = 1.0;

/// Half the width of the hysteresis on a gap, m.
const HYSTERESIS: f64 = 0.5;

/// Gaps that a change of lanes needs, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SafeGaps {
    /// To who is ahead.
    pub ahead: f64,
    /// To who is behind.
    pub behind: f64,
}

/// The gaps needed to an obstacle with speed `v`, along with the ego or against it.
pub fn safe_gaps(same_direction: bool, v_ego: f64, v: f64) -> SafeGaps {
    if same_direction {
        let gap = |closing: f64| SAME_DIRECTION_GAP.max(SAME_DIRECTION_TIME * closing);
        SafeGaps {
            ahead: gap(v_ego - v),
            behind: gap(v - v_ego),
        }
    } else {
        SafeGaps {
            ahead: ONCOMING_GAP.max(ONCOMING_TIME * (v_ego + v)),
            behind: PASSED_GAP,
        }
    }
}

impl SafeGaps {
    /// Whether an obstacle so far ahead of the front bumper and so far behind the rear one is too near. Who blocked
    /// before has to be farther away to block no more.
    pub fn are_missing(&self, ahead: f64, behind: f64, blocked_before: bool) -> bool {
        let margin = if blocked_before { HYSTERESIS } else { -HYSTERESIS };
        behind < self.behind + margin && ahead < self.ahead + margin
    }
}

/// The ego of a change of lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Changer {
    /// Stations of its bumpers.
    pub station: (f64, f64),
    /// Its speed, without sign.
    pub speed: f64,
    /// Its heading, rad.
    pub heading: f64,
    /// Whether it drives backwards.
    pub is_reversing: bool,
}

/// Someone who may be in the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbour {
    /// First and last station.
    pub station: (f64, f64),
    /// Right and left edge.
    pub offset: (f64, f64),
    /// Whether it moves: whoever stands is the matter of the path.
    pub is_moving: bool,
    /// Speed.
    pub speed: f64,
    /// Where it is predicted to go, rad; along with the ego where there is no prediction.
    pub heading: Option<f64>,
    /// Whether it was in the way so far.
    pub is_blocking: bool,
}

/// Whether the ego may change lanes. `lane` gives the left and right width of the lane at a station, and nothing on a
/// line that leads into no other lane. Sets who is in the way, up to the first one.
pub fn is_clear(
    ego: &Changer,
    neighbours: &mut [Neighbour],
    lane: impl Fn(f64) -> Option<(f64, f64)>,
) -> bool {
    for neighbour in neighbours.iter_mut().filter(|neighbour| neighbour.is_moving) {
        let middle = (neighbour.station.0 + neighbour.station.1) * 0.5;
        if lane(middle).is_some_and(|width| neighbour.is_beside(width)) {
            continue;
        }
        neighbour.is_blocking = neighbour.blocks(ego);
        if neighbour.is_blocking {
            return false;
        }
    }
    true
}

impl Neighbour {
    /// Whether it is outside of a lane with this left and right width.
    pub fn is_beside(&self, (left, right): (f64, f64)) -> bool {
        self.offset.1 < -right || self.offset.0 > left
    }

    /// Whether it is too near for the ego to come before or behind it.
    pub fn blocks(&self, ego: &Changer) -> bool {
        let gaps = safe_gaps(ego.has_direction_of(self), ego.speed, self.speed);
        let (ahead, behind) = (self.station.0 - ego.station.1, ego.station.0 - self.station.1);
        gaps.are_missing(ahead, behind, self.is_blocking)
    }
}

impl Changer {
    fn has_direction_of(&self, neighbour: &Neighbour) -> bool {
        let own = if self.is_reversing {
            self.heading + PI
        } else {
            self.heading
        };
        neighbour
            .heading
            .is_none_or(|heading| angle::difference(heading, own).abs() < FRAC_PI_2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ego(speed: f64) -> Changer {
        Changer {
            station: (50.0, 55.0),
            speed,
            heading: 0.0,
            is_reversing: false,
        }
    }

    fn car(start_s: f64, speed: f64) -> Neighbour {
        Neighbour {
            station: (start_s, start_s + 5.0),
            offset: (-1.0, 1.0),
            is_moving: true,
            speed,
            heading: Some(0.0),
            is_blocking: false,
        }
    }

    fn clears(ego: &Changer, neighbour: Neighbour) -> bool {
        is_clear(ego, &mut [neighbour], |_| Some((1.75, 1.75)))
    }

    #[test]
    fn gaps_grow_with_the_speed_at_which_they_close() {
        let gap = |same, ego, other| safe_gaps(same, ego, other);
        assert_eq!(
            gap(true, 10.0, 10.0),
            SafeGaps {
                ahead: 10.0,
                behind: 10.0
            }
        );
        assert_eq!(
            gap(true, 15.0, 5.0),
            SafeGaps {
                ahead: 30.0,
                behind: 10.0
            }
        );
        assert_eq!(
            gap(true, 5.0, 15.0),
            SafeGaps {
                ahead: 10.0,
                behind: 30.0
            }
        );
        assert_eq!(
            gap(false, 10.0, 10.0),
            SafeGaps {
                ahead: 100.0,
                behind: 1.0
            }
        );
    }

    #[test]
    fn who_blocked_before_blocks_a_metre_longer() {
        assert!(clears(&ego(10.0), car(64.6, 10.0)));
        let before = Neighbour {
            is_blocking: true,
            ..car(64.6, 10.0)
        };
        assert!(!clears(&ego(10.0), before));
        assert!(!clears(&ego(10.0), car(64.4, 10.0)));
    }

    #[test]
    fn only_who_moves_in_the_lane_is_in_the_way() {
        assert!(!clears(&ego(10.0), car(52.0, 10.0)));
        assert!(clears(
            &ego(10.0),
            Neighbour {
                is_moving: false,
                ..car(52.0, 0.0)
            }
        ));
        assert!(clears(
            &ego(10.0),
            Neighbour {
                offset: (1.8, 3.8),
                ..car(52.0, 10.0)
            }
        ));
        let any_lane = is_clear(
            &ego(10.0),
            &mut [Neighbour {
                offset: (1.8, 3.8),
                ..car(52.0, 10.0)
            }],
            |_| None,
        );
        assert!(!any_lane);
    }

    #[test]
    fn oncoming_traffic_needs_more_room() {
        let oncoming = Neighbour {
            heading: Some(3.0),
            ..car(120.0, 10.0)
        };
        assert!(!clears(&ego(10.0), oncoming));
        assert!(clears(&ego(10.0), car(120.0, 10.0)));
        let reversing = Changer {
            is_reversing: true,
            ..ego(10.0)
        };
        assert!(clears(&reversing, oncoming));
    }
}
