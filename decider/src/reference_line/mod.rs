//! The reference line: the curve that a tick plans along, with what it knows of the road beside it.
//!
//! Stations `s` run from the line's first point; `l` is positive to the left. A line is self-contained:
//! whoever has one needs no map. Semantics follow the original's `ReferenceLine` and `Path`.

mod clear;
mod curve;
mod foot;
mod line;
mod provider;
mod query;
mod smooth;
mod stitch;
#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod tests;
mod through;

pub use line::{LineError, LinePoint, LineSample, ReferenceLine};
pub use provider::{LineProvider, ProviderError, RouteLine};
pub use query::{LineQuery, SlPoint};
pub use stitch::StitchedLine;
