//! Sweeps: many runs at once, and what can be said of them.

pub mod statistics;
