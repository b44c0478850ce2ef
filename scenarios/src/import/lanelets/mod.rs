//! Lanes between two bounds, as CommonRoad and Lanelet2 draw them, turned into a road map.
//!
//! World frame, metres. The bounds of real files are coarse and end askew, so a centre line is built in steps: smooth
//! curves through the bounds (`bound_curve`), the middle between them (`centre`), a common heading and curvature where
//! lanes meet (`joints`), the smooth line near the middle (`smooth`). Widths are measured from that line along its
//! normal to the bounds as they were drawn, so the edges are the file's own (`section`).
//!
//! Deviation of the line from the middle between the bounds as drawn: nothing on straights; millimetres on circles drawn
//! finely; at a kink of `a` rad about `0.6 a` metres from smoothing, and at most a quarter of a metre between far
//! points, where the bound is taken for a bend. Measured on the driving lanes of the Lanelet2 example map: half of the
//! cross-sections within 2 cm, nine tenths within 19 cm; a metre and more only where one bound goes round a corner or
//! is much longer than the other.

mod bound_curve;
mod budget;
mod build;
mod centre;
mod joints;
mod links;
mod polyline;
mod section;
mod smooth;
mod surface;

#[cfg(test)]
mod tests;

use crate::import::ImportError;
use crate::import::notes::Notes;
use crate::import::xml::Place;
use corridor_decider::geometry::Vec2;
use corridor_decider::road::{BoundaryType, LaneKind, RoadMap};

/// A lane between two polylines. References to others are places in the same list.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lanelet {
    /// Its name, unique in the file.
    pub name: String,
    /// What it is for.
    pub kind: LaneKind,
    /// Left bound in driving direction, at least two points.
    pub left: Vec<Vec2>,
    /// Right bound in driving direction; the number of points may differ.
    pub right: Vec<Vec2>,
    /// Line on the left bound.
    pub left_mark: BoundaryType,
    /// Line on the right bound.
    pub right_mark: BoundaryType,
    /// Adjacent lanelets, indexed by [`corridor_decider::road::Neighbour::index`].
    pub neighbours: [Option<usize>; 4],
    /// Lanelets that lead here.
    pub predecessors: Vec<usize>,
    /// Lanelets to go on to.
    pub successors: Vec<usize>,
    /// Speed limit, m/s.
    pub speed_limit: Option<f64>,
    /// The junction it leads through: a place in the list of their names.
    pub junction: Option<usize>,
}

/// The lanelets with where they stand in their file, and who is told what had to be repaired.
pub(super) struct Source<'a, 'n> {
    lanelets: &'a [Lanelet],
    places: &'a [Place],
    notes: &'a mut Notes<'n>,
}

impl Source<'_, '_> {
    /// Tells about one lanelet.
    fn note(&mut self, what: &'static str, lanelet: usize) {
        let name = &self.lanelets[lanelet].name;
        self.notes
            .add(what, self.places[lanelet], || format!("lanelet `{name}`"));
    }
}

/// The road map of all lanelets. `places` are where they stand in the file, one each.
///
/// Links count whichever side names them, and only where lanes meet; references to lanelets that are not there are left
/// out. A lanelet without length or width is left out with a note.
///
/// # Errors
/// [`ImportError::TooLarge`], or [`ImportError::Map`] when nothing can be driven on.
pub(crate) fn build(
    lanelets: &[Lanelet],
    junctions: Vec<String>,
    places: &[Place],
    notes: &mut Notes<'_>,
) -> Result<RoadMap, ImportError> {
    let source = Source {
        lanelets,
        places,
        notes,
    };
    build::build(source, junctions)
}
