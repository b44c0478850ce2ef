//! Map importers: files of other people's formats in, a [`RoadMap`](corridor_decider::road::RoadMap) out.
//!
//! A reader survives what real files contain and tells it as a warning; what it cannot read it refuses with the
//! line, the column and what would have been right. No input makes it panic or run without end.

pub mod apollo;
pub mod commonroad;
mod error;
pub mod lanelet2;
mod lanelets;
mod notes;
pub mod opendrive;
mod xml;

pub use error::{ImportError, TextPlace};

use std::path::Path;

/// Reads a file as text and that by `read`. Bytes that are not UTF-8 (names in older encodings) are replaced.
///
/// # Errors
/// [`ImportError::InFile`] with the file's name around what `read` or the file system says.
fn read_file<T>(path: &Path, read: impl FnOnce(&str) -> Result<T, ImportError>) -> Result<T, ImportError> {
    let bytes = std::fs::read(path).map_err(ImportError::Io);
    bytes
        .and_then(|bytes| read(&String::from_utf8_lossy(&bytes)))
        .map_err(|error| ImportError::InFile {
            file: path.display().to_string(),
            error: Box::new(error),
        })
}
