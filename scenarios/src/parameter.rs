//! The numbers of a family that its seeds draw, and telling a draw what some of them shall be.

use crate::schema::LawKind;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A number that a law gave in one draw.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// Its key path in the file, such as `parked[0].ahead`; with the place in the row where there is a `count`, as in
    /// `parked[0].l[3]`.
    pub key: String,
    /// The number.
    pub value: f64,
    /// Its place in the law, by the law's distribution function, from 0 to 1; in the middle of the jump where that
    /// function jumps.
    pub quantile: f64,
    /// The kind of law.
    pub law: LawKind,
    /// The smallest number that the law gives.
    pub low: f64,
    /// The largest one.
    pub high: f64,
    /// How many different numbers it gives, where they can be counted.
    pub steps: Option<usize>,
}

/// What some numbers of a draw shall be, by key path.
#[derive(Clone, Debug)]
pub(crate) enum Told {
    /// Nothing is told.
    Nothing,
    /// Quantiles of their laws.
    Quantiles(BTreeMap<String, f64>),
    /// The numbers themselves.
    Values(BTreeMap<String, f64>),
}
