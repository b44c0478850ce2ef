//! The program from outside: exit codes, messages, and what is left behind in a folder.
//!
//! Exit codes are 0 for passed, 1 for a failed gate, 2 for wrong use or bad input. A message names the file, the
//! place in it, what is wrong and what would be right; a mistake leaves no file behind.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod blame;
mod endings;
mod fixing;
mod inputs;
mod maps;
mod outputs;
mod planners;
mod program;
mod recorded;
mod results;
mod settings;
mod traces;
