//! Scenario files, map importers and the catalog.
//!
//! A file is either one scenario or, where a number is a distribution, a *family*; `(family, seed)` is one
//! [`Scenario`]. This crate knows roads and places; it knows neither physics nor the tick loop.

pub mod import;
pub mod maps;
pub mod scenario;

pub use scenario::Scenario;
