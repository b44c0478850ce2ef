//! What can be wrong with a scenario file, each with the place in it.

use crate::import::ImportError;
use crate::validity::Rejection;
use std::fmt;
use std::ops::Range;
use std::path::PathBuf;

/// A place in a text file, with the line to show.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Name of the file.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The text of the line.
    pub text: String,
    /// How many characters are meant.
    pub width: usize,
}

impl Place {
    /// The place of a span of bytes in `text`.
    pub fn of(text: &str, file: &str, span: Range<usize>) -> Self {
        let start = floor_boundary(text, span.start);
        let end = floor_boundary(text, span.end.max(start));
        let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |at| start + at);
        Self {
            file: file.to_owned(),
            line: text[..start].matches('\n').count() + 1,
            column: text[line_start..start].chars().count() + 1,
            text: text[line_start..line_end].trim_end().to_owned(),
            width: text[start..end.min(line_end)].chars().count().max(1),
        }
    }

    /// The line with a marker under what is meant.
    fn excerpt(&self) -> String {
        let number = self.line.to_string();
        let gutter = " ".repeat(number.len());
        let (indent, marker) = (" ".repeat(self.column - 1), "^".repeat(self.width));
        format!(
            "\n{gutter} |\n{number} | {}\n{gutter} | {indent}{marker}",
            self.text
        )
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column)
    }
}

fn floor_boundary(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Why a scenario file is of no use.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ScenarioError {
    /// The file cannot be read.
    #[error("cannot read scenario `{}`: {source}", path.display())]
    Read {
        /// Its path.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A recorded scene in another format that cannot be read.
    #[error(transparent)]
    Import(#[from] ImportError),
    /// The text is no scenario.
    #[error("{place}: {problem}{}", place.excerpt())]
    Schema {
        /// Where.
        place: Box<Place>,
        /// What is wrong and what is expected.
        problem: String,
    },
    /// The folder of shared maps is not on this machine: the scenario can only be skipped.
    #[error("{place}: map `{map}`: there is no folder `{}`; set CORRIDOR_MAPS to the folder of shared maps{}",
        folder.display(), place.excerpt())]
    SharedMapsAbsent {
        /// Where it is asked for.
        place: Box<Place>,
        /// The map as written.
        map: String,
        /// Where the folder was looked for.
        folder: PathBuf,
    },
    /// There is no such map.
    #[error("{place}: no map `{map}`: {hint}{}", place.excerpt())]
    MapNotFound {
        /// Where it is asked for.
        place: Box<Place>,
        /// The map as written.
        map: String,
        /// Where it was looked for, or what there is.
        hint: String,
    },
    /// The map is there but broken.
    #[error("{place}: map `{map}`: {problem}{}", place.excerpt())]
    MapInvalid {
        /// Where it is asked for.
        place: Box<Place>,
        /// The map as written.
        map: String,
        /// What is wrong with it.
        problem: String,
    },
    /// A lane or a route that the map does not have.
    #[error("{place}: {problem}{}", place.excerpt())]
    Route {
        /// Where it is asked for.
        place: Box<Place>,
        /// What is wrong and what there is.
        problem: String,
    },
}

/// Why a seed gave no scenario.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DrawError {
    /// Nothing is random, and what is fixed is impossible.
    #[error("scenario `{family}` is impossible: {reason}")]
    Impossible {
        /// Name of the family.
        family: String,
        /// Why.
        reason: Rejection,
    },
    /// Every attempt was rejected.
    #[error("family `{family}`, seed {seed}: no possible scenario in {} attempts, the last one: {}",
        rejected.len(), rejected.last().map(ToString::to_string).unwrap_or_default())]
    Exhausted {
        /// Name of the family.
        family: String,
        /// The seed.
        seed: u64,
        /// The reasons, one per attempt.
        rejected: Vec<Rejection>,
    },
    /// A number that the draw was told cannot be had.
    #[error("family `{family}`: `{key}`: {problem}")]
    Told {
        /// Name of the family.
        family: String,
        /// Key path of the number.
        key: String,
        /// What is wrong.
        problem: String,
    },
    /// A scene that others recorded has no numbers to fix, and is not written as a scenario file.
    #[error("`{family}` is a recorded scene: it is fixed already")]
    Recorded {
        /// Name of the family.
        family: String,
    },
}

/// Why a planning problem cannot be chosen.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NoProblem {
    /// A scenario of this project.
    #[error("`{0}` is no CommonRoad scenario: only those have planning problems")]
    NotRecorded(String),
    /// A scene without a task.
    #[error("the file has no planning problem")]
    None,
    /// A number that is not in the file.
    #[error("the file has no planning problem `{id}`: expected {known}")]
    Unknown {
        /// The number that was asked for.
        id: i64,
        /// Those that there are.
        known: String,
    },
}
