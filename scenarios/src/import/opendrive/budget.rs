//! A bound on the size of a map, so that no file can fill the memory or hang its reader.

use super::record::Road;
use crate::import::ImportError;
use crate::import::xml::Lines;

/// What a map may cost. A cross-section of a lane counts 1 and a little more when it is very wide: ten lanes of
/// 100 km cost 2.5 million.
const LIMIT: f64 = 5e6;

/// The limit, for people.
const LIMIT_IN_WORDS: &str = "5 million cross-sections";

/// Reach from which a stretch of lane counts more than once, m: the spatial index stores it in a number of cells
/// that grows with the square of its reach.
const CELL: f64 = 8.0;

/// What an object costs beyond its corners: its name, kind and pose.
const OBJECT: f64 = 20.0;

/// What is left of the limit.
pub(super) struct Budget<'a> {
    lines: &'a Lines<'a>,
    spent: f64,
}

impl<'a> Budget<'a> {
    pub(super) fn new(lines: &'a Lines<'a>) -> Self {
        Self { lines, spent: 0.0 }
    }

    /// Accounts for `count` cross-sections that are about to be made.
    pub(super) fn cross_sections(&mut self, count: f64, road: &Road) -> Result<(), ImportError> {
        self.spend(count, road)
    }

    /// Accounts for a stretch of lane whose farthest corners are `reach` apart.
    pub(super) fn stretch(&mut self, reach: f64, road: &Road) -> Result<(), ImportError> {
        self.spend(1.0 + (reach / CELL) * (reach / CELL), road)
    }

    /// Accounts for `count` copies of an object of so many corners.
    pub(super) fn objects(&mut self, count: f64, corners: f64, road: &Road) -> Result<(), ImportError> {
        self.spend(count * (OBJECT + corners), road)
    }

    fn spend(&mut self, cost: f64, road: &Road) -> Result<(), ImportError> {
        self.spent += cost;
        if self.spent <= LIMIT {
            return Ok(());
        }
        // Also where widths overflow and the cost is not a number.
        let place = self.lines.place(road.place);
        Err(ImportError::TooLarge {
            place,
            road: road.id.clone(),
            limit: LIMIT_IN_WORDS,
        })
    }
}
