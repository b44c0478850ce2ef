//! `RSS_DECIDER`: whether the gap to the nearest obstacle ahead is safe in the sense of Responsibility-Sensitive
//! Safety (Shalev-Shwartz et al. 2017), and which accelerations are left.
//!
//! Same direction, ego behind. Stations and offsets are those of the reference line, `l` positive to the left; lateral
//! speeds are taken as 0. Values and rules of the response are those of the ad-rss library as the original drives it.
//! Against the original: an obstacle that straddles the line is seen; the lateral range that is restricted is the one
//! towards the obstacle, not the other one; a negative speed counts as 0 instead of failing.

mod task;

pub use task::run;

/// What is said where nothing is ahead, m.
const NOTHING_AHEAD: f64 = 3000.0;

/// Largest acceleration while responding, m/s².
const ACCELERATION: f64 = 3.5;

/// Hardest braking anyone may do, m/s².
const HARDEST_BRAKING: f64 = 8.0;

/// Braking that everyone does in danger, m/s².
const LEAST_BRAKING: f64 = 4.0;

/// Largest lateral acceleration while responding, m/s².
const LATERAL_ACCELERATION: f64 = 0.2;

/// Lateral braking that everyone does in danger, m/s².
const LATERAL_BRAKING: f64 = 0.8;

/// The library's lateral braking without limit, as no hardest one is configured, m/s².
const UNLIMITED: f64 = 1000.0;

/// Time until the ego and others respond, s.
const RESPONSE: (f64, f64) = (1.0, 2.0);

/// A body in the Frenet frame of the line, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RssBox {
    /// First and last station.
    pub station: (f64, f64),
    /// Right and left edge.
    pub offset: (f64, f64),
}

/// Someone who may be ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RssObstacle {
    /// Where.
    pub place: RssBox,
    /// Speed, m/s.
    pub speed: f64,
    /// Whether some of it is on the lane ([`is_on_lane`]).
    pub is_on_lane: bool,
}

/// An interval of accelerations, m/s².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AccelerationRange {
    /// The lowest.
    pub min: f64,
    /// The highest.
    pub max: f64,
}

/// What RSS says about a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RssState {
    /// Whether the gap is longer than the safe distance.
    pub is_safe: bool,
    /// Gap to the nearest obstacle ahead, m.
    pub gap: f64,
    /// The safe distance, m.
    pub safe_distance: f64,
    /// Accelerations that are left along the line.
    pub longitudinal: AccelerationRange,
    /// Those to the left.
    pub left: AccelerationRange,
    /// Those to the right.
    pub right: AccelerationRange,
}

const FREE: AccelerationRange = AccelerationRange {
    min: -HARDEST_BRAKING,
    max: ACCELERATION,
};

const BRAKING: AccelerationRange = AccelerationRange {
    min: -HARDEST_BRAKING,
    max: -LEAST_BRAKING,
};

const FREE_ASIDE: AccelerationRange = AccelerationRange {
    min: -LATERAL_BRAKING,
    max: LATERAL_ACCELERATION,
};

const BRAKING_ASIDE: AccelerationRange = AccelerationRange {
    min: -UNLIMITED,
    max: -LATERAL_BRAKING,
};

/// Whether some of a body is on a lane whose left and right edges are so far from the line.
pub fn is_on_lane(offset: (f64, f64), left_width: f64, right_width: f64) -> bool {
    offset.0 < left_width && offset.1 > -right_width
}

/// Judges the gap to the nearest obstacle ahead of the ego.
pub fn assess(ego: RssBox, ego_speed: f64, obstacles: &[RssObstacle]) -> RssState {
    let gap = |obstacle: &RssObstacle| obstacle.place.station.0 - ego.station.1;
    let ahead = obstacles.iter().filter(|obstacle| {
        let is_ahead = obstacle.place.station.1 > ego.station.0 && gap(obstacle) > 0.0;
        obstacle.is_on_lane && is_ahead && gap(obstacle) < NOTHING_AHEAD
    });
    let Some(nearest) = ahead.min_by(|a, b| gap(a).total_cmp(&gap(b)).then(a.speed.total_cmp(&b.speed)))
    else {
        return RssState {
            is_safe: true,
            gap: NOTHING_AHEAD,
            safe_distance: NOTHING_AHEAD,
            longitudinal: FREE,
            left: FREE_ASIDE,
            right: FREE_ASIDE,
        };
    };
    let safe_distance = safe_distance(ego_speed.max(0.0), nearest.speed.max(0.0));
    let is_safe = gap(nearest) > safe_distance;
    let (left, right) = if is_safe {
        (false, false)
    } else {
        threatened_sides(ego.offset, nearest.place.offset)
    };
    let aside = |threatened| if threatened { BRAKING_ASIDE } else { FREE_ASIDE };
    RssState {
        is_safe,
        gap: gap(nearest),
        safe_distance,
        // Who keeps clear aside need not brake.
        longitudinal: if left || right { BRAKING } else { FREE },
        left: aside(left),
        right: aside(right),
    }
}

/// The distance at which who drives behind can still stop when who drives ahead brakes as hard as possible, m.
pub fn safe_distance(v_rear: f64, v_front: f64) -> f64 {
    let t = RESPONSE.0;
    let v = v_rear + ACCELERATION * t;
    let to_stop = v_rear * t + 0.5 * ACCELERATION * t * t + v * v / (2.0 * LEAST_BRAKING);
    (to_stop - v_front * v_front / (2.0 * HARDEST_BRAKING)).max(0.0)
}

/// The distance aside that two at rest keep, should both be about to move towards each other, m.
fn safe_distance_aside() -> f64 {
    let moved = |t: f64| {
        let v = LATERAL_ACCELERATION * t;
        0.5 * LATERAL_ACCELERATION * t * t + v * v / (2.0 * LATERAL_BRAKING)
    };
    moved(RESPONSE.0) + moved(RESPONSE.1)
}

/// To which sides of the ego, left and right, an obstacle is too near: both when one is within the width of the other.
fn threatened_sides(ego: (f64, f64), other: (f64, f64)) -> (bool, bool) {
    let gap = (other.0 - ego.1).max(ego.0 - other.1);
    let is_left = other.0 > ego.0 && other.1 > ego.1;
    let is_right = other.0 < ego.0 && other.1 < ego.1;
    if gap > safe_distance_aside() {
        (false, false)
    } else if is_left || is_right {
        (is_left, is_right)
    } else {
        (true, true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EGO: RssBox = RssBox {
        station: (0.0, 5.0),
        offset: (-1.0, 1.0),
    };

    fn obstacle(start_s: f64, offset: (f64, f64), speed: f64) -> RssObstacle {
        RssObstacle {
            place: RssBox {
                station: (start_s, start_s + 4.0),
                offset,
            },
            speed,
            is_on_lane: is_on_lane(offset, 1.75, 1.75),
        }
    }

    #[test]
    fn safe_distances_are_those_of_the_library() {
        let cases = [
            (10.0, 10.0, 28.281),
            (10.0, 0.0, 34.531),
            (20.0, 15.0, 76.719),
            (0.0, 0.0, 3.281),
        ];
        for (rear, front, wanted) in cases {
            let got = safe_distance(rear, front);
            assert!((got - wanted).abs() < 1e-3, "{rear} behind {front}: {got}");
        }
    }

    #[test]
    fn a_short_gap_asks_for_braking_and_a_long_one_for_nothing() {
        let near = assess(EGO, 10.0, &[obstacle(30.0, (-0.5, 0.5), 10.0)]);
        assert!(!near.is_safe);
        assert_eq!(
            (near.longitudinal, near.left, near.right),
            (BRAKING, BRAKING_ASIDE, BRAKING_ASIDE)
        );
        let far = assess(EGO, 10.0, &[obstacle(34.0, (-0.5, 0.5), 10.0)]);
        assert!(far.is_safe && far.longitudinal == FREE);
    }

    #[test]
    fn the_side_of_the_obstacle_is_the_one_restricted() {
        let left = assess(EGO, 10.0, &[obstacle(10.0, (1.2, 2.0), 0.0)]);
        assert_eq!((left.left, left.right), (BRAKING_ASIDE, FREE_ASIDE));
        let right = assess(EGO, 10.0, &[obstacle(10.0, (-2.0, -1.2), 0.0)]);
        assert_eq!((right.left, right.right), (FREE_ASIDE, BRAKING_ASIDE));
        let aside = assess(EGO, 10.0, &[obstacle(10.0, (1.65, 2.0), 0.0)]);
        assert!(
            !aside.is_safe && aside.longitudinal == FREE,
            "0.65 m beside is far enough"
        );
    }

    #[test]
    fn the_nearest_one_counts_in_any_order() {
        let three = [
            obstacle(60.0, (-0.5, 0.5), 3.0),
            obstacle(20.0, (-0.2, 1.0), 9.0),
            obstacle(10.0, (5.0, 7.0), 0.0),
        ];
        let mut turned = three;
        turned.reverse();
        let state = assess(EGO, 12.0, &three);
        assert!((state.gap - 15.0).abs() < 1e-12);
        assert_eq!(state, assess(EGO, 12.0, &turned));
        assert!((assess(EGO, 12.0, &[]).gap - 3000.0).abs() < 1e-12);
        assert!(assess(EGO, -0.2, &three).is_safe, "rolling back is standing");
    }
}
