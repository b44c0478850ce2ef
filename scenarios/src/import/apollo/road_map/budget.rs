//! A bound on the size of a road map, so that no file can fill the memory or hang its reader.

use crate::import::ImportError;

/// What a map may cost. A cross-section counts 1, and more when it is very wide: 2500 km of lane cost 5 million.
const LIMIT: f64 = 5e6;

/// Reach from which a stretch of lane counts more than once, m: the spatial index stores it in a number of cells
/// that grows with the square of its reach.
const CELL: f64 = 8.0;

/// What holding a cross-section against one piece of a polyline costs: some multiplications.
const COMPARISON: f64 = 0.02;

/// What has been spent.
#[derive(Debug, Default)]
pub(super) struct Budget {
    spent: f64,
}

impl Budget {
    /// Accounts for `count` cross-sections of a lane that are about to be made.
    pub(super) fn cross_sections(&mut self, count: f64, lane: &str) -> Result<(), ImportError> {
        self.spend(count, lane)
    }

    /// Accounts for a stretch of lane whose farthest corners are `reach` apart.
    pub(super) fn stretch(&mut self, reach: f64, lane: &str) -> Result<(), ImportError> {
        self.spend((reach / CELL) * (reach / CELL), lane)
    }

    /// Accounts for `count` comparisons of a cross-section with a piece of a polyline.
    pub(super) fn comparisons(&mut self, count: usize, lane: &str) -> Result<(), ImportError> {
        self.spend(count as f64 * COMPARISON, lane)
    }

    fn spend(&mut self, cost: f64, lane: &str) -> Result<(), ImportError> {
        self.spent += cost;
        if self.spent <= LIMIT {
            return Ok(());
        }
        // Also where the cost is not a number.
        Err(ImportError::Field {
            place: None,
            path: format!("lane `{lane}`"),
            problem: "makes the map larger than 5 million cross-sections".to_owned(),
            expected: "at most that much road surface".to_owned(),
        })
    }
}
