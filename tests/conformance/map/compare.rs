//! Two JSON values, one expected and one answered, number by number.

use corridor_decider::geometry::angle;
use serde_json::Value;

/// Largest difference of a length, m.
const LENGTH: f64 = 1e-6;

/// Largest difference of an angle, rad.
const ANGLE: f64 = 1e-9;

/// Largest difference of a derivative in the Frenet frame, relative to it.
const DERIVATIVE: f64 = 1e-6;

/// What the nearest named value around a number says about it.
#[derive(Clone, Copy)]
enum Measure {
    Length,
    Angle,
    Derivative,
}

impl Measure {
    fn of(key: &str) -> Self {
        match key {
            "heading" | "headings" | "heading_along_path" => Self::Angle,
            "to_frenet_s" | "to_frenet_l" => Self::Derivative,
            _ => Self::Length,
        }
    }

    fn agrees(self, expected: f64, got: f64) -> bool {
        match self {
            Self::Length => (expected - got).abs() <= LENGTH,
            Self::Angle => angle::difference(expected, got).abs() <= ANGLE,
            Self::Derivative => (expected - got).abs() <= LENGTH.max(DERIVATIVE * expected.abs()),
        }
    }
}

/// The error names the first place where they differ.
pub(super) fn compare(expected: &Value, got: &Value) -> Result<(), String> {
    walk(expected, got, Measure::Length, "")
}

/// The same for one value of a case, named `place`.
pub(super) fn compare_at(place: &str, expected: &Value, got: &Value) -> Result<(), String> {
    walk(expected, got, Measure::of(place), place)
}

fn walk(expected: &Value, got: &Value, measure: Measure, place: &str) -> Result<(), String> {
    match (expected, got) {
        (Value::Object(wanted), Value::Object(have)) => {
            let missing = wanted.keys().find(|key| !have.contains_key(*key));
            let surplus = have.keys().find(|key| !wanted.contains_key(*key));
            if let Some(key) = missing.or(surplus) {
                return Err(format!(
                    "{place}.{key}: expected {}, got {}",
                    expected[key], got[key]
                ));
            }
            let mut keys = wanted.keys();
            keys.try_for_each(|key| {
                walk(
                    &expected[key],
                    &got[key],
                    Measure::of(key),
                    &format!("{place}.{key}"),
                )
            })
        }
        (Value::Array(wanted), Value::Array(have)) if wanted.len() == have.len() => {
            let mut pairs = wanted.iter().zip(have).enumerate();
            pairs.try_for_each(|(k, (wanted, have))| walk(wanted, have, measure, &format!("{place}[{k}]")))
        }
        (Value::Number(wanted), Value::Number(have)) => match (wanted.as_f64(), have.as_f64()) {
            (Some(wanted), Some(have)) if measure.agrees(wanted, have) => Ok(()),
            _ => Err(format!("{place}: expected {expected}, got {got}")),
        },
        _ if expected == got => Ok(()),
        _ => Err(format!("{place}: expected {expected}, got {got}")),
    }
}
