//! What each kind of constraint asks of the accelerator: one function a kind. SI units; braking negative.

use super::SpeedConfig;

/// Gain of the free-road speed controller, 1/s.
const CRUISE_GAIN: f64 = 0.8;

/// Gain towards the speed from which one can still stop gently, 1/s.
const APPROACH_GAIN: f64 = 1.6;

/// Stops that want less braking than this share of comfortable braking can wait.
pub(super) const BRAKE_LATE: f64 = 0.6;

/// With less than this left to a stop it counts as reached, m.
const OVERSHOT: f64 = 0.01;

/// How much harder than needed one brakes at first, so as to ease off at the end: braking falls with this power
/// of the way left, less one.
const EASE: f64 = 1.3;

/// Towards a leader that is far enough away nobody brakes harder than this share of comfortable braking.
const UNHURRIED: f64 = 1.0;

/// Towards speed `limit`.
pub(super) fn cruise(config: &SpeedConfig, v: f64, limit: f64) -> f64 {
    (CRUISE_GAIN * (limit - v)).clamp(-config.braking * 1.25, config.acceleration)
}

/// To a stop in `gap` metres; free as long as less than `patience` of comfortable braking would do. A standing
/// car starts again for a gap of more than `restart`.
pub(super) fn stop(config: &SpeedConfig, v: f64, gap: f64, patience: f64, restart: f64) -> f64 {
    if v <= 0.0 {
        return if gap > restart {
            config.acceleration.min(gap)
        } else {
            0.0
        };
    }
    if gap <= OVERSHOT {
        return -config.braking;
    }
    let gentle = config.braking * patience;
    let needed = v * v / (2.0 * gap);
    if needed < gentle {
        // Towards a near stop, the speed from which one can still stop gently is the limit.
        return (APPROACH_GAIN * ((2.0 * gentle * gap).sqrt() - v)).max(0.0);
    }
    let eased = needed * EASE;
    -if eased < config.hard_braking {
        eased
    } else {
        needed.max(config.hard_braking)
    }
}

/// Behind a leader `gap` metres ahead: the Intelligent Driver Model, which brakes harder than comfort only as
/// far as the laws of motion ask for it.
pub(super) fn follow(config: &SpeedConfig, v: f64, v_leader: f64, gap: f64, cruise_speed: f64) -> f64 {
    let gap = gap.max(0.1);
    let closing = v - v_leader;
    let dynamic = v * closing / (2.0 * (config.acceleration * config.braking).sqrt());
    let wanted = config.follow_distance + (v * config.follow_time + dynamic).max(0.0);
    let free = (v / cruise_speed.max(1.0)).min(1.0);
    let ratio = wanted / gap;
    let idm = config.acceleration * (1.0 - free * free * free * free - ratio * ratio);
    let room = (gap - config.least_stop_distance).max(0.1);
    let needed = if closing > 0.0 {
        closing * closing / (2.0 * room)
    } else {
        0.0
    };
    idm.max(-(config.braking * UNHURRIED).max(needed * EASE))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONFIG: fn() -> SpeedConfig = SpeedConfig::default;

    /// Drives by a rule from `v` until it stands; the distance driven and the hardest braking.
    fn drive(mut v: f64, rule: impl Fn(f64, f64) -> f64) -> (f64, f64) {
        let (mut distance, mut hardest) = (0.0, 0.0_f64);
        for _ in 0..20_000 {
            let a = rule(v, distance);
            hardest = hardest.min(a);
            let next = (v + a * 0.01).max(0.0);
            distance += f64::midpoint(v, next) * 0.01;
            v = next;
            if v <= 0.0 {
                break;
            }
        }
        (distance, hardest)
    }

    #[test]
    fn a_stop_is_met_and_braking_stays_comfortable() {
        for v in [3.0, 8.0, 14.0] {
            let (distance, hardest) = drive(v, |v, d| stop(&CONFIG(), v, 120.0 - d, BRAKE_LATE, 0.3));
            assert!(
                (119.7..=120.01).contains(&distance),
                "from {v} m/s it stood after {distance} m"
            );
            assert!(
                hardest >= -CONFIG().braking,
                "from {v} m/s it braked with {hardest}"
            );
        }
    }

    #[test]
    fn a_stop_that_is_near_is_met_by_braking_as_hard_as_it_takes() {
        let (distance, _) = drive(10.0, |v, d| stop(&CONFIG(), v, 12.0 - d, BRAKE_LATE, 0.3));
        assert!(distance <= 12.05, "{distance}");
    }

    #[test]
    fn a_standing_car_does_not_creep() {
        assert!(stop(&CONFIG(), 0.0, 0.2, BRAKE_LATE, 0.3).abs() < 1e-12);
        assert!(stop(&CONFIG(), 0.0, 5.0, BRAKE_LATE, 0.3) > 0.5);
    }

    #[test]
    fn a_slow_leader_far_away_is_approached_in_comfort_and_never_reached() {
        let (mut gap, mut v, mut hardest) = (60.0, 14.0, 0.0_f64);
        for _ in 0..6000 {
            let a = follow(&CONFIG(), v, 4.0, gap, 14.0);
            hardest = hardest.min(a);
            v = (v + a * 0.01).max(0.0);
            gap += (4.0 - v) * 0.01;
            assert!(gap > 3.0, "gap {gap}");
        }
        assert!((v - 4.0).abs() < 0.2, "settles at the leader's speed, not at {v}");
        assert!(hardest > -2.5, "{hardest}");
    }
}
