//! Feasible regions, end conditions and bundles.

use super::scene::{self, Entry, Mover, Start, Target};
use super::{LatticeCase, all_near, near, same};
use corridor_decider::lattice::{
    self, EndCondition, FeasibleRegion, Kind, LineTable, Longitudinal, lateral_bundle, longitudinal_bundle,
    projected_speed,
};
use corridor_decider::vehicle::VehicleParams;
use serde::Deserialize;
use serde_json::{Value, json};

const TOLERANCE: f64 = 1e-9;

/// Of coefficients of a curve of a hundredth of a second.
const SHORT_COEFFICIENTS: f64 = 1e-5;

fn rows(ends: &[EndCondition]) -> Value {
    let row = |end: &EndCondition| [end.state[0], end.state[1], end.state[2], end.length];
    json!(ends.iter().map(row).collect::<Vec<_>>())
}

#[derive(Deserialize)]
struct Region {
    init_s: [f64; 3],
    t: Vec<f64>,
    s: Vec<f64>,
}

pub(super) fn region(case: &LatticeCase) -> Result<(), String> {
    let input: Region = case.input()?;
    let region = FeasibleRegion::new(input.init_s[0], input.init_s[1]);
    let over =
        |values: &[f64], of: &dyn Fn(f64) -> f64| values.iter().map(|at| of(*at)).collect::<Vec<f64>>();
    let lists = [
        ("s_upper", over(&input.t, &|t| region.s_upper(t))),
        ("s_lower", over(&input.t, &|t| region.s_lower(t))),
        ("v_upper", over(&input.t, &|t| region.v_upper(t))),
        ("v_lower", over(&input.t, &|t| region.v_lower(t))),
        ("t_lower", over(&input.s, &|s| region.t_lower(s))),
    ];
    for (key, got) in lists {
        if case.is_defect() {
            same(key, &true, &got.iter().all(|value| value.is_finite()))?;
        } else {
            all_near(key, &case.expected[key], &json!(got), TOLERANCE)?;
        }
    }
    Ok(())
}

pub(super) fn lateral(case: &LatticeCase) -> Result<(), String> {
    all_near(
        "ends",
        &case.expected["end_conditions"],
        &rows(&lattice::lateral()),
        TOLERANCE,
    )
}

pub(super) fn cruise(case: &LatticeCase) -> Result<(), String> {
    let start: Start = case.input()?;
    let speed = case.input["cruise_speed"].as_f64().unwrap_or(f64::NAN);
    let region = FeasibleRegion::new(start.init_s[0], start.init_s[1]);
    all_near(
        "ends",
        &case.expected["end_conditions"],
        &rows(&lattice::cruise(&region, speed)),
        TOLERANCE,
    )
}

pub(super) fn stop(case: &LatticeCase) -> Result<(), String> {
    let start: Start = case.input()?;
    let ends = case.input["stop_point"]
        .as_f64()
        .map(|stop_s| lattice::stop(start.init_s[0], stop_s));
    all_near(
        "ends",
        &case.expected["end_conditions"],
        &rows(&ends.unwrap_or_default()),
        TOLERANCE,
    )
}

/// What path-time samples come from.
#[derive(Deserialize)]
pub(super) struct PathTime {
    pub(super) init_s: [f64; 3],
    pub(super) st_obstacles: Vec<Entry>,
    pub(super) obstacles: Vec<Mover>,
}

impl PathTime {
    pub(super) fn ends(&self, line: &LineTable) -> Vec<EndCondition> {
        let region = FeasibleRegion::new(self.init_s[0], self.init_s[1]);
        let vehicle = VehicleParams::default();
        let entries = self.st_obstacles.iter().enumerate();
        entries
            .flat_map(|(k, entry)| {
                let motions = scene::motions(&self.obstacles, &entry.id);
                lattice::path_time(&entry.entry(k), &region, &vehicle, |point| {
                    projected_speed(&motions, line.at(point.s).pose.theta, point.t)
                })
            })
            .collect()
    }
}

#[derive(Deserialize)]
struct Directions {
    reference_line_s_theta: Vec<[f64; 2]>,
}

pub(super) fn path_time(case: &LatticeCase) -> Result<(), String> {
    let line = scene::line(
        &case.input::<Directions>()?.reference_line_s_theta,
        scene::directions,
    )?;
    let ends = case.input::<PathTime>()?.ends(&line);
    all_near("ends", &case.expected["end_conditions"], &rows(&ends), TOLERANCE)
}

/// The bundle of a case: its stop curves end at the stop point itself, as the original's do.
pub(super) fn bundle(case: &LatticeCase, line: &LineTable) -> Result<Vec<Longitudinal>, String> {
    let start: Start = case.input()?;
    let target = Target::deserialize(&case.input["planning_target"]).map_err(|error| error.to_string())?;
    let region = FeasibleRegion::new(start.init_s[0], start.init_s[1]);
    let cruise = lattice::cruise(&region, target.cruise_speed);
    let beside = case.input::<PathTime>()?.ends(line);
    let stop = target
        .stop_point
        .map(|stop_s| lattice::stop(start.init_s[0], stop_s));
    Ok(longitudinal_bundle(
        start.init_s,
        &cruise,
        &beside,
        &stop.unwrap_or_default(),
    ))
}

#[derive(Deserialize)]
struct Wanted {
    kind: String,
    target_position: Value,
    target_velocity: Value,
    target_time: Value,
    coef: Vec<Value>,
}

pub(super) fn bundles(case: &LatticeCase) -> Result<(), String> {
    let line = scene::line(
        &case.input::<Directions>()?.reference_line_s_theta,
        scene::directions,
    )?;
    let longitudinal = bundle(case, &line)?;
    let wanted: Vec<Wanted> = Vec::deserialize(&case.expected["lon"]).map_err(|error| error.to_string())?;
    same(
        "number of longitudinal curves",
        &wanted.len(),
        &longitudinal.len(),
    )?;
    for (k, (wanted, got)) in wanted.iter().zip(&longitudinal).enumerate() {
        compare(wanted, got).map_err(|mismatch| format!("lon[{k}]: {mismatch}"))?;
    }
    let laterals = lateral_bundle(&case.input::<Start>()?.motion());
    let laterals: Vec<_> = laterals.iter().map(|curve| *curve.coefficients()).collect();
    all_near(
        "lat_coef",
        &case.expected["lat_coef"],
        &json!(laterals),
        TOLERANCE,
    )
}

fn compare(wanted: &Wanted, got: &Longitudinal) -> Result<(), String> {
    let kind = match got.kind {
        Kind::Cruise => "cruise",
        Kind::PathTime => "path_time",
        Kind::Stop => "stop",
    };
    same("kind", &wanted.kind.as_str(), &kind)?;
    near(
        "target_position",
        &wanted.target_position,
        got.end.state[0],
        TOLERANCE,
    )?;
    near(
        "target_velocity",
        &wanted.target_velocity,
        got.end.state[1],
        TOLERANCE,
    )?;
    near("target_time", &wanted.target_time, got.end.length, TOLERANCE)?;
    let is_short = got.end.length < 0.0101;
    let tolerance = if is_short { SHORT_COEFFICIENTS } else { TOLERANCE };
    let coefficients = got.polynomial.coefficients();
    for (k, (wanted, got)) in wanted.coef.iter().zip(coefficients).enumerate() {
        near(&format!("coef[{k}]"), wanted, *got, tolerance)?;
    }
    Ok(())
}
