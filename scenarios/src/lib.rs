//! Scenario files, map importers and the catalog.
//!
//! A file is either one scenario or, where a number is a distribution, a *family*; `(family, seed)` is one
//! [`Scenario`]. This crate knows roads and places; it knows neither physics nor the tick loop.
//!
//! ```text
//! text ──schema──▶ ScenarioFile ──┐
//!                                 ├─ Family ──draw(seed)──▶ numbers ─▶ places ─▶ validity ─▶ Scenario
//! map  ──import──▶ RoadMap ───────┘                            ▲                     │
//!                                                              └── next attempt ─────┘
//! ```

pub mod catalog;
pub mod error;
mod expectation;
mod family;
pub mod goal;
mod head_on;
pub mod import;
mod map_format;
mod map_source;
pub mod maps;
mod parameter;
pub mod random;
mod resolve;
mod route;
pub mod scenario;
pub mod schema;
mod starter;
mod validity;

pub use error::{DrawError, NoProblem, ScenarioError};
pub use family::{Drawn, Family};
pub use map_format::MapFormat;
pub use map_source::{LoadedMap, MapCache};
pub use parameter::Parameter;
pub use scenario::Scenario;
pub use starter::{StarterError, starter};
pub use validity::Rejection;
