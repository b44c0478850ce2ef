//! What each kind of constraint asks of the accelerator: one function a kind. SI units; braking negative.
//!
//! Every stop has one shape: constant braking that fades linearly to nothing over the last [`EASE_TIME`]
//! seconds. From speed `v` such a stop with braking `b` takes `v²/2b + b τ²/24` metres; inside the fading part, of
//! constant jerk, braking is `2v²/3d` with `d` metres to go.

use super::SpeedConfig;

/// Gain of the free-road speed controller, 1/s.
const CRUISE_GAIN: f64 = 0.8;

/// Gain towards the speed from which one can still stop gently, 1/s.
const APPROACH_GAIN: f64 = 1.6;

/// Stops that want less braking than this share of comfortable braking can wait.
pub(super) const BRAKE_LATE: f64 = 0.6;

/// Time over which braking fades at the end of a stop, s: with gentle braking its jerk is about 1 m/s³, and what
/// is left when the wheels stand is not felt.
const EASE_TIME: f64 = 1.2;

/// With less than this left to a stop it counts as reached, m.
const OVERSHOT: f64 = 0.02;

/// Braking with which a car comes to rest that is as good as there, m/s².
const LAST_BRAKING: f64 = 0.4;

/// Who is slowing down and would roll for longer than this to a place within the restart distance stops here, s.
const CREEP_TIME: f64 = 2.0;

/// Who speeds up by less than this keeps his pace, m/s².
const AT_PACE: f64 = 0.1;

/// How much harder than needed one brakes behind a leader, so as to ease off at the end.
const MARGIN: f64 = 1.3;

/// By how much slower than a leader one lets the gap grow, m/s: from there on no more braking is worth it.
const FALL_BACK: f64 = 1.0;

/// Motion that a rule looks at.
#[derive(Clone, Copy)]
pub(super) struct Motion {
    /// Speed, m/s.
    pub v: f64,
    /// Acceleration, m/s².
    pub a: f64,
}

/// Towards speed `limit`.
pub(super) fn cruise(config: &SpeedConfig, v: f64, limit: f64) -> f64 {
    (CRUISE_GAIN * (limit - v)).clamp(-config.braking * 1.25, config.acceleration)
}

/// To a stop in `gap` metres; free as long as less than `patience` of comfortable braking would do. A standing
/// car starts again for a gap of more than `restart`, and one that slows down does not speed up for less.
pub(super) fn stop(config: &SpeedConfig, now: Motion, gap: f64, patience: f64, restart: f64) -> f64 {
    let v = now.v;
    if v <= 0.0 {
        return if gap > restart {
            config.acceleration.min(gap)
        } else {
            0.0
        };
    }
    let gentle = config.braking * patience;
    let (limit, along) = eased_approach(gap, gentle);
    if v >= limit {
        let plain = v * v / (2.0 * gap.max(OVERSHOT));
        let least = if gap <= OVERSHOT { LAST_BRAKING } else { 0.0 };
        return -eased_braking(v, gap)
            .min(plain.max(config.hard_braking))
            .max(least);
    }
    let wanted = APPROACH_GAIN * (limit - v) - along;
    let slows = now.a <= AT_PACE && gap - stopping_distance(v, gentle) < restart;
    if slows && gap < restart && gap > v * CREEP_TIME {
        -LAST_BRAKING
    } else if slows {
        wanted.min(0.0)
    } else {
        wanted
    }
}

/// How fast braking may be let go, m/s³: as fast as the eased stop asks for, with as much again to catch up.
pub(super) fn release(a: f64) -> f64 {
    -2.0 * a / EASE_TIME
}

/// Where to stop before something that is `contact` metres ahead: `wanted` metres short of it where that can be done
/// in comfort, else with what is left, but never less than the least distance.
pub(crate) fn stop_before(config: &SpeedConfig, v: f64, contact: f64, wanted: f64) -> f64 {
    let comfortable = stopping_distance(v, config.braking);
    (contact - wanted).max(comfortable.min(contact - config.least_stop_distance))
}

/// Braking of the eased stop from `v` in `gap` metres, m/s², positive.
fn eased_braking(v: f64, gap: f64) -> f64 {
    let gap = gap.max(OVERSHOT);
    if 3.0 * gap <= v * EASE_TIME {
        return 2.0 * v * v / (3.0 * gap);
    }
    let square = EASE_TIME * EASE_TIME;
    (gap - (gap * gap - v * v * square / 12.0).sqrt()) * 12.0 / square
}

/// Length of the eased stop from `v` with `braking`, m.
pub(super) fn stopping_distance(v: f64, braking: f64) -> f64 {
    if 2.0 * v <= braking * EASE_TIME {
        // v = j t²/2 and d = j t³/6.
        return v * (2.0 * v * EASE_TIME / braking).sqrt() / 3.0;
    }
    v * v / (2.0 * braking) + braking * EASE_TIME * EASE_TIME / 24.0
}

/// Speed and braking `gap` metres before the place on the eased stop with `braking`.
fn eased_approach(gap: f64, braking: f64) -> (f64, f64) {
    let gap = gap.max(0.0);
    let jerk = braking / EASE_TIME;
    if gap <= braking * EASE_TIME * EASE_TIME / 6.0 {
        let left = libm::cbrt(6.0 * gap / jerk);
        return (jerk * left * left / 2.0, jerk * left);
    }
    let square = 2.0 * braking * (gap - braking * EASE_TIME * EASE_TIME / 24.0);
    (square.sqrt(), braking)
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
    // The gap grows by itself behind a leader that is faster; nobody falls far back to have it sooner.
    let comfort = config.braking * (1.0 + closing / FALL_BACK).clamp(0.0, 1.0);
    idm.max(-comfort.max(needed * MARGIN))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONFIG: fn() -> SpeedConfig = SpeedConfig::default;

    /// Time between two steps of a test drive, s.
    const DT: f64 = 0.01;

    /// What a drive to a standstill was like.
    struct Drive {
        distance: f64,
        hardest: f64,
        last_braking: f64,
        turns: u32,
    }

    /// Drives to a stop `gap` metres ahead until it stands, with jerk as the profile limits it.
    fn drive(v: f64, gap: f64) -> Drive {
        let mut now = Motion { v, a: 0.0 };
        let mut drive = Drive {
            distance: 0.0,
            hardest: 0.0,
            last_braking: 0.0,
            turns: 0,
        };
        let (mut falling, mut extreme) = (true, 0.0_f64);
        for _ in 0..10_000 {
            let wanted = stop(&CONFIG(), now, gap - drive.distance, BRAKE_LATE, 0.3);
            let wanted = wanted.min(cruise(&CONFIG(), now.v, v));
            let jerk = if wanted < -CONFIG().hard_braking {
                20.0
            } else {
                3.0
            };
            now.a = wanted.clamp(now.a - jerk * DT, now.a + jerk * DT);
            let next = (now.v + now.a * DT).max(0.0);
            drive.distance += f64::midpoint(now.v, next) * DT;
            drive.hardest = drive.hardest.min(now.a);
            let turned = if falling { now.a - extreme } else { extreme - now.a };
            if turned > 0.1 {
                (falling, extreme, drive.turns) = (!falling, now.a, drive.turns + 1);
            } else if turned < 0.0 {
                extreme = now.a;
            }
            now.v = next;
            if now.v <= 0.02 && now.a <= 0.0 {
                drive.last_braking = -now.a;
                break;
            }
        }
        drive
    }

    #[test]
    fn a_stop_is_met_in_comfort_and_braking_has_faded_when_the_car_stands() {
        for v in [3.0, 8.0, 14.0] {
            let drive = drive(v, 120.0);
            let met = (119.7..=120.05).contains(&drive.distance);
            assert!(met, "from {v} m/s it stood after {} m", drive.distance);
            assert!(
                drive.hardest >= -CONFIG().braking * BRAKE_LATE - 0.1,
                "from {v} m/s it braked with {}",
                drive.hardest
            );
            assert!(drive.last_braking < 0.5, "{}", drive.last_braking);
        }
    }

    #[test]
    fn braking_for_a_stop_rises_once_and_fades_once() {
        for gap in [20.0, 30.0, 60.0, 120.0] {
            let turns = drive(8.0, gap).turns;
            assert_eq!(turns, 1, "{gap} m before the stop");
        }
    }

    #[test]
    fn a_stop_that_is_near_is_met_by_braking_as_hard_as_it_takes() {
        let distance = drive(10.0, 12.0).distance;
        assert!(distance <= 12.1, "{distance}");
    }

    #[test]
    fn speed_braking_and_length_of_the_eased_stop_agree() {
        for gap in [0.05, 0.2, 0.5, 3.0, 40.0] {
            let (v, along) = eased_approach(gap, 1.5);
            assert!((eased_braking(v, gap) - along).abs() < 1e-9, "{gap} m before it");
            assert!(
                (stopping_distance(v, 1.5) - gap).abs() < 1e-9,
                "{gap} m before it"
            );
        }
    }

    #[test]
    fn a_standing_car_does_not_creep() {
        let rolling = |v| Motion { v, a: -0.2 };
        assert!(stop(&CONFIG(), rolling(0.0), 0.2, BRAKE_LATE, 0.3).abs() < 1e-12);
        assert!(stop(&CONFIG(), rolling(0.0), 5.0, BRAKE_LATE, 0.3) > 0.5);
        assert!(
            stop(&CONFIG(), rolling(0.3), 1.4, BRAKE_LATE, 1.5) < -0.1,
            "it stops where it is"
        );
        assert!(
            stop(&CONFIG(), rolling(1.0), 1.4, BRAKE_LATE, 1.5) <= 0.0,
            "it does not speed up"
        );
    }

    #[test]
    fn a_slow_leader_far_away_is_approached_in_comfort_and_never_reached() {
        let (mut gap, mut v, mut hardest) = (60.0, 14.0, 0.0_f64);
        for _ in 0..6000 {
            let a = follow(&CONFIG(), v, 4.0, gap, 14.0);
            hardest = hardest.min(a);
            v = (v + a * DT).max(0.0);
            gap += (4.0 - v) * DT;
            assert!(gap > 3.0, "gap {gap}");
        }
        assert!((v - 4.0).abs() < 0.2, "settles at the leader's speed, not at {v}");
        assert!(hardest > -2.5, "{hardest}");
    }

    #[test]
    fn behind_a_leader_that_draws_away_nobody_falls_far_back() {
        let (mut gap, mut v, mut slowest) = (5.0, 8.0, 8.0_f64);
        for _ in 0..3000 {
            let a = follow(&CONFIG(), v, 6.0, gap, 14.0).max(-6.0);
            v = (v + a * DT).max(0.0);
            gap += (6.0 - v) * DT;
            slowest = slowest.min(v);
            assert!(gap > 1.0, "gap {gap}");
        }
        assert!(slowest > 4.8, "{slowest}");
    }
}
