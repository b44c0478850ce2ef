//! What can go wrong with a trace file.

use std::io;
use std::path::PathBuf;

/// Why a trace cannot be written or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TraceError {
    /// The file system said no.
    #[error("`{}`: {source}", path.display())]
    Io {
        /// The trace.
        path: PathBuf,
        /// What it said.
        source: io::Error,
    },
    /// The file holds nothing.
    #[error("`{}` is empty: not even the header of a trace was written", .0.display())]
    Empty(PathBuf),
    /// The file is something else.
    #[error("`{}` is not a trace: {reason}", path.display())]
    NotATrace {
        /// The file.
        path: PathBuf,
        /// What gave it away.
        reason: String,
    },
    /// Written by another version of the program.
    #[error("`{}` has trace format {found}; this program reads format {expected}", path.display())]
    Version {
        /// The trace.
        path: PathBuf,
        /// Its version.
        found: u32,
        /// Ours.
        expected: u32,
    },
    /// A line that is none of the records, or refers to what does not exist.
    #[error("`{}`, line {line}: {problem}", path.display())]
    Line {
        /// The trace.
        path: PathBuf,
        /// Number of the line in the decompressed text, from 1.
        line: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// The compressed data are damaged.
    #[error("`{}`, after line {line}: damaged: {reason}", path.display())]
    Damaged {
        /// The trace.
        path: PathBuf,
        /// Number of lines that could be read.
        line: usize,
        /// What the decompressor said.
        reason: String,
    },
    /// Longer than any run can be.
    #[error("`{}`, line {line}: more than {limit} bytes when decompressed", path.display())]
    TooLong {
        /// The trace.
        path: PathBuf,
        /// Where the limit was reached.
        line: usize,
        /// The limit that was reached, bytes.
        limit: u64,
    },
    /// A number of the frame or the controls is not finite: such a tick could not be decided again.
    #[error("tick {tick} cannot be written: a number of its frame, controls or ego is not finite")]
    NotFinite {
        /// The tick.
        tick: u32,
    },
}
