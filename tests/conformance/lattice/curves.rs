//! Curves in one dimension.

use super::{LatticeCase, all_near, near, same};
use corridor_decider::geometry::Polynomial;
use corridor_decider::lattice::{ConstantDeceleration, Curve, Piecewise, PiecewiseAcceleration};
use serde::Deserialize;
use serde_json::{Value, json};

const TOLERANCE: f64 = 1e-9;

/// Of coefficients and of values outside the interval of a curve of a hundredth of a second.
const SHORT_COEFFICIENTS: f64 = 1e-5;
const SHORT_VALUES: f64 = 1e-6;
const SHORT: f64 = 0.0101;

#[derive(Deserialize)]
#[serde(untagged)]
enum End {
    Value(f64),
    Slope([f64; 2]),
    Full([f64; 3]),
}

/// A polynomial by its ends, as many functions name them.
#[derive(Deserialize)]
pub(super) struct Ends {
    start: [f64; 3],
    end: End,
    param: f64,
}

impl Ends {
    pub(super) fn polynomial(&self) -> Option<Polynomial> {
        match self.end {
            End::Value(end) => Polynomial::cubic(self.start, end, self.param),
            End::Slope(end) => Polynomial::quartic(self.start, end, self.param),
            End::Full(end) => Polynomial::quintic(self.start, end, self.param),
        }
    }

    pub(super) fn curve(&self) -> Result<Curve, String> {
        self.polynomial()
            .map(Curve::from)
            .ok_or_else(|| "a curve without a length".to_owned())
    }
}

/// The curve named by fields with a prefix.
fn prefixed(input: &Value, prefix: &str) -> Result<Option<Polynomial>, String> {
    let fields = json!({
        "start": input[format!("{prefix}_start")],
        "end": input[format!("{prefix}_end")],
        "param": input["param"],
    });
    let ends: Ends = serde_json::from_value(fields).map_err(|error| format!("input: {error}"))?;
    Ok(ends.polynomial())
}

fn asked(case: &LatticeCase) -> Result<Option<Polynomial>, String> {
    let input = &case.input;
    let value = |key: &str| input[key].as_f64().unwrap_or(f64::NAN);
    let from = value("init_value");
    Ok(match case.function.as_str() {
        "quartic_fit_end_first_order" => {
            let start = [value("x0"), value("dx0"), value("ddx0")];
            Polynomial::quartic_to_slope(start, [value("x1"), value("dx1")], value("param"))
        }
        "quartic_fit_end_second_order" => {
            let end = [value("x1"), value("dx1"), value("ddx1")];
            Polynomial::quartic_from_slope([value("x0"), value("dx0")], end, value("param"))
        }
        "quartic_integrated_from_cubic" => prefixed(input, "cubic")?.map(|curve| curve.integrated(from)),
        "quintic_integrated_from_quartic" => prefixed(input, "quartic")?.map(|curve| curve.integrated(from)),
        "cubic_derived_from_quartic" => prefixed(input, "quartic")?.map(|curve| curve.derived()),
        "quartic_derived_from_quintic" => prefixed(input, "quintic")?.map(|curve| curve.derived()),
        _ => case.input::<Ends>()?.polynomial(),
    })
}

pub(super) fn polynomial(case: &LatticeCase) -> Result<(), String> {
    let Some(polynomial) = asked(case)? else {
        return same("rejected", &case.fails(), &true);
    };
    if case.fails() {
        return Err("accepted, but it has no length".to_owned());
    }
    let length = polynomial.length();
    has_length(case, length)?;
    let short = length < SHORT;
    let count = case.expected["coef"].as_array().map_or(0, Vec::len);
    let coefficients = json!(polynomial.coefficients()[..count]);
    let tolerance = if short { SHORT_COEFFICIENTS } else { TOLERANCE };
    all_near("coef", &case.expected["coef"], &coefficients, tolerance)?;
    values(
        case,
        |order, p| polynomial.derivative(order, p),
        |p| {
            if short && !(0.0..=length).contains(&p) {
                SHORT_VALUES
            } else if short {
                SHORT_COEFFICIENTS
            } else {
                TOLERANCE
            }
        },
    )
}

/// Compares the rows of values: columns are orders, unless the case names them.
fn values(
    case: &LatticeCase,
    at: impl Fn(usize, f64) -> f64,
    tolerance: impl Fn(f64) -> f64,
) -> Result<(), String> {
    let Some(rows) = case.expected["values"].as_array() else {
        return Ok(());
    };
    let parameters: Vec<f64> =
        Vec::deserialize(&case.input["eval_params"]).map_err(|error| error.to_string())?;
    let orders: Option<Vec<usize>> =
        Option::deserialize(&case.input["orders"]).map_err(|error| error.to_string())?;
    for (row, p) in rows.iter().zip(parameters) {
        for (column, wanted) in row.as_array().into_iter().flatten().enumerate() {
            let order = orders.as_ref().map_or(column, |orders| orders[column]);
            near(
                &format!("order {order} at {p}"),
                wanted,
                at(order, p),
                tolerance(p),
            )?;
        }
    }
    Ok(())
}

fn column(values: [f64; 4], order: usize) -> f64 {
    values.get(order).copied().unwrap_or(0.0)
}

pub(super) fn wrapped(case: &LatticeCase) -> Result<(), String> {
    let ends: Ends = case.input()?;
    let (curve, inner) = (ends.curve()?, ends.polynomial());
    has_length(case, curve.length())?;
    let at = |order: usize, p: f64| match inner {
        Some(inner) if order > 3 && p < curve.length() => inner.derivative(order, p),
        _ => column(curve.at(p), order),
    };
    values(case, at, |_| TOLERANCE)
}

pub(super) fn deceleration(case: &LatticeCase) -> Result<(), String> {
    let value = |key: &str| case.input[key].as_f64().unwrap_or(f64::NAN);
    let Some(curve) = ConstantDeceleration::new(value("s0"), value("v0"), value("a")) else {
        return same("rejected", &case.fails(), &true);
    };
    has_length(case, curve.length())?;
    values(case, |order, p| column(curve.at(p), order), |_| TOLERANCE)
}

pub(super) fn standing(case: &LatticeCase) -> Result<(), String> {
    let value = |key: &str| case.input[key].as_f64().unwrap_or(f64::NAN);
    let curve = Polynomial::constant(value("position"), value("duration"));
    has_length(case, curve.length())?;
    values(case, |order, p| curve.derivative(order, p), |_| TOLERANCE)
}

/// Compares the length of a curve.
pub(super) fn has_length(case: &LatticeCase, length: f64) -> Result<(), String> {
    near("length", &case.expected["param_length"], length, TOLERANCE)
}

/// Compares the knots of a profile.
pub(super) fn has_knots(case: &LatticeCase, profile: &PiecewiseAcceleration) -> Result<(), String> {
    for (k, key) in ["knot_t", "knot_s", "knot_v"].into_iter().enumerate() {
        let knots: Vec<f64> = profile.knots().map(|knot| knot[k]).collect();
        all_near(key, &case.expected[key], &json!(knots), TOLERANCE)?;
    }
    Ok(())
}

pub(super) fn constant_jerk(case: &LatticeCase) -> Result<(), String> {
    let value = |key: &str| case.input[key].as_f64().unwrap_or(f64::NAN);
    let start = [value("p0"), value("v0"), value("a0")];
    let Some(curve) = Polynomial::constant_jerk(start, value("jerk"), value("param")) else {
        return same("rejected", &case.fails(), &true);
    };
    if case.fails() {
        return Err("accepted, but it has no length".to_owned());
    }
    has_length(case, curve.length())?;
    let end = curve.at(curve.length());
    for (key, got) in ["end_position", "end_velocity", "end_acceleration"]
        .into_iter()
        .zip(end)
    {
        near(key, &case.expected[key], got, TOLERANCE)?;
    }
    values(case, |order, p| curve.derivative(order, p), |_| TOLERANCE)
}

#[derive(Deserialize)]
struct Jerks {
    p0: f64,
    v0: f64,
    a0: f64,
    segments: Vec<(f64, f64)>,
}

pub(super) fn piecewise_jerk(case: &LatticeCase) -> Result<(), String> {
    let input: Jerks = case.input()?;
    let curve = Piecewise::of_jerks([input.p0, input.v0, input.a0], &input.segments).ok_or("rejected")?;
    has_length(case, curve.length())?;
    values(case, |order, p| curve.derivative(order, p), |_| TOLERANCE)
}

#[derive(Deserialize)]
struct Quartics {
    segments: Vec<Ends>,
}

pub(super) fn piecewise_quartics(case: &LatticeCase) -> Result<(), String> {
    let input: Quartics = case.input()?;
    let pieces: Option<Vec<Polynomial>> = input.segments.iter().map(Ends::polynomial).collect();
    let curve = pieces
        .and_then(|pieces| Piecewise::new(&pieces))
        .ok_or("rejected")?;
    let ends: Vec<f64> = curve.ends().collect();
    all_near(
        "accumulated",
        &case.expected["accumulated"],
        &json!(ends),
        TOLERANCE,
    )?;
    has_length(case, curve.length())?;
    values(case, |order, p| curve.derivative(order, p), |_| TOLERANCE)
}

#[derive(Deserialize)]
struct Accelerations {
    s0: f64,
    v0: f64,
    segments: Vec<(f64, f64)>,
    #[serde(default)]
    eval_params: Vec<f64>,
}

impl Accelerations {
    fn profile(&self) -> Option<PiecewiseAcceleration> {
        let mut profile = PiecewiseAcceleration::from(self.s0, self.v0);
        self.segments
            .iter()
            .try_for_each(|(a, duration)| profile.push(*a, *duration))
            .ok()?;
        Some(profile)
    }
}

pub(super) fn piecewise_acceleration(case: &LatticeCase) -> Result<(), String> {
    let input: Accelerations = case.input()?;
    let profile = input
        .profile()
        .filter(|profile| input.eval_params.iter().all(|t| profile.at(*t).is_some()));
    let Some(profile) = profile else {
        return same("rejected", &case.fails(), &true);
    };
    if case.fails() {
        return Err("accepted, but it goes back or is asked beyond its end".to_owned());
    }
    has_length(case, profile.length())?;
    has_knots(case, &profile)?;
    let accelerations: Vec<f64> = std::iter::once(0.0)
        .chain(input.segments.iter().map(|(a, _)| *a))
        .collect();
    all_near(
        "knot_a",
        &case.expected["knot_a"],
        &json!(accelerations),
        TOLERANCE,
    )?;
    let at = |order: usize, t: f64| {
        let state = profile.at(t).unwrap_or([f64::NAN; 3]);
        state.get(order).copied().unwrap_or(0.0)
    };
    values(case, at, |_| TOLERANCE)
}

pub(super) fn piecewise_order(case: &LatticeCase) -> Result<(), String> {
    let input: Accelerations = case.input()?;
    let profile = input.profile().ok_or("rejected")?;
    let at = |t: &f64| profile.at(*t).map_or(f64::NAN, |[_, _, a]| a);
    let got: Vec<f64> = input.eval_params.iter().map(at).collect();
    all_near(
        "acceleration",
        &case.expected["acceleration"],
        &json!(got),
        TOLERANCE,
    )
}
