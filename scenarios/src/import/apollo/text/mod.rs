//! The text form of protocol buffers: `name: value`, `name { ... }`, `# comment`.
//!
//! Source: the public language description of the text format. Three steps: `lexer` finds tokens, `parser` nests
//! them into [`Field`]s, `value` turns those into the values of messages. Extensions and `Any` are not read.

mod lexer;
mod parser;
mod value;

pub(super) use parser::{Content, Field, Parser};
pub(super) use value::{Slot, Value};

use crate::import::{ImportError, TextPlace};

/// A mistake at a byte of the text.
#[derive(Debug, PartialEq)]
pub(super) struct TextError {
    at: usize,
    problem: String,
    expected: String,
}

impl TextError {
    fn new(at: usize, problem: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            at,
            problem: problem.into(),
            expected: expected.into(),
        }
    }

    /// The same as an error of the importer.
    pub(super) fn into_error(self, text: &str) -> ImportError {
        ImportError::Text {
            place: place(text, self.at),
            problem: self.problem,
            expected: self.expected,
        }
    }
}

/// Line and column of a byte.
pub(super) fn place(text: &str, at: usize) -> TextPlace {
    let at = (0..=at.min(text.len()))
        .rev()
        .find(|at| text.is_char_boundary(*at))
        .unwrap_or(0);
    let before = &text[..at];
    let start = before.rfind('\n').map_or(0, |end| end + 1);
    let line = before.matches('\n').count() + 1;
    let column = before[start..].chars().count() + 1;
    TextPlace { line, column }
}

#[cfg(test)]
mod tests;
