//! Cases of the lattice planner: Frenet conversions, curves, samplers, bundles, costs, checks, the path-time graph, the
//! combiner and the backup.
//!
//! Where a case shows a defect of the original and holds the repaired result, that result counts. Where it holds none, or
//! Corridor knowingly goes its own way, this is compared:
//!
//! - singular geometry: the state has to be rejected;
//! - a negative initial speed, a cruise speed of 0 with a stop point, a stop behind the car: there is an answer, and it
//!   is finite;
//! - the lateral one-dimensional check away from station 0: only that there is an answer (the original looks up offsets
//!   at the wrong place, and does not use the check);
//! - the curvature at the centre of a bend: there is none; the original's is 0;
//! - lateral bounds beside what stands: stations that nothing is near to; a car beside it keeps clear of it;
//! - times: Corridor adds them up as the original does, so that `cheapest_10` and `jerk` count, not the variants for a
//!   grid of whole multiples;
//! - backups with moved obstacles: the original looks at them when the plan starts, which here is an argument;
//! - the creep profile: nothing asks for it, and the original's never brakes; the expectation is checked against the
//!   formula with the wrong sign, which stands only here.

mod backup;
mod checks;
mod costs;
mod curves;
mod frenet;
mod graph;
mod profiles;
mod samplers;
mod scene;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// One case.
#[derive(Deserialize)]
pub(crate) struct LatticeCase {
    pub(crate) name: String,
    function: String,
    input: Value,
    expected: Value,
    defect: Option<String>,
}

/// What answers a function.
type Check = fn(&LatticeCase) -> Result<(), String>;

/// Every function and what answers it.
const FUNCTIONS: [(&str, Check); 47] = [
    ("cartesian_to_frenet", frenet::to_frenet),
    ("cartesian_to_frenet_sl", frenet::to_sl),
    ("frenet_to_cartesian", frenet::to_plane),
    ("CalculateTheta", frenet::closed_form),
    ("CalculateKappa", frenet::closed_form),
    ("CalculateCartesianPoint", frenet::closed_form),
    ("CalculateLateralDerivative", frenet::derivatives),
    ("CalculateSecondOrderLateralDerivative", frenet::derivatives),
    ("cubic", curves::polynomial),
    ("quartic", curves::polynomial),
    ("quintic", curves::polynomial),
    ("quartic_fit_end_first_order", curves::polynomial),
    ("quartic_fit_end_second_order", curves::polynomial),
    ("quartic_integrated_from_cubic", curves::polynomial),
    ("quartic_derived_from_quintic", curves::polynomial),
    ("quintic_integrated_from_quartic", curves::polynomial),
    ("cubic_derived_from_quartic", curves::polynomial),
    ("lattice_trajectory1d", curves::wrapped),
    ("constant_deceleration", curves::deceleration),
    ("standing_still", curves::standing),
    ("constant_jerk", curves::constant_jerk),
    ("piecewise_jerk", curves::piecewise_jerk),
    ("piecewise_trajectory_of_quartics", curves::piecewise_quartics),
    ("piecewise_acceleration", curves::piecewise_acceleration),
    ("piecewise_acceleration_order2", curves::piecewise_order),
    ("feasible_region", samplers::region),
    ("sample_lat_end_conditions", samplers::lateral),
    ("sample_lon_cruising", samplers::cruise),
    ("sample_lon_stopping", samplers::stop),
    ("sample_lon_path_time_points", samplers::path_time),
    ("trajectory_bundles", samplers::bundles),
    ("guide_velocity", costs::guide),
    ("piecewise_braking", costs::braking),
    ("trajectory_evaluator_costs", costs::costs),
    ("trajectory_evaluator_run", costs::run),
    ("constraint_checker1d_longitudinal", checks::longitudinal),
    ("constraint_checker1d_lateral", checks::lateral),
    ("constraint_checker", checks::trajectory),
    ("trajectory_combiner", checks::combined),
    ("path_time_graph", graph::graph),
    ("lateral_bounds", graph::bounds),
    ("path_matcher", graph::matcher),
    ("prediction_querier", graph::speeds),
    ("backup_trajectory", backup::backup),
    ("stop_profile", profiles::stop),
    ("fill_enough_speed_points", profiles::fill),
    ("fixed_distance_creep_profile", profiles::creep),
];

/// Whether a function is one of the lattice planner's.
pub(crate) fn knows(function: &str) -> bool {
    FUNCTIONS.iter().any(|(name, _)| *name == function)
}

/// Answers a case and compares.
pub(crate) fn check(case: &LatticeCase) -> Result<(), String> {
    let found = FUNCTIONS.iter().find(|(name, _)| *name == case.function);
    let (_, check) = found.ok_or_else(|| format!("unknown function `{}`", case.function))?;
    check(case)
}

impl LatticeCase {
    fn input<T: DeserializeOwned>(&self) -> Result<T, String> {
        T::deserialize(&self.input).map_err(|error| format!("input: {error}"))
    }

    /// Whether the original dies of it.
    fn fails(&self) -> bool {
        self.expected["result"] == "check_failed"
    }

    fn is_defect(&self) -> bool {
        self.defect.is_some()
    }
}

/// A number that JSON may not know; `None` is not compared.
fn number(value: &Value) -> Option<f64> {
    match value.as_str() {
        Some("nan") => Some(f64::NAN),
        Some("inf") => Some(f64::INFINITY),
        Some("-inf") => Some(f64::NEG_INFINITY),
        _ => value.as_f64(),
    }
}

/// Whether two numbers agree, relative to the size of the expected one or to 1.
fn agrees(wanted: f64, got: f64, tolerance: f64) -> bool {
    wanted.to_bits() == got.to_bits()
        || (wanted.is_nan() && got.is_nan())
        || (wanted - got).abs() <= tolerance * wanted.abs().max(1.0)
}

/// Compares one expected number.
fn near(place: &str, wanted: &Value, got: f64, tolerance: f64) -> Result<(), String> {
    match number(wanted) {
        Some(wanted) if !agrees(wanted, got, tolerance) => {
            Err(format!("{place}: expected {wanted}, got {got}"))
        }
        None if !wanted.is_null() => Err(format!("{place}: expected {wanted}, which is no number")),
        _ => Ok(()),
    }
}

/// Compares numbers, nested as deep as they are.
fn all_near(place: &str, wanted: &Value, got: &Value, tolerance: f64) -> Result<(), String> {
    match (wanted, got) {
        (Value::Null, _) => Ok(()),
        (Value::Array(wanted), Value::Array(got)) => {
            if wanted.len() != got.len() {
                return Err(format!(
                    "{place}: expected {} entries, got {}",
                    wanted.len(),
                    got.len()
                ));
            }
            let mut pairs = wanted.iter().zip(got).enumerate();
            pairs
                .try_for_each(|(k, (wanted, got))| all_near(&format!("{place}[{k}]"), wanted, got, tolerance))
        }
        (_, Value::Number(_)) => near(place, wanted, got.as_f64().unwrap_or(f64::NAN), tolerance),
        _ => Err(format!("{place}: expected {wanted}, got {got}")),
    }
}

/// Compares a flag.
fn same<T: PartialEq + std::fmt::Debug>(place: &str, wanted: &T, got: &T) -> Result<(), String> {
    if wanted == got {
        Ok(())
    } else {
        Err(format!("{place}: expected {wanted:?}, got {got:?}"))
    }
}
