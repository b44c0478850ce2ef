//! Constraint checks and the combiner.

use super::curves::Ends;
use super::frenet::same_direction;
use super::scene;
use super::{LatticeCase, near, same};
use corridor_decider::lattice::{
    Curve, LongitudinalTrack, Sampled, Violation, combine, keeps_lateral_limits, keeps_longitudinal_limits,
    trajectory as driven, violation,
};
use serde::Deserialize;
use serde_json::{Value, json};

const TOLERANCE: f64 = 1e-7;

fn curve(value: &Value) -> Result<Curve, String> {
    let ends = Ends::deserialize(value).map_err(|error| format!("input: {error}"))?;
    ends.curve()
}

pub(super) fn longitudinal(case: &LatticeCase) -> Result<(), String> {
    let valid = keeps_longitudinal_limits(&curve(&case.input["curve"])?);
    same("valid", &case.expected["valid"], &json!(valid))
}

pub(super) fn lateral(case: &LatticeCase) -> Result<(), String> {
    let valid = keeps_lateral_limits(&curve(&case.input["lat"])?, &curve(&case.input["lon"])?);
    if case.is_defect() {
        return Ok(());
    }
    same("valid", &case.expected["valid"], &json!(valid))
}

pub(super) fn trajectory(case: &LatticeCase) -> Result<(), String> {
    let points: Vec<[f64; 4]> =
        Vec::deserialize(&case.input["points_t_v_a_kappa"]).map_err(|e| e.to_string())?;
    let name = match violation(points.into_iter()) {
        None => "VALID",
        Some(Violation::Speed) => "LON_VELOCITY_OUT_OF_BOUND",
        Some(Violation::Acceleration) => "LON_ACCELERATION_OUT_OF_BOUND",
        Some(Violation::Curvature) => "CURVATURE_OUT_OF_BOUND",
        Some(Violation::Jerk) => "LON_JERK_OUT_OF_BOUND",
        Some(Violation::LateralAcceleration) => "LAT_ACCELERATION_OUT_OF_BOUND",
    };
    same("result", &case.expected["result"], &json!(name))
}

#[derive(Deserialize)]
struct Input {
    reference_line: Vec<[f64; 6]>,
    lon: Ends,
    lat: Ends,
    init_relative_time: f64,
}

pub(super) fn combined(case: &LatticeCase) -> Result<(), String> {
    let input: Input = case.input()?;
    let line = scene::line(&input.reference_line, scene::full)?;
    let track = LongitudinalTrack::new(&Sampled::new(&input.lon.curve()?), &line);
    let mut points = Vec::new();
    combine(&track, &input.lat.curve()?, &mut points);
    let got = driven(&points);
    let wanted: Vec<[f64; 8]> =
        Vec::deserialize(&case.expected["points"]).map_err(|error| error.to_string())?;
    same("count", &wanted.len(), &got.len())?;
    for (k, (wanted, got)) in wanted.iter().zip(&got).enumerate() {
        let [t, x, y, theta, kappa, distance, v, a] = *wanted;
        let pairs = [
            ("t", t, got.t + input.init_relative_time),
            ("x", x, got.pose.x),
            ("y", y, got.pose.y),
            ("kappa", kappa, got.kappa),
            ("distance", distance, got.distance),
            ("v", v, got.v),
            ("a", a, got.a),
        ];
        for (key, wanted, got) in pairs {
            near(&format!("{key} of point {k}"), &json!(wanted), got, TOLERANCE)?;
        }
        same(
            &format!("theta of point {k}"),
            &true,
            &same_direction(theta, got.pose.theta, TOLERANCE),
        )?;
    }
    Ok(())
}
