//! Guide speeds, costs and the order of pairs.

use super::curves::{Ends, has_knots, has_length};
use super::samplers::bundle;
use super::scene::{self, Start, Target};
use super::{LatticeCase, agrees, all_near, near, number, same};
use corridor_decider::geometry::Polynomial;
use corridor_decider::lattice::{
    Blocked, Braking, Curve, Evaluator, LateralProfile, LineTable, LongitudinalCosts, Pair, SAMPLES, Sampled,
    Surroundings, Weights, braking_profile, guide_speeds, keeps_longitudinal_limits, keeps_stop,
    lateral_bundle, lateral_comfort, total_cost,
};
use serde::Deserialize;
use serde_json::{Value, json};

const TOLERANCE: f64 = 1e-9;

/// Costs of curves of a hundredth of a second are large differences of larger numbers.
const COSTS: f64 = 1e-8;

fn target(case: &LatticeCase) -> Result<Target, String> {
    Target::deserialize(&case.input["planning_target"]).map_err(|error| format!("input: {error}"))
}

fn guide_of(case: &LatticeCase) -> Result<[f64; SAMPLES], String> {
    let start: Start = case.input()?;
    Ok(guide_speeds(
        &target(case)?.planning(),
        start.init_s[0],
        start.init_s[1],
    ))
}

pub(super) fn guide(case: &LatticeCase) -> Result<(), String> {
    let got = guide_of(case)?;
    if case.fails() {
        return same("sound", &true, &got.iter().all(|v| v.is_finite() && *v >= 0.0));
    }
    all_near(
        "guide",
        &case.expected["guide_velocity"],
        &json!(got.to_vec()),
        TOLERANCE,
    )
}

#[derive(Deserialize)]
struct Stop {
    s_target: f64,
    s_curr: f64,
    v_target: f64,
    v_curr: f64,
    a_comfort: f64,
    d_comfort: f64,
    max_time: f64,
}

pub(super) fn braking(case: &LatticeCase) -> Result<(), String> {
    let input: Stop = case.input()?;
    let with = Braking {
        acceleration: input.a_comfort,
        braking: input.d_comfort,
        duration: input.max_time,
    };
    let profile = braking_profile(
        (input.s_curr, input.s_target),
        (input.v_curr, input.v_target),
        with,
    );
    let profile = profile.map_err(|error| error.to_string())?;
    if case.is_defect() {
        return same("sound", &true, &profile.knots().flatten().all(f64::is_finite));
    }
    let segments: Vec<(f64, f64)> = profile.segments().collect();
    all_near(
        "segments",
        &case.expected["segments"],
        &json!(segments),
        TOLERANCE,
    )?;
    has_length(case, profile.length())?;
    has_knots(case, &profile)
}

/// What is occupied at the times of the grid.
#[derive(Deserialize)]
struct Intervals {
    blocking_intervals: Vec<Vec<(f64, f64)>>,
}

impl Intervals {
    /// Which interval is whose does not matter: the first ones are taken for one obstacle's, and so on.
    fn by_obstacle(&self) -> Blocked {
        let most = self.blocking_intervals.iter().map(Vec::len).max();
        let rows = 0..most.unwrap_or(0);
        Blocked::new(rows.map(|row| self.blocking_intervals.iter().map(move |at| at.get(row).copied())))
    }
}

/// Curves that start where the case does.
fn curves(case: &LatticeCase, list: &str, start: [f64; 3]) -> Result<Vec<Curve>, String> {
    let ends = case.input[list].as_array().ok_or("input: no curves")?;
    let curve = |end: &Value| {
        let mut fields = end.clone();
        fields["start"] = json!(start);
        let ends: Ends = serde_json::from_value(fields).map_err(|error| format!("input: {error}"))?;
        ends.curve()
    };
    ends.iter().map(curve).collect()
}

pub(super) fn costs(case: &LatticeCase) -> Result<(), String> {
    let start: Start = case.input()?;
    let rows: Vec<[f64; 2]> =
        Vec::deserialize(&case.input["reference_line_s_kappa"]).map_err(|e| e.to_string())?;
    let line = scene::line(&rows, scene::bends)?;
    let (blocked, guide) = (case.input::<Intervals>()?.by_obstacle(), guide_of(case)?);
    all_near(
        "guide",
        &case.expected["guide_velocity"],
        &json!(guide.to_vec()),
        TOLERANCE,
    )?;
    let longitudinal = curves(case, "lon", start.init_s)?;
    let laterals: Vec<LateralProfile> = curves(case, "lat", start.init_d)?
        .into_iter()
        .map(LateralProfile::new)
        .collect();
    let sampled: Vec<Sampled> = longitudinal.iter().map(Sampled::new).collect();
    let costs: Vec<LongitudinalCosts> = sampled
        .iter()
        .map(|curve| LongitudinalCosts::new(curve, &guide, &blocked, &line))
        .collect();
    for (k, wanted) in case.expected["lon"].as_array().into_iter().flatten().enumerate() {
        let (curve, got) = (&longitudinal[k], &costs[k]);
        near("objective", &wanted["objective"], got.objective, COSTS)?;
        near("jerk", &wanted["jerk"], got.jerk, COSTS)?;
        near("collision", &wanted["collision"], got.collision, COSTS)?;
        near("centripetal", &wanted["centripetal"], got.centripetal, COSTS)?;
        let stop_s = target(case)?.stop_point;
        same(
            "passes_stop_filter",
            &wanted["passes_stop_filter"],
            &json!(keeps_stop(curve, stop_s)),
        )?;
        same(
            "passes_1d_check",
            &wanted["passes_1d_check"],
            &json!(keeps_longitudinal_limits(curve)),
        )?;
    }
    for wanted in case.expected["pairs"].as_array().into_iter().flatten() {
        let place = |key: &str| {
            wanted[key]
                .as_u64()
                .and_then(|k| usize::try_from(k).ok())
                .unwrap_or(usize::MAX)
        };
        let (lon, lat) = (place("lon"), place("lat"));
        let comfort = lateral_comfort(&sampled[lon], &laterals[lat].curve);
        near("lat_comfort", &wanted["lat_comfort"], comfort, COSTS)?;
        if wanted["horizon_fragile"] != true {
            let offset = laterals[lat].offset_cost(sampled[lon].way);
            near("lat_offset", &wanted["lat_offset"], offset, COSTS)?;
            let total = total_cost(&Weights::default(), &costs[lon], offset, comfort);
            near("total", &wanted["total"], total, COSTS)?;
        }
    }
    Ok(())
}

pub(super) fn run(case: &LatticeCase) -> Result<(), String> {
    let rows: Vec<[f64; 3]> =
        Vec::deserialize(&case.input["reference_line_s_theta_kappa"]).map_err(|error| error.to_string())?;
    let line = scene::line(&rows, scene::directions_and_bends)?;
    let bundle = bundle(case, &line)?;
    same("num_lon", &case.expected["num_lon"], &json!(bundle.len()))?;
    let laterals: Vec<LateralProfile> = lateral_bundle(&case.input::<Start>()?.motion())
        .into_iter()
        .map(|curve: Polynomial| LateralProfile::new(curve.into()))
        .collect();
    let guide = guide_of(case)?;
    let blocked = case.input::<Intervals>()?.by_obstacle();
    let around = Surroundings {
        stop_s: target(case)?.stop_point,
        guide: &guide,
        blocked: &blocked,
        line: &line as &LineTable,
    };
    let evaluator = Evaluator::new(
        bundle.iter().map(|curve| &curve.curve),
        &laterals,
        &around,
        Weights::default(),
    );
    let survivors: Vec<usize> = evaluator.survivors().collect();
    same(
        "survivors",
        &case.expected["surviving_lon_indices"],
        &json!(survivors),
    )?;
    same(
        "num_pairs",
        &case.expected["num_pairs"],
        &json!(evaluator.pairs()),
    )?;
    let cheapest: Vec<Pair> = evaluator.collect();
    in_order(&cheapest)?;
    for (k, wanted) in case.expected["cheapest_10"]
        .as_array()
        .into_iter()
        .flatten()
        .enumerate()
    {
        let cost = number(&wanted["cost"]).unwrap_or(f64::NAN);
        near(
            &format!("cheapest_10[{k}]"),
            &wanted["cost"],
            cheapest[k].cost,
            COSTS,
        )?;
        let is_it = |pair: &Pair| {
            wanted["lon_index"] == json!(pair.longitudinal) && wanted["lat_index"] == json!(pair.lateral)
        };
        let found = cheapest.iter().find(|pair| is_it(pair));
        same(
            "cost of the pair",
            &true,
            &found.is_some_and(|pair| agrees(cost, pair.cost, COSTS)),
        )?;
    }
    Ok(())
}

fn in_order(pairs: &[Pair]) -> Result<(), String> {
    same(
        "in order",
        &true,
        &pairs.windows(2).all(|pair| pair[0].cost <= pair[1].cost),
    )
}
