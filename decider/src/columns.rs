//! Writes a list of number records as one array per number, for `#[serde(with = "crate::columns")]`.
//!
//! A path of 200 points names its fields once instead of 200 times: a third of the bytes and of the time.
//! Numbers that are none (`NaN`, infinities) have no place in JSON; they are written as `"nan"`, `"inf"` and
//! `"-inf"`, so that a decision that went wrong can still be written, read and looked at.

use serde::de::{Error, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::marker::PhantomData;

/// A record that consists of numbers only.
pub(crate) trait Row: Copy {
    /// Names of the numbers.
    const NAMES: &'static [&'static str];

    /// The number in one column.
    fn number(&self, column: usize) -> f64;

    /// The record with these numbers, in the order of [`Row::NAMES`].
    fn from_numbers(number: impl Fn(usize) -> f64) -> Self;
}

/// A number that may be none.
pub(crate) struct Number(pub(crate) f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            v if v.is_finite() => serializer.serialize_f64(v),
            v if v.is_nan() => serializer.serialize_str("nan"),
            v => serializer.serialize_str(if v > 0.0 { "inf" } else { "-inf" }),
        }
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberVisitor;
        impl Visitor<'_> for NumberVisitor {
            type Value = Number;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, \"nan\", \"inf\" or \"-inf\"")
            }

            fn visit_f64<E>(self, v: f64) -> Result<Number, E> {
                Ok(Number(v))
            }

            fn visit_i64<E>(self, v: i64) -> Result<Number, E> {
                Ok(Number(v as f64))
            }

            fn visit_u64<E>(self, v: u64) -> Result<Number, E> {
                Ok(Number(v as f64))
            }

            fn visit_str<E: Error>(self, v: &str) -> Result<Number, E> {
                match v {
                    "nan" => Ok(Number(f64::NAN)),
                    "inf" => Ok(Number(f64::INFINITY)),
                    "-inf" => Ok(Number(f64::NEG_INFINITY)),
                    other => Err(E::invalid_value(serde::de::Unexpected::Str(other), &self)),
                }
            }
        }
        deserializer.deserialize_any(NumberVisitor)
    }
}

/// For `#[serde(with = "crate::columns::number")]` on a single number that may be none.
pub(crate) mod number {
    use super::Number;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[expect(
        clippy::trivially_copy_pass_by_ref,
        reason = "the signature that serde asks for"
    )]
    pub(crate) fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        Number(*value).serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Number::deserialize(deserializer).map(|number| number.0)
    }
}

/// One column of a list of records.
pub(crate) struct Column<'a, T, F>(pub(crate) &'a [T], pub(crate) F);

impl<T, F: Fn(&T) -> f64> Serialize for Column<'_, T, F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(|row| Number((self.1)(row))))
    }
}

/// Writes `rows` as `{name: [numbers], …}`.
pub(crate) fn serialize<T: Row, S: Serializer>(rows: &[T], serializer: S) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(Some(T::NAMES.len()))?;
    for (k, name) in T::NAMES.iter().enumerate() {
        map.serialize_entry(name, &Column(rows, |row: &T| row.number(k)))?;
    }
    map.end()
}

/// Reads what [`serialize`] wrote. Columns may come in any order and must be equally long.
pub(crate) fn deserialize<'de, T: Row, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<T>, D::Error> {
    deserializer.deserialize_map(RowsVisitor(PhantomData))
}

struct RowsVisitor<T>(PhantomData<T>);

impl<'de, T: Row> Visitor<'de> for RowsVisitor<T> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "equally long arrays called {}", T::NAMES.join(", "))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Vec<T>, A::Error> {
        let mut columns: Vec<Option<Vec<Number>>> = T::NAMES.iter().map(|_| None).collect();
        while let Some(name) = map.next_key::<String>()? {
            match T::NAMES.iter().position(|known| *known == name) {
                Some(k) => columns[k] = Some(map.next_value()?),
                None => return Err(A::Error::unknown_field(&name, T::NAMES)),
            }
        }
        let columns = columns
            .into_iter()
            .zip(T::NAMES)
            .map(|(column, name)| column.ok_or_else(|| A::Error::missing_field(name)))
            .collect::<Result<Vec<_>, _>>()?;
        let rows = columns.first().map_or(0, Vec::len);
        if let Some(k) = columns.iter().position(|column| column.len() != rows) {
            return Err(A::Error::invalid_length(columns[k].len(), &self));
        }
        Ok((0..rows)
            .map(|row| T::from_numbers(|k| columns[k][row].0))
            .collect())
    }
}
