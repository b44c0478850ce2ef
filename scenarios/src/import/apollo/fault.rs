//! What is wrong with a message, and which field of which message it is.

use crate::import::ImportError;
use std::fmt;

/// A mistake inside a message; the path to it grows outwards while it is handed on.
#[derive(Debug)]
pub(super) struct Fault {
    /// Field names from the inside out, each with its place among the repeated ones.
    path: Vec<(&'static str, Option<usize>)>,
    problem: String,
    expected: String,
}

impl Fault {
    pub(super) fn new(problem: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            path: Vec::new(),
            problem: problem.into(),
            expected: expected.into(),
        }
    }

    /// The field names from the outside in.
    pub(super) fn path(&self) -> impl Iterator<Item = (&'static str, Option<usize>)> + '_ {
        self.path.iter().rev().copied()
    }

    /// The same as an error of the importer, without a place in a text.
    pub(super) fn into_error(self) -> ImportError {
        ImportError::Field {
            place: None,
            path: Path(&self).to_string(),
            problem: self.problem,
            expected: self.expected,
        }
    }
}

/// A path as people write it: `lane[3].central_curve.segment[0]`.
struct Path<'a>(&'a Fault);

impl fmt::Display for Path<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (depth, (name, nth)) in self.0.path().enumerate() {
            let dot = if depth == 0 { "" } else { "." };
            write!(f, "{dot}{name}")?;
            if let Some(nth) = nth {
                write!(f, "[{nth}]")?;
            }
        }
        Ok(())
    }
}

/// Names the field that an answer was about.
pub(super) trait Inside {
    /// ... a field that occurs once.
    fn inside(self, name: &'static str) -> Self;
    /// ... a field that may be repeated.
    fn inside_nth(self, name: &'static str, nth: usize) -> Self;
}

impl<T> Inside for Result<T, Fault> {
    fn inside(self, name: &'static str) -> Self {
        self.map_err(|mut fault| {
            fault.path.push((name, None));
            fault
        })
    }

    fn inside_nth(self, name: &'static str, nth: usize) -> Self {
        self.map_err(|mut fault| {
            fault.path.push((name, Some(nth)));
            fault
        })
    }
}
