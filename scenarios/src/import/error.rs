//! Why a map file cannot be read, and where in the file.

use corridor_decider::road::MapError;
use std::fmt;

/// A place in a text file; both numbers count from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextPlace {
    /// Line.
    pub line: usize,
    /// Column in characters.
    pub column: usize,
}

impl fmt::Display for TextPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.line, self.column)
    }
}

/// Why a map file cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImportError {
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// The text is not well-formed XML.
    #[error("{place}: not well-formed XML: {problem}")]
    Xml {
        /// Where the XML reader gave up.
        place: TextPlace,
        /// What it said.
        problem: String,
    },
    /// An element that is incomplete, contradictory or out of range.
    #[error("{place}: <{element}> {problem}; expected {expected}")]
    Element {
        /// Where the element starts.
        place: TextPlace,
        /// Name of the element.
        element: String,
        /// What is wrong with it.
        problem: String,
        /// What would be right.
        expected: String,
    },
    /// The text is not in the text form of protocol buffers.
    #[error("{place}: {problem}; expected {expected}")]
    Text {
        /// Where it is wrong.
        place: TextPlace,
        /// What is wrong.
        problem: String,
        /// What would be right.
        expected: String,
    },
    /// The bytes are not the binary form of a message.
    #[error("byte {at}: {problem}; expected {expected}")]
    Bytes {
        /// Where it is wrong, counted from 0.
        at: usize,
        /// What is wrong.
        problem: String,
        /// What would be right.
        expected: String,
    },
    /// A field of a message that is missing, contradictory or out of range.
    #[error("{}{path} {problem}; expected {expected}", before(*.place))]
    Field {
        /// Where it is, in a text.
        place: Option<TextPlace>,
        /// The field, as in `lane[3].central_curve`.
        path: String,
        /// What is wrong with it.
        problem: String,
        /// What would be right.
        expected: String,
    },
    /// The map would not fit into memory or time.
    #[error(
        "{place}: the map is larger than {limit} at road `{road}`; expected at most that much road surface"
    )]
    TooLarge {
        /// The road that passed the limit.
        place: TextPlace,
        /// Its id.
        road: String,
        /// The limit in words.
        limit: &'static str,
    },
    /// A planning problem that the file does not have.
    #[error("there is no planning problem `{id}`; expected {}", if .known.is_empty() { "none, the file has no problem" } else { .known.as_str() })]
    NoProblem {
        /// Its id.
        id: i64,
        /// Those that there are, for people.
        known: String,
    },
    /// A road on which nothing can be driven along.
    #[error("there is no way to drive: {0}")]
    NoWay(String),
    /// Every element is readable but the whole is not a map.
    #[error("{0}")]
    Map(#[from] MapError),
    /// Any of the above, in a named file.
    #[error("{}", in_file(.file, .error))]
    InFile {
        /// The file as the caller named it.
        file: String,
        /// What is wrong in it.
        #[source]
        error: Box<ImportError>,
    },
}

impl ImportError {
    /// The place in the text, where there is one.
    pub fn place(&self) -> Option<TextPlace> {
        match self {
            Self::Xml { place, .. }
            | Self::Element { place, .. }
            | Self::Text { place, .. }
            | Self::TooLarge { place, .. } => Some(*place),
            Self::Field { place, .. } => *place,
            Self::InFile { error, .. } => error.place(),
            Self::Io(_) | Self::Map(_) | Self::Bytes { .. } | Self::NoProblem { .. } | Self::NoWay(_) => None,
        }
    }

    /// The same error at a place in a text, if it is one that can do without.
    pub(crate) fn at(mut self, at: Option<TextPlace>) -> Self {
        if let Self::Field { place, .. } = &mut self {
            *place = at;
        }
        self
    }
}

/// `file:line:column: problem`, the form that editors can jump to.
fn in_file(file: &str, error: &ImportError) -> String {
    match error.place() {
        Some(_) => format!("{file}:{error}"),
        None => format!("{file}: {error}"),
    }
}

/// A place and what separates it from the message.
fn before(place: Option<TextPlace>) -> String {
    place.map_or_else(String::new, |place| format!("{place}: "))
}
