//! Scenario files from outside: what they may say, what is drawn from them, what is rejected.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod catalog;
mod drawing;
mod fixed;
mod mistakes;
mod parameters;
mod placing;
mod road;
mod validity;
