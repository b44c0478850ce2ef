//! A bound on the size of a map of lanelets, so that no file can fill the memory or hang its reader.

use super::Source;
use crate::import::ImportError;

/// What a map may cost. A cross-section of a lane counts 1: ten lanes of 100 km cost 2 million.
const LIMIT: f64 = 5e6;

/// The limit, for people.
const LIMIT_IN_WORDS: &str = "5 million cross-sections";

/// Reach from which a stretch of lane counts more than once, m: the spatial index stores it in a number of cells
/// that grows with the square of its reach.
const CELL: f64 = 8.0;

/// What it costs to look at a segment of a bound: about a fiftieth of a cross-section.
const SEGMENT: f64 = 0.02;

/// What is left of the limit.
#[derive(Debug, Default)]
pub(super) struct Budget {
    spent: f64,
}

impl Budget {
    /// Accounts for `count` cross-sections of a lanelet that are about to be made.
    pub(super) fn cross_sections(
        &mut self,
        count: f64,
        lanelet: usize,
        source: &Source<'_, '_>,
    ) -> Result<(), ImportError> {
        self.spend(count, lanelet, source)
    }

    /// Accounts for a stretch of lane of a given reach that took a search through `segments`.
    pub(super) fn stretch(
        &mut self,
        reach: f64,
        segments: usize,
        lanelet: usize,
        source: &Source<'_, '_>,
    ) -> Result<(), ImportError> {
        let cells = (reach / CELL) * (reach / CELL);
        self.spend(cells + SEGMENT * segments as f64, lanelet, source)
    }

    fn spend(&mut self, cost: f64, lanelet: usize, source: &Source<'_, '_>) -> Result<(), ImportError> {
        self.spent += cost;
        if self.spent <= LIMIT {
            return Ok(());
        }
        // Also where lengths overflow and the cost is not a number.
        Err(ImportError::TooLarge {
            place: source.notes.text_place(source.places[lanelet]),
            road: source.lanelets[lanelet].name.clone(),
            limit: LIMIT_IN_WORDS,
        })
    }
}
