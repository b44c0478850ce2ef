//! Faults planted on purpose: a sweep that comes out green is worth as much as the certainty that it would have come out
//! red.
//!
//! A fault is a decorator or a configuration outside of the decider: on the frame before it, on its memory between ticks,
//! on what one of its tasks hands on to the next, on the decision after it, on the trajectory before the tracker, on the
//! tracker, or in the settings and the car that the planner believes in. There is no branch for one inside the decider, the
//! original's defects ([`corridor_decider::quirks`]) apart, which are settings.
//!
//! Each stage of a tick has a list of its own here. [`hunt`](crate::sweep::hunt) looks for runs that show them.

mod bound;
mod decider;
mod failure;
mod following;
mod hints;
mod path;
mod perception;
mod planted;
mod quirks;
mod scenario;
mod spec;
mod speed;
#[cfg(test)]
mod tests;
mod tracker;

pub use failure::{Failure, Part};
pub(crate) use failure::{failing, without};
pub(crate) use following::Following;
pub use planted::Past;
pub(crate) use planted::Planted;
pub use spec::{Hint, Plant, Spec, Stage};

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// What a run without a fault has for one.
const NONE: &str = "none";

/// All faults, by stage.
pub fn all() -> impl Iterator<Item = &'static Spec> {
    let stages = [
        scenario::FAULTS,
        perception::FAULTS,
        decider::FAULTS,
        bound::FAULTS,
        path::FAULTS,
        speed::FAULTS,
        tracker::FAULTS,
        quirks::FAULTS,
    ];
    stages.into_iter().flatten()
}

/// Why there is no fault of a name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no fault is called `{name}`; there are: {known}")]
pub struct UnknownFault {
    name: String,
    known: String,
}

/// The fault that a run is made with, if any. Written as its name.
#[derive(Clone, Copy, Default)]
pub struct Fault(Option<&'static Spec>);

impl Fault {
    /// None.
    pub const NONE: Self = Self(None);

    /// The fault of this name; `none` is one.
    ///
    /// # Errors
    /// [`UnknownFault`] with the names there are.
    pub fn named(name: &str) -> Result<Self, UnknownFault> {
        if name == NONE {
            return Ok(Self::NONE);
        }
        let found = all().find(|spec| spec.name == name);
        found.map(|spec| Self(Some(spec))).ok_or_else(|| UnknownFault {
            name: name.to_owned(),
            known: [NONE]
                .into_iter()
                .chain(all().map(|spec| spec.name))
                .collect::<Vec<&str>>()
                .join(", "),
        })
    }

    /// What it is; `None`: there is none.
    pub fn spec(self) -> Option<&'static Spec> {
        self.0
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        self.0.map_or(NONE, |spec| spec.name)
    }
}

impl From<&'static Spec> for Fault {
    fn from(spec: &'static Spec) -> Self {
        Self(Some(spec))
    }
}

impl PartialEq for Fault {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Eq for Fault {}

impl fmt::Debug for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Serialize for Fault {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for Fault {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        Self::named(&name).map_err(D::Error::custom)
    }
}
