//! Lanelet2 maps (`.osm`), also as Autoware writes them: lanes between shared ways, in metres.
//!
//! Source: the Lanelet2 documentation on its format and tags (F. Poggenhans et al., "Lanelet2: A High-Definition Map
//! Framework for the Future of Automated Driving", 2018) and what its example maps contain. Positions are the tags
//! `local_x` and `local_y` where a file has them, else a transverse Mercator projection of latitude and longitude
//! around an origin beside the map (`projection`). Heights, traffic lights, right of way and areas are not
//! read; areas for parking are told as warnings.
//!
//! Lanes of the result are called by the number of their lanelet. A lanelet for both directions becomes two
//! lanes on the same ground, the second one with the name `number_back`.

mod assemble;
mod bounds;
mod junctions;
mod kinds;
mod marks;
mod positions;
mod projection;
mod records;
mod speed;
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
pub struct Lanelet2Import {
    /// The lanes.
    pub map: RoadMap,
    /// Whether traffic keeps to the left, as far as lanes of both directions side by side tell.
    pub left_hand_traffic: bool,
    /// What was survived on the way, one line each, with line and column.
    pub warnings: Vec<String>,
}

/// Reads the text of a Lanelet2 file.
///
/// # Errors
/// [`ImportError`] with line and column when the text is not a Lanelet2 map that can be driven on.
pub fn read(text: &str) -> Result<Lanelet2Import, ImportError> {
    let lines = Lines::new(text, "osm");
    let document = lines.parse()?;
    let root = Element::root(&document, &lines, "osm")?;
    let mut notes = Notes::new(&lines);
    let file = records::read(root, &mut notes)?;
    let (map, left_hand_traffic) = assemble::assemble(&file, &mut notes)?;
    Ok(Lanelet2Import {
        map,
        left_hand_traffic,
        warnings: notes.into_warnings(),
    })
}

/// Reads a Lanelet2 file. Bytes that are not UTF-8 are replaced.
///
/// # Errors
/// [`ImportError::InFile`] with the file's name around what [`read`] or the file system says.
pub fn read_file(path: &Path) -> Result<Lanelet2Import, ImportError> {
    super::read_file(path, read)
}
