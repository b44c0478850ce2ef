//! `speed_limit.*` and `speed_data.*`: reading a limit and a profile.

use super::{SpeedCase, check_failed};
use corridor_decider::st_graph::{SpeedData, SpeedLimit, SpeedPoint};
use serde::Deserialize;
use serde_json::{Value, json};

#[derive(Deserialize)]
struct Limits {
    entries_sv: Vec<(f64, f64)>,
    s: Vec<f64>,
}

pub(super) fn limit(case: &SpeedCase) -> Result<(), String> {
    let asked: Limits = case.input()?;
    match SpeedLimit::new(asked.entries_sv) {
        Ok(limit) => case.expect(&asked.s.iter().map(|s| json!(limit.at(*s))).collect()),
        Err(_) => case.expect(&check_failed()),
    }
}

#[derive(Deserialize)]
struct Profile {
    points: Vec<Point>,
    #[serde(default, alias = "s")]
    t: Vec<f64>,
}

/// A point with numbers that may be unset.
#[derive(Deserialize)]
struct Point {
    s: f64,
    t: f64,
    v: Option<f64>,
    a: Option<f64>,
    da: Option<f64>,
}

pub(super) fn data(case: &SpeedCase, function: &str) -> Result<(), String> {
    let asked: Profile = case.input()?;
    let points = asked.points.iter().map(|point| SpeedPoint {
        t: point.t,
        s: point.s,
        v: point.v.unwrap_or_default(),
        a: point.a.unwrap_or_default(),
        da: point.da.unwrap_or_default(),
    });
    let profile = SpeedData::new(points.collect());
    let read = |at: &f64| match function {
        "by_s" => profile.at_distance(*at),
        _ => profile.at_time(*at),
    };
    let answer = asked.t.iter().map(|at| match read(at) {
        Some(point) => {
            json!({ "ok": true, "s": point.s, "t": point.t, "v": point.v, "a": point.a, "da": point.da })
        }
        None => json!({ "ok": false }),
    });
    case.expect(&answer.collect::<Value>())
}
