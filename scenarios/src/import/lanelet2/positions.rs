//! Positions of nodes in metres: the file's own, or projected.

use super::projection::TransverseMercator;
use super::records::File;
use crate::import::notes::Notes;
use corridor_decider::geometry::Vec2;
use std::collections::BTreeMap;

/// The origin is the corner of a net of this mesh, degrees, so that a map that is edited stays where it is.
const MESH: f64 = 0.1;

/// Positions by node id, m. Nodes without one are left out.
///
/// One frame for all: as soon as one node has a position of its own in metres, latitudes and longitudes are not used.
pub(super) fn positions(file: &File<'_>, notes: &mut Notes<'_>) -> BTreeMap<i64, Vec2> {
    let is_local = file.nodes.values().any(|node| node.local.is_some());
    let projection = TransverseMercator::around(origin(file, 0), origin(file, 1));
    let mut positions = BTreeMap::new();
    for (id, node) in &file.nodes {
        let position = if is_local {
            node.local
        } else {
            let on_globe = node
                .geographic
                .filter(|(lat, lon)| lat.abs() <= 90.0 && lon.abs() <= 360.0);
            on_globe.map(|(lat, lon)| projection.project(lat, lon))
        };
        match position.filter(|(x, y)| x.is_finite() && y.is_finite()) {
            Some((x, y)) => {
                positions.insert(*id, Vec2::new(x, y));
            }
            None => notes.add("a node without a position is left out", node.place, || {
                format!("node {id}")
            }),
        }
    }
    positions
}

/// The south-west corner of the mesh that holds the south-west corner of the file: latitude (0) or longitude (1).
fn origin(file: &File<'_>, axis: usize) -> f64 {
    let all = file.nodes.values().filter_map(|node| node.geographic);
    let least = all.map(|(lat, lon)| [lat, lon][axis]).fold(f64::MAX, f64::min);
    // Divided by ten instead of multiplied by a tenth, so that 49.0 is 49.0.
    let corner = (least / MESH).floor() / (1.0 / MESH);
    if corner.abs() <= 360.0 { corner } else { 0.0 }
}
