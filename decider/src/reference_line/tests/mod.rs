//! Tests of the reference line: its projection against brute force, and how it is made from lanes.

mod along;
mod projection;
mod warm;
