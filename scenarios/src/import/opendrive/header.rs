//! Reads `<header>`: where the file's coordinates lie.
//!
//! `<offset>` moves the whole file: turned by `hdg` about its origin, which then lies at (`x`, `y`). `<geoReference>` is
//! kept as text.

use super::record::Road;
use crate::import::ImportError;
use crate::import::xml::Element;
use corridor_decider::geometry::Pose;

/// What a header says of coordinates.
pub(super) struct Header {
    /// The file's origin and x-axis in the world.
    offset: Option<Pose>,
    pub(super) geo_reference: Option<String>,
}

pub(super) fn read(root: Element<'_>) -> Result<Header, ImportError> {
    let header = root.child("header");
    let offset = header.and_then(|header| header.child("offset"));
    let offset = offset.map(|element| -> Result<Pose, ImportError> {
        let [x, y, hdg] = ["x", "y", "hdg"].map(|name| element.number_or(name, 0.0));
        Ok(Pose::new(x?, y?, hdg?))
    });
    let geo_reference = header.and_then(|header| header.child("geoReference"));
    Ok(Header {
        offset: offset.transpose()?,
        geo_reference: geo_reference.and_then(Element::content).map(str::to_owned),
    })
}

impl Header {
    /// Brings the roads to where the header says. Without an offset no bit of them changes.
    pub(super) fn shift(&self, roads: &mut [Road]) {
        let Some(offset) = self.offset else { return };
        for piece in roads.iter_mut().flat_map(|road| &mut road.pieces) {
            let at = offset.to_world(piece.start.position());
            piece.start = Pose::new(at.x, at.y, piece.start.theta + offset.theta);
        }
    }
}
