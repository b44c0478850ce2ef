//! Speed profiles: stopping, filling up, creeping.

use super::{LatticeCase, all_near, near, same};
use corridor_decider::fallback::{constant_deceleration, filled};
use corridor_decider::st_graph::{SpeedData, SpeedPoint};
use serde::Deserialize;
use serde_json::{Value, json};

const TOLERANCE: f64 = 1e-9;

/// The original's braking, m/s².
const DECELERATION: f64 = -4.0;

/// Time between two points, s.
const STEP: f64 = 0.1;

type Row = [f64; 5];

fn rows(profile: &SpeedData) -> Vec<Row> {
    profile
        .points
        .iter()
        .map(|point| [point.s, point.t, point.v, point.a, point.da])
        .collect()
}

fn wanted(case: &LatticeCase) -> Result<Vec<Row>, String> {
    Vec::deserialize(&case.expected["points_s_t_v_a_da"]).map_err(|error| format!("expected: {error}"))
}

/// As long as the original's car moves, its points; from then on, standing at the exact place. The original goes on
/// braking with the car at rest.
pub(super) fn stop(case: &LatticeCase) -> Result<(), String> {
    let value = |key: &str| case.input[key].as_f64().unwrap_or(f64::NAN);
    let (v, a) = (value("init_speed"), value("init_acc"));
    let got = rows(&constant_deceleration(v, a, DECELERATION));
    let exact = v * v / (-2.0 * DECELERATION);
    for (k, wanted) in wanted(case)?.iter().enumerate() {
        let got = got.get(k).ok_or_else(|| format!("no point {k}"))?;
        if wanted[2] > 0.0 || k == 0 {
            all_near(&format!("point {k}"), &json!(wanted), &json!(got), TOLERANCE)?;
        } else {
            near("time", &json!(wanted[1]), got[1], TOLERANCE)?;
            near("place of the stop", &json!(exact), got[0], TOLERANCE)?;
            same("at rest", &true, &(got[2] == 0.0 && got[3] == 0.0))?;
        }
    }
    Ok(())
}

pub(super) fn fill(case: &LatticeCase) -> Result<(), String> {
    let given: Vec<Row> =
        Vec::deserialize(&case.input["points_s_t_v_a_da"]).map_err(|error| error.to_string())?;
    let point = |[s, t, v, a, da]: &Row| SpeedPoint {
        t: *t,
        s: *s,
        v: *v,
        a: *a,
        da: *da,
    };
    let got = rows(&filled(given.iter().map(point).collect()));
    all_near(
        "points",
        &case.expected["points_s_t_v_a_da"],
        &json!(got),
        TOLERANCE,
    )
}

/// Fastest that the original creeps, m/s.
const CREEP_SPEED: f64 = 2.23;

/// The original's creep: braking would begin a negative distance before the end, so it never does, and the profile drives
/// on at the same speed until there.
pub(super) fn creep(case: &LatticeCase) -> Result<(), String> {
    let value = |key: &str| case.input[key].as_f64().unwrap_or(f64::NAN);
    let (distance, v) = (value("distance"), value("max_speed").min(CREEP_SPEED));
    let (mut t, mut s) = (0.0, 0.0);
    let mut got: Vec<Row> = Vec::new();
    while s < distance && v > 0.0 {
        got.push([s, t, v, 0.0, 0.0]);
        t += STEP;
        s += v * STEP;
    }
    let got: Value = json!(got);
    all_near("points", &case.expected["points_s_t_v_a_da"], &got, TOLERANCE)
}
