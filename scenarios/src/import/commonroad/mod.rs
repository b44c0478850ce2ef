//! CommonRoad files, versions 2018b and 2020a: their roads, and whole scenarios with recorded traffic.
//!
//! ```text
//! text ──read──▶ File ──network──▶ lanelets ──▶ RoadMap ──┐
//!                  └── obstacles, goals, route ───────────┴─ scenario ──▶ Scenario
//! ```
//!
//! A scenario is seen from one planning problem: its time starts with that problem's initial state, its ego starts
//! there, and its end is that problem's goal. Positions in a file are those of middles of vehicles; the ego's are
//! moved to its rear axle. Files without a problem are cruised through.

mod cruise;
pub mod data;
mod export;
mod goal;
mod lengthen;
mod network;
mod obstacles;
mod pace;
mod read;
mod remarks;
mod route;
mod scenario;
mod shapes;
mod vehicle;

#[cfg(test)]
mod tests;

use super::ImportError;
use super::notes::Notes;
use super::xml::{Element, Lines, Place};
use crate::map_format::root_element;
use crate::scenario::Scenario;
use corridor_decider::road::RoadMap;
use data::{File, Id};
use network::Network;
use std::path::Path;
use std::sync::Arc;

pub use export::DrivenState;
pub use vehicle::{VEHICLE_TYPE, vehicle};

/// A file with its road.
#[derive(Clone, Debug)]
pub struct CommonRoad {
    /// What the file says.
    pub file: File,
    /// Its lanelets as a map; a lane's name is its lanelet's id.
    pub map: Arc<RoadMap>,
    network: Network,
    /// What was survived on the way, one line each.
    pub warnings: Vec<String>,
}

/// Whether a text is meant to be a CommonRoad file: its first element is the format's root.
pub fn is_commonroad(text: &str) -> bool {
    let starts = text.trim_start_matches('\u{feff}').trim_start();
    starts.starts_with('<') && root_element(starts) == Some(read::ROOT)
}

/// Reads the text of a CommonRoad file.
///
/// # Errors
/// [`ImportError`] with line and column when the text is no CommonRoad file with a road that can be driven on.
pub fn read(text: &str) -> Result<CommonRoad, ImportError> {
    let lines = Lines::new(text, read::ROOT);
    let document = lines.parse()?;
    let root = Element::root(&document, &lines, read::ROOT)?;
    let mut notes = Notes::new(&lines);
    let file = read::file(root, &mut notes)?;
    let lanelets: Vec<Place> = root.children("lanelet").map(Element::place).collect();
    let network = network::network(&file, lanelets, &mut notes);
    let map = Arc::new(network.build(&mut notes)?);
    Ok(CommonRoad {
        file,
        network,
        map,
        warnings: notes.into_warnings(),
    })
}

/// Reads a CommonRoad file. Bytes that are not UTF-8 are replaced.
///
/// # Errors
/// [`ImportError::InFile`] with the file's name around what [`read`] or the file system says.
pub fn read_file(path: &Path) -> Result<CommonRoad, ImportError> {
    super::read_file(path, read)
}

/// The scenario of one planning problem of a CommonRoad file, of the first one unless named, with warnings.
///
/// # Errors
/// [`ImportError`] when the text is no CommonRoad file or has no such problem.
pub fn scenario(text: &str, problem: Option<Id>) -> Result<(Scenario, Vec<String>), ImportError> {
    let read = read(text)?;
    let (scenario, more) = read.scenario(problem)?;
    let mut warnings = read.warnings;
    warnings.extend(more);
    Ok((scenario, warnings))
}
