//! Cross-sections of a lane section: where they lie along the road and where the lane edges are in them.

use super::budget::Budget;
use super::geometry::{CurvePoint, Piece};
use super::record::{Extent, Road, Section};
use crate::import::ImportError;

/// Distance of cross-sections on a straight road, m.
const SPACING: f64 = 0.5;

/// Largest turn of the reference line between cross-sections, rad: in sharp bends it keeps chords within 3 mm of
/// the line, and cubics with the right tangents within a micrometre.
const TURN: f64 = 0.05;

/// Cross-sections are never closer than this, m, however sharp a cusp is.
const LEAST_SPACING: f64 = 0.01;

/// Record boundaries closer than this share a cross-section, m.
const SAME_STATION: f64 = 1e-3;

/// How far before the end of a stretch the ruling record is looked up, m, so that the one that ends is found.
const BEFORE: f64 = 1e-6;

/// A cut through the road.
#[derive(Debug)]
pub(super) struct CrossSection {
    /// Station of the road.
    pub(super) s: f64,
    /// The reference line there.
    pub(super) base: CurvePoint,
    /// Lateral positions of the lane edges from left to right with first and second derivative by `s`;
    /// one more than there are lanes.
    pub(super) edges: Vec<[f64; 3]>,
}

/// The cross-sections of a section, at least two, by ascending station.
pub(super) fn cross_sections(
    road: &Road,
    section: usize,
    budget: &mut Budget<'_>,
) -> Result<Vec<CrossSection>, ImportError> {
    let stations = stations(road, section, budget)?;
    let last = stations.len() - 1;
    let content = &road.sections[section];
    let cut = |(k, &s): (usize, &f64)| {
        let ruling = if k == last { s - BEFORE } else { s };
        CrossSection {
            s,
            base: piece(road, ruling).at(s),
            edges: edges(road, content, s, ruling),
        }
    };
    Ok(stations.iter().enumerate().map(cut).collect())
}

/// The piece of reference line that rules at a station. The road must have one.
pub(super) fn piece(road: &Road, s: f64) -> &Piece {
    let past = road.pieces.partition_point(|piece| piece.s <= s);
    &road.pieces[past.saturating_sub(1)]
}

/// Record boundaries, and between them stations close enough for the bend.
fn stations(road: &Road, section: usize, budget: &mut Budget<'_>) -> Result<Vec<f64>, ImportError> {
    let cuts = cuts(road, section);
    let lanes = road.sections[section].lanes.len() as f64;
    let mut stations = vec![cuts[0]];
    for pair in cuts.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let steps = ((to - from) / spacing(piece(road, from), from, to))
            .ceil()
            .max(1.0);
        budget.cross_sections(steps * (1.0 + lanes), road)?;
        let mut step = 1.0;
        while step < steps {
            stations.push(from + (to - from) * (step / steps));
            step += 1.0;
        }
        stations.push(to);
    }
    Ok(stations)
}

/// Stations where a record of any kind begins, from the first to the last of the section.
fn cuts(road: &Road, section: usize) -> Vec<f64> {
    let (start, end) = road.extent(section);
    let lanes = &road.sections[section].lanes;
    let widths = lanes.iter().flat_map(|lane| lane.extent.profile().starts());
    let speeds = lanes
        .iter()
        .flat_map(|lane| &lane.speeds)
        .chain(&road.speeds)
        .map(|record| record.s);
    let signs = road.signs.iter().map(|sign| sign.s);
    let pieces = road.pieces.iter().map(|piece| piece.s);
    let mut cuts: Vec<f64> = widths
        .chain(speeds)
        .chain(signs)
        .chain(pieces)
        .chain(road.offset.starts())
        .collect();
    cuts.retain(|s| *s > start + SAME_STATION && *s < end - SAME_STATION);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|next, kept| *next - *kept < SAME_STATION);
    cuts.insert(0, start);
    cuts.push(end);
    cuts
}

/// Distance of cross-sections on one piece, by the sharpest bend at five points of it.
fn spacing(piece: &Piece, from: f64, to: f64) -> f64 {
    let sharpest = [0.0, 0.25, 0.5, 0.75, 1.0]
        .map(|t| piece.at(from + (to - from) * t).kappa.abs())
        .into_iter()
        .fold(0.0, f64::max);
    (TURN / sharpest).clamp(LEAST_SPACING, SPACING)
}

/// Lane edges from left to right. A width that is negative or not a number counts as 0.
fn edges(road: &Road, section: &Section, s: f64, ruling: f64) -> Vec<[f64; 3]> {
    let centre = road.offset.at(s, ruling);
    let left = section.left_count();
    let mut edges = vec![centre; section.lanes.len() + 1];
    for lane in (0..left).rev() {
        edges[lane] = outer_edge(
            &section.lanes[lane].extent,
            centre,
            edges[lane + 1],
            1.0,
            s,
            ruling,
        );
    }
    for lane in left..section.lanes.len() {
        edges[lane + 1] = outer_edge(&section.lanes[lane].extent, centre, edges[lane], -1.0, s, ruling);
    }
    edges
}

/// The edge beyond `inner`, on the side of `sign`.
fn outer_edge(
    extent: &Extent,
    centre: [f64; 3],
    inner: [f64; 3],
    sign: f64,
    s: f64,
    ruling: f64,
) -> [f64; 3] {
    let value = extent.profile().at(s, ruling);
    match extent {
        Extent::Width(_) if value[0] > 0.0 => [0, 1, 2].map(|k| inner[k] + sign * value[k]),
        Extent::Border(_) if sign * (centre[0] + value[0] - inner[0]) > 0.0 => {
            [0, 1, 2].map(|k| centre[k] + value[k])
        }
        _ => inner,
    }
}
