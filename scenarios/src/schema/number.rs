//! A number of a scenario file: fixed, or a law to draw it from.
//!
//! `3.5`, `{ uniform = [2, 8] }`, `{ normal = [5, 1], clamp = [2, 8] }`, `{ choice = [2, 4, 8] }`. The range that
//! a place in the file allows is checked while reading, so that a message points at the value itself.

use super::law::Law;
use crate::parameter::Parameter;
use crate::random::Stream;
use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// Keys of a law.
pub(crate) const LAW_KEYS: &[&str] = &["uniform", "normal", "clamp", "choice"];

/// The numbers a place in the file allows.
pub trait Range {
    /// Smallest one.
    const LOW: f64;
    /// Largest one.
    const HIGH: f64;
    /// Whether only whole numbers are allowed.
    const WHOLE: bool = false;
    /// What it is, for messages.
    const WHAT: &'static str;

    /// What is wrong with `value`, if anything is.
    fn problem(value: f64) -> Option<String> {
        let fits = (Self::LOW..=Self::HIGH).contains(&value) && (!Self::WHOLE || value.fract() == 0.0);
        (!fits).then(|| {
            format!(
                "`{value}` does not fit: expected {} from {} to {}",
                Self::WHAT,
                Self::LOW,
                Self::HIGH
            )
        })
    }
}

macro_rules! range {
    ($(#[$doc:meta])* $name:ident, $low:expr, $high:expr, $what:literal $(, $whole:literal)?) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name;
        impl Range for $name {
            const LOW: f64 = $low;
            const HIGH: f64 = $high;
            const WHAT: &'static str = $what;
            $(const WHOLE: bool = $whole;)?
        }
    };
}

range!(
    /// A station or an offset; far beyond any map that a run could need.
    Metres, -100_000.0, 100_000.0, "a number of metres"
);
range!(
    /// A length that is at least nothing.
    Length, 0.0, 100_000.0, "a number of metres"
);
range!(
    /// An edge of a body; from a bollard to a road train.
    Size, 0.05, 50.0, "a size in metres"
);
range!(
    /// A speed; the upper end is 252 km/h.
    Speed, 0.0, 70.0, "a speed in m/s"
);
range!(
    /// A speed that is not zero.
    MovingSpeed, 0.1, 70.0, "a speed in m/s"
);
range!(
    /// An angle, up to a full turn either way.
    Angle, -std::f64::consts::TAU, std::f64::consts::TAU, "an angle in rad"
);
range!(
    /// How far something swings open.
    Swing, 0.1, 1.5, "an angle in rad"
);
range!(
    /// A time in a run; no run is longer than an hour.
    Seconds, 0.0, 3600.0, "a time in s"
);
range!(
    /// A duration that is not zero.
    Duration, 0.1, 3600.0, "a duration in s"
);
range!(
    /// A positive acceleration.
    Acceleration, 0.1, 20.0, "an acceleration in m/s²"
);
range!(
    /// A braking acceleration.
    Braking, -20.0, -0.1, "a negative acceleration in m/s²"
);
range!(
    /// A part of a whole.
    Share, 0.0, 1.0, "a share"
);
range!(
    /// How many of a row.
    Count, 1.0, 200.0, "a whole number", true
);

/// A number in the range `R`, or a law to draw it from.
#[derive(Clone, Debug, PartialEq)]
pub struct Number<R> {
    law: Law,
    range: PhantomData<R>,
}

impl<R: Range> Number<R> {
    /// A number that is always the same.
    pub fn fixed(value: f64) -> Self {
        Self::of(Law::Fixed(value))
    }

    fn of(law: Law) -> Self {
        Self {
            law,
            range: PhantomData,
        }
    }

    /// The number, if it is always the same.
    pub fn value(&self) -> Option<f64> {
        match self.law {
            Law::Fixed(value) => Some(value),
            _ => None,
        }
    }

    /// The largest number it can be.
    pub fn upper_end(&self) -> f64 {
        self.law.ends().1
    }

    /// Draws the number. A whole uniform number takes both ends.
    pub fn draw(&self, stream: &mut Stream) -> f64 {
        self.law.draw(stream, R::WHOLE)
    }

    /// The number at a quantile of its law, from 0 to 1.
    pub fn at(&self, quantile: f64) -> f64 {
        self.law.at(quantile, R::WHOLE)
    }

    /// What there is to tell of `value`, which its law gave for the number called `key`; nothing where it has no law.
    pub fn parameter(&self, key: String, value: f64) -> Option<Parameter> {
        let (low, high) = self.law.ends();
        self.law.kind().map(|law| Parameter {
            key,
            value,
            quantile: self.law.quantile(value, R::WHOLE),
            law,
            low,
            high,
            steps: self.law.steps(R::WHOLE),
        })
    }
}

impl<'de, R: Range> Deserialize<'de> for Number<R> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberVisitor(PhantomData))
    }
}

struct NumberVisitor<R>(PhantomData<R>);

impl<'de, R: Range> Visitor<'de> for NumberVisitor<R> {
    type Value = Number<R>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} or a law such as {{ uniform = [1, 2] }}", R::WHAT)
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Self::Value, E> {
        PlainVisitor::<R>(PhantomData)
            .visit_f64(value)
            .map(|v| Number::fixed(v.value))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Self::Value, E> {
        self.visit_f64(value as f64)
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Self::Value, E> {
        self.visit_f64(value as f64)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let (mut law, mut clamp) = (None, None);
        while let Some(key) = map.next_key::<String>()? {
            let next = match key.as_str() {
                "clamp" => {
                    clamp = Some(map.next_value::<Ends<R>>()?);
                    continue;
                }
                "uniform" => {
                    let ends: Ends<R> = map.next_value()?;
                    Law::Uniform(ends.low, ends.high)
                }
                "normal" => {
                    let bell: Bell = map.next_value()?;
                    Law::Normal {
                        mean: bell.mean,
                        standard_deviation: bell.standard_deviation,
                        clamp: (0.0, 0.0),
                    }
                }
                "choice" => Law::Choice(map.next_value::<Choices<R>>()?.values),
                other => return Err(de::Error::unknown_field(other, LAW_KEYS)),
            };
            if law.replace(next).is_some() {
                return Err(de::Error::custom("one law only: `uniform`, `normal` or `choice`"));
            }
        }
        finish(law, clamp)
    }
}

/// Puts a law and its clamp together: a normal law needs one, the others must not have one.
fn finish<R: Range, E: de::Error>(law: Option<Law>, clamp: Option<Ends<R>>) -> Result<Number<R>, E> {
    match (law, clamp) {
        (
            Some(Law::Normal {
                mean,
                standard_deviation,
                ..
            }),
            Some(ends),
        ) => Ok(Number::of(Law::Normal {
            mean,
            standard_deviation,
            clamp: (ends.low, ends.high),
        })),
        (Some(Law::Normal { .. }), None) => Err(E::custom(
            "a normal law needs the ends it may reach, such as `clamp = [2, 8]`",
        )),
        (Some(law), None) => Ok(Number::of(law)),
        (Some(_), Some(_)) => Err(E::custom("`clamp` belongs to `normal` only")),
        (None, _) => Err(E::custom(
            "a law is missing: expected `uniform`, `normal` or `choice`",
        )),
    }
}

/// A plain number in the range `R`. Read by a visitor of its own, so that a mistake inside a list has its place.
struct Plain<R> {
    value: f64,
    range: PhantomData<R>,
}

impl<'de, R: Range> Deserialize<'de> for Plain<R> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(PlainVisitor(PhantomData))
    }
}

struct PlainVisitor<R>(PhantomData<R>);

impl<R: Range> Visitor<'_> for PlainVisitor<R> {
    type Value = Plain<R>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(R::WHAT)
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Self::Value, E> {
        match R::problem(value) {
            Some(problem) => Err(E::custom(problem)),
            None => Ok(Plain {
                value,
                range: PhantomData,
            }),
        }
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Self::Value, E> {
        self.visit_f64(value as f64)
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Self::Value, E> {
        self.visit_f64(value as f64)
    }
}

/// `[low, high]`, ascending.
#[derive(Deserialize)]
#[serde(try_from = "[Plain<R>; 2]", bound = "R: Range")]
struct Ends<R: Range> {
    low: f64,
    high: f64,
    range: PhantomData<R>,
}

impl<R: Range> TryFrom<[Plain<R>; 2]> for Ends<R> {
    type Error = String;

    fn try_from([low, high]: [Plain<R>; 2]) -> Result<Self, String> {
        if low.value > high.value {
            return Err(format!(
                "`{}` to `{}` is no range: the smaller one first",
                low.value, high.value
            ));
        }
        Ok(Self {
            low: low.value,
            high: high.value,
            range: PhantomData,
        })
    }
}

/// `[mean, standard deviation]`.
#[derive(Deserialize)]
#[serde(try_from = "[f64; 2]")]
struct Bell {
    mean: f64,
    standard_deviation: f64,
}

impl TryFrom<[f64; 2]> for Bell {
    type Error = &'static str;

    fn try_from([mean, standard_deviation]: [f64; 2]) -> Result<Self, &'static str> {
        if !mean.is_finite() || !standard_deviation.is_finite() || standard_deviation < 0.0 {
            return Err("expected `[mean, standard deviation]`, both finite, the second not negative");
        }
        Ok(Self {
            mean,
            standard_deviation,
        })
    }
}

/// A list to choose from, not empty.
#[derive(Deserialize)]
#[serde(try_from = "Vec<Plain<R>>", bound = "R: Range")]
struct Choices<R: Range> {
    values: Vec<f64>,
    range: PhantomData<R>,
}

impl<R: Range> TryFrom<Vec<Plain<R>>> for Choices<R> {
    type Error = &'static str;

    fn try_from(values: Vec<Plain<R>>) -> Result<Self, &'static str> {
        if values.is_empty() {
            return Err("nothing to choose from: expected at least one number");
        }
        Ok(Self {
            values: values.into_iter().map(|v| v.value).collect(),
            range: PhantomData,
        })
    }
}
