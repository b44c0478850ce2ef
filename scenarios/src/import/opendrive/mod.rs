//! OpenDRIVE 1.1 to 1.8 (`.xodr`): roads in exact double-precision geometry, projected to the plane.
//!
//! Source: ASAM OpenDRIVE, sections on road geometry, lanes and junctions. Elevation, superelevation, objects and
//! signals are not read. Lanes of the result run in driving direction; names are `road_section_lane`, with
//! sections counted from 0 as in the file.
//!
//! The steps: `records` checks what the elements say, `topology` joins lane ends by the
//! file's links, `build` samples each section into lanes, `connect` holds the links against the geometry.

mod budget;
mod build;
mod connect;
mod cross_section;
mod geometry;
mod lane_build;
mod lane_read;
mod marks;
mod plan_view;
mod profile;
mod record;
mod records;
mod surface;
mod topology;

#[cfg(test)]
mod tests;

use super::ImportError;
use super::notes::Notes;
use super::xml::{Element, Lines};
use corridor_decider::road::RoadMap;
use std::path::Path;

/// What became of a file.
#[derive(Clone, Debug)]
pub struct OpenDriveImport {
    /// The lanes.
    pub map: RoadMap,
    /// What was survived on the way, one line each, with line and column.
    pub warnings: Vec<String>,
}

/// Reads the text of an OpenDRIVE file.
///
/// # Errors
/// [`ImportError`] with line and column when the text is not an OpenDRIVE map that can be driven on.
pub fn read(text: &str) -> Result<OpenDriveImport, ImportError> {
    let lines = Lines::new(text, "OpenDRIVE");
    let document = lines.parse()?;
    let root = Element::root(&document, &lines, "OpenDRIVE")?;
    let mut notes = Notes::new(&lines);
    let roads = records::roads(root, &mut notes)?;
    let junctions = records::junctions(root, &mut notes)?;
    let map = build::build(&roads, &junctions, &lines, &mut notes)?;
    Ok(OpenDriveImport {
        map,
        warnings: notes.into_warnings(),
    })
}

/// Reads an OpenDRIVE file. Bytes that are not UTF-8 (names in older encodings) are replaced.
///
/// # Errors
/// [`ImportError::InFile`] with the file's name around what [`read`] or the file system says.
pub fn read_file(path: &Path) -> Result<OpenDriveImport, ImportError> {
    let bytes = std::fs::read(path).map_err(ImportError::Io);
    bytes
        .and_then(|bytes| read(&String::from_utf8_lossy(&bytes)))
        .map_err(|error| ImportError::InFile {
            file: path.display().to_string(),
            error: Box::new(error),
        })
}
