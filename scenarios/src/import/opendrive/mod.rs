//! OpenDRIVE 1.1 to 1.8 (`.xodr`): roads in exact double-precision geometry, projected to the plane.
//!
//! Source: ASAM OpenDRIVE, sections on road geometry, lanes, junctions, objects and signals. Elevation and
//! superelevation are not read, of the signals only speed limits. Lanes of the result run in driving direction; names
//! are `road_section_lane`, with sections counted from 0 as in the file; a lane for both directions is two, of which
//! the one against its side's direction has an `r` behind its name. A section that another road joins in its middle
//! counts as two.
//!
//! The steps: `records` checks what the elements say, `topology` joins lane ends by the
//! file's links, `build` samples each section into lanes, `connect` holds the links against the geometry.

mod budget;
mod build;
mod connect;
mod cross_section;
mod geometry;
mod header;
mod lane_build;
mod lane_read;
mod limits;
mod marks;
mod objects;
mod plan_view;
mod profile;
mod record;
mod records;
mod signals;
mod split;
mod surface;
mod topology;

#[cfg(test)]
mod tests;

pub use objects::{MapObject, ObjectKind};

use super::ImportError;
use super::notes::Notes;
use super::xml::{Element, Lines};
use budget::Budget;
use corridor_decider::road::RoadMap;
use std::path::Path;

/// How a file is to be understood where files differ from each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Settings {
    /// Whether `laneChange` of a road mark may forbid what its type allows. Off: files exist whose broken lines all
    /// say `none`. It never allows what the type forbids.
    pub trust_lane_change: bool,
}

/// What became of a file.
#[derive(Clone, Debug)]
pub struct OpenDriveImport {
    /// The lanes.
    pub map: RoadMap,
    /// What is on and beside the roads.
    pub objects: Vec<MapObject>,
    /// How the coordinates lie on the earth, as the file says it: a PROJ string. Nothing is projected.
    pub geo_reference: Option<String>,
    /// What was survived on the way, one line each, with line and column.
    pub warnings: Vec<String>,
}

/// Reads the text of an OpenDRIVE file.
///
/// # Errors
/// [`ImportError`] with line and column when the text is not an OpenDRIVE map that can be driven on.
pub fn read(text: &str) -> Result<OpenDriveImport, ImportError> {
    read_with(text, Settings::default())
}

/// Reads the text of an OpenDRIVE file with other settings than the usual ones.
///
/// # Errors
/// Those of [`read`].
pub fn read_with(text: &str, settings: Settings) -> Result<OpenDriveImport, ImportError> {
    let lines = Lines::new(text, "OpenDRIVE");
    let document = lines.parse()?;
    let root = Element::root(&document, &lines, "OpenDRIVE")?;
    let mut notes = Notes::new(&lines);
    let header = header::read(root)?;
    let mut roads = records::roads(root, &mut notes)?;
    header.shift(&mut roads);
    split::split(&mut roads, &mut notes);
    if settings.trust_lane_change {
        marks::trust_lane_change(&mut roads);
    }
    let junctions = records::junctions(root, &mut notes)?;
    let map = build::build(&roads, &junctions, &lines, &mut notes)?;
    let objects = objects::objects(root, &roads, &mut Budget::new(&lines), &mut notes)?;
    Ok(OpenDriveImport {
        map,
        objects,
        geo_reference: header.geo_reference,
        warnings: notes.into_warnings(),
    })
}

/// Reads an OpenDRIVE file. Bytes that are not UTF-8 (names in older encodings) are replaced.
///
/// # Errors
/// [`ImportError::InFile`] with the file's name around what [`read`] or the file system says.
pub fn read_file(path: &Path) -> Result<OpenDriveImport, ImportError> {
    super::read_file(path, read)
}
