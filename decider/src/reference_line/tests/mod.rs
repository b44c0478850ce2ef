//! Tests of the reference line: its projection against brute force, how it is made from lanes, and how it grows.

mod along;
mod line;
mod projection;
mod stitch;
mod warm;
