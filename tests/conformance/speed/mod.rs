//! Cases of the speed tasks: boundaries, the search, the speed decider, RSS, lane changes and fallback profiles.
//!
//! Where a case shows a defect of the original and names the repaired result, that result counts, as far as it is
//! given. Where it names none, and where Corridor knowingly goes its own way, this is compared:
//!
//! - `dp.search`, marked `fragile`: such a case lies on a tie that a change of 1e-9 decides, so that another profile is
//!   as right; the status and, if the total cost is the expected one, all else; the last point of a profile has a speed
//!   in Corridor and is not compared;
//! - `speed_decider.execute` with a rejected stop for a pedestrian: the obstacle has to be ignored, not undecided;
//! - `rss.execute`, mirrored sides: left and right are swapped in the expectation; straddling obstacles: gap and safe
//!   distance are computed here from the formula for the nearest obstacle that overlaps the lane; a negative speed: the
//!   answer for 0;
//! - `fallback_speed.constant_deceleration`: the original's points as long as the car moves; from then on, the exact
//!   distance of the stop, and standing (the original goes on braking with the car at rest, or ends while it moves);
//! - `speed_profile.fixed_distance_creep`: the original's profile never brakes, and nothing in the lane-follow pipeline
//!   asks for it; the expectation is checked against the formula with the wrong sign, which stands only here;
//! - numbers that the original leaves unset are not compared.

mod boundary;
mod compare;
mod decider;
mod fallback;
mod heuristic;
mod lane_change;
mod profile;
mod rss;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

/// One case.
#[derive(Deserialize)]
pub(crate) struct SpeedCase {
    pub(crate) name: String,
    function: String,
    input: Value,
    expected: Value,
    expected_fixed: Option<Value>,
    defect: Option<String>,
    #[serde(default)]
    fragile: bool,
}

/// Whether a function is one of the speed tasks'.
pub(crate) fn knows(function: &str) -> bool {
    let families = [
        "st_boundary.",
        "speed_limit.",
        "speed_data.",
        "dp.",
        "speed_decider.",
        "rss.",
        "lane_change.",
        "fallback_speed.",
        "speed_profile.",
    ];
    families.iter().any(|family| function.starts_with(family))
}

/// Answers a case and compares.
pub(crate) fn check(case: &SpeedCase) -> Result<(), String> {
    let (family, function) = case.function.split_once('.').unwrap_or((&case.function, ""));
    match family {
        "st_boundary" => boundary::check(case, function),
        "speed_limit" => profile::limit(case),
        "speed_data" => profile::data(case, function),
        "dp" => heuristic::check(case, function),
        "speed_decider" => decider::check(case, function),
        "rss" => rss::check(case),
        "lane_change" => lane_change::check(case, function),
        "fallback_speed" | "speed_profile" => fallback::check(case, function),
        _ => Err(case.unknown()),
    }
}

impl SpeedCase {
    fn input<T: DeserializeOwned>(&self) -> Result<T, String> {
        T::deserialize(&self.input).map_err(|error| format!("input: {error}"))
    }

    fn unknown(&self) -> String {
        format!("unknown function `{}`", self.function)
    }

    /// Compares with the repaired result if there is one, else with the original's.
    fn expect(&self, answer: &Value) -> Result<(), String> {
        compare::compare(self.expected_fixed.as_ref().unwrap_or(&self.expected), answer)
    }

    fn is_defect(&self, words: &str) -> bool {
        self.defect.as_ref().is_some_and(|defect| defect.contains(words))
    }
}

/// What a fatal check of the original is here.
fn check_failed() -> Value {
    json!({ "error": "check_failed" })
}

/// A number that JSON may not know.
#[derive(Clone, Copy, Deserialize)]
#[serde(untagged)]
enum Number {
    Plain(f64),
    Named(Name),
}

#[derive(Clone, Copy, Deserialize)]
enum Name {
    #[serde(rename = "inf", alias = "max")]
    Infinite,
    #[serde(rename = "-inf", alias = "-max")]
    NegativelyInfinite,
    #[serde(rename = "nan")]
    NotANumber,
}

impl Number {
    fn value(self) -> f64 {
        match self {
            Self::Plain(value) => value,
            Self::Named(Name::Infinite) => f64::INFINITY,
            Self::Named(Name::NegativelyInfinite) => -f64::INFINITY,
            Self::Named(Name::NotANumber) => f64::NAN,
        }
    }
}

/// A number as the cases write it.
fn number(value: f64) -> Value {
    if value.is_infinite() {
        json!(if value > 0.0 { "inf" } else { "-inf" })
    } else {
        json!(value)
    }
}

/// Rows `[t, s, v, a, da]` of a profile.
fn rows(profile: &corridor_decider::st_graph::SpeedData) -> Vec<[f64; 5]> {
    let row = |point: &corridor_decider::st_graph::SpeedPoint| [point.t, point.s, point.v, point.a, point.da];
    profile.points.iter().map(row).collect()
}
