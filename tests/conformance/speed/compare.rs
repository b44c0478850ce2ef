//! Two JSON values, one expected and one answered: numbers nearly, all else exactly. What the expectation leaves unset
//! is not compared; what the answer has beyond it neither.

use serde_json::Value;

/// Largest difference of a number, in its unit.
const ABSOLUTE: f64 = 1e-9;

/// The same relative to it.
const RELATIVE: f64 = 1e-9;

/// The error names the first place where they differ.
pub(super) fn compare(expected: &Value, got: &Value) -> Result<(), String> {
    walk(expected, got, "")
}

/// Whether two numbers agree.
pub(super) fn agree(expected: f64, got: f64) -> bool {
    (expected - got).abs() <= ABSOLUTE.max(RELATIVE * expected.abs())
}

fn walk(expected: &Value, got: &Value, place: &str) -> Result<(), String> {
    let differ = || Err(format!("{place}: expected {expected}, got {got}"));
    match (expected, got) {
        (Value::Null, _) => Ok(()),
        (Value::Object(wanted), Value::Object(have)) => wanted.iter().try_for_each(|(key, wanted)| {
            let have = have.get(key).unwrap_or(&Value::Null);
            walk(wanted, have, &format!("{place}.{key}"))
        }),
        (Value::Array(wanted), Value::Array(have)) if wanted.len() == have.len() => {
            let mut pairs = wanted.iter().zip(have).enumerate();
            pairs.try_for_each(|(k, (wanted, have))| walk(wanted, have, &format!("{place}[{k}]")))
        }
        (Value::Number(wanted), Value::Number(have)) => match (wanted.as_f64(), have.as_f64()) {
            (Some(wanted), Some(have)) if agree(wanted, have) => Ok(()),
            _ => differ(),
        },
        _ if expected == got => Ok(()),
        _ => differ(),
    }
}
