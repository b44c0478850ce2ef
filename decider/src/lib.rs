//! Decides, tick by tick, how far left and right a car may be at each point ahead, and drives a path
//! inside that corridor.
//!
//! Everything is a pure function of a [`frame::Frame`] and a context: no clock, no file, no thread, no random
//! number. Units are SI (m, s, rad, m/s, m/s²), angles counter-clockwise in `(-π, π]`, braking negative.
//! In the Frenet frame of a reference line `s` runs forward from its first point and `l` is positive to the
//! **left**; a bound is `(s, l_min, l_max)`, right then left, for the centre of the rear axle.

mod banded;
pub mod baseline;
mod columns;
pub mod config;
pub mod context;
pub mod decision;
pub mod fallback;
pub mod frame;
pub mod geometry;
pub mod hd_map;
pub mod lane_follow_map;
pub mod lattice;
pub mod piecewise_jerk;
pub mod planner;
pub mod quirks;
pub mod reference_line;
pub mod road;
pub mod routing;
pub mod st_graph;
pub mod steps;
pub mod tasks;
pub mod trajectory;
pub mod vehicle;
