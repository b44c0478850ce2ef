//! `fallback_speed.*` and `speed_profile.*`: profiles for when a task has failed.

use super::compare::agree;
use super::{SpeedCase, rows};
use corridor_decider::fallback::speed_profile::{constant_deceleration, extract, standstill};
use serde::Deserialize;
use serde_json::json;

/// The original's braking, m/s².
const DECELERATION: f64 = -4.0;

/// Time between two points, s.
const STEP: f64 = 0.1;

pub(super) fn check(case: &SpeedCase, function: &str) -> Result<(), String> {
    match function {
        "constant_deceleration" => constant(case),
        "extract" => extracted(case),
        "fixed_distance_creep" => creep(case),
        _ => Err(case.unknown()),
    }
}

#[derive(Deserialize)]
struct Start {
    init_v: f64,
    init_a: f64,
}

fn constant(case: &SpeedCase) -> Result<(), String> {
    let asked: Start = case.input()?;
    let expected: Vec<[f64; 5]> =
        Deserialize::deserialize(&case.expected).map_err(|error| format!("expected: {error}"))?;
    let stands = asked.init_v <= 0.0 && asked.init_a <= 0.0;
    let profile = if stands {
        standstill()
    } else {
        constant_deceleration(asked.init_v, asked.init_a, DECELERATION)
    };
    let got = rows(&profile);
    let end = got[got.len() - 1];
    if got.len() < expected.len() {
        return Err(format!(
            "expected {} points or more, got {}",
            expected.len(),
            got.len()
        ));
    }
    for (k, (wanted, got)) in expected.iter().zip(&got).enumerate() {
        // The original's times add up in the same way.
        let is_moving = k == 0 || wanted[2] > 0.0;
        let wanted = if is_moving && wanted[2] >= 0.0 {
            *wanted
        } else {
            [wanted[0], end[1], 0.0, got[3], 0.0]
        };
        let alike = wanted.iter().zip(got).all(|(wanted, got)| agree(*wanted, *got));
        if !(alike || k > 0 && !is_moving && end[1] - got[1] <= 0.0) {
            return Err(format!("[{k}]: expected {wanted:?}, got {got:?}"));
        }
        if !is_moving && got[3] != 0.0 {
            return Err(format!("[{k}]: it brakes at rest: {got:?}"));
        }
    }
    let exact = asked.init_v.max(0.0) * asked.init_v.max(0.0) / (-2.0 * DECELERATION);
    if agree(exact, end[1]) && end[2] == 0.0 && end[3] == 0.0 {
        Ok(())
    } else {
        Err(format!("it has to stand at {exact} m and ends with {end:?}"))
    }
}

#[derive(Deserialize)]
struct Knots {
    delta: f64,
    opt_s: Vec<f64>,
    opt_v: Vec<f64>,
    opt_a: Vec<f64>,
}

fn extracted(case: &SpeedCase) -> Result<(), String> {
    let asked: Knots = case.input()?;
    case.expect(&json!(rows(&extract(
        &asked.opt_s,
        &asked.opt_v,
        &asked.opt_a,
        asked.delta
    ))))
}

#[derive(Deserialize)]
struct Creep {
    distance: f64,
    max_speed: f64,
}

/// The original's creep: braking would begin at `distance + v²/1.6` (with a minus, that far *beyond* the end), so it
/// never does, and the profile drives on at the same speed until there.
fn creep(case: &SpeedCase) -> Result<(), String> {
    const CREEP_SPEED: f64 = 2.23;
    let asked: Creep = case.input()?;
    let v = asked.max_speed.min(CREEP_SPEED);
    let (mut t, mut s) = (0.0, 0.0);
    let mut rows = Vec::new();
    while s < asked.distance {
        rows.push([t, s, v, 0.0, 0.0]);
        t += STEP;
        s += v * STEP;
    }
    case.expect(&json!(rows))
}
