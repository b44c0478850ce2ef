//! Rows and columns of the search: dense near the car, sparse beyond; one column a second.

use super::{SpeedHeuristicConfig, SpeedHeuristicError};

/// More rows than this are no grid but a mistake.
const MOST_ROWS: f64 = 1e5;

/// More columns than this are no grid but a mistake.
const MOST_COLUMNS: f64 = 1e3;

/// Places and times at which the search has nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Distance of each row, ascending from 0, m. They add up row by row, as the original's do.
    pub rows: Vec<f64>,
    /// Time of each column, ascending from 0, s.
    pub columns: Vec<f64>,
}

impl Grid {
    /// The grid over a path of `length` metres and a time of `duration` seconds.
    ///
    /// # Errors
    ///
    /// When there is no such grid.
    pub fn new(
        config: &SpeedHeuristicConfig,
        length: f64,
        duration: f64,
    ) -> Result<Self, SpeedHeuristicError> {
        let (dense, sparse) = (config.dense_unit_s, config.sparse_unit_s);
        if !(dense > 0.0 && sparse > 0.0 && config.unit_t > 0.0 && config.dense_dimension_s > 0) {
            return Err(SpeedHeuristicError::NoGrid);
        }
        let dense_end = f64::from(config.dense_dimension_s - 1) * dense;
        let sparse_length = length - dense_end;
        let has_sparse = sparse_length > f64::EPSILON;
        let sparse_rows = if has_sparse {
            (sparse_length / sparse).ceil()
        } else {
            0.0
        };
        let dense_rows = if has_sparse {
            f64::from(config.dense_dimension_s)
        } else {
            (length / dense).ceil() + 1.0
        };
        let columns = (duration / config.unit_t).ceil() + 1.0;
        let is_sane = (1.0..=MOST_ROWS).contains(&(dense_rows + sparse_rows))
            && (1.0..=MOST_COLUMNS).contains(&columns);
        if !is_sane {
            return Err(SpeedHeuristicError::NoGrid);
        }
        let mut rows = Vec::new();
        add_up(&mut rows, 0.0, dense, dense_rows);
        add_up(&mut rows, dense_end + sparse, sparse, sparse_rows);
        let mut times = Vec::new();
        add_up(&mut times, 0.0, config.unit_t, columns);
        Ok(Self { rows, columns: times })
    }

    /// The first row at `s` or beyond, else the last one.
    pub(super) fn row_from(&self, s: f64) -> usize {
        let row = self.rows.partition_point(|row| *row < s);
        row.min(self.rows.len() - 1)
    }
}

/// `count` values from `from` on, each the one before it plus `step`.
fn add_up(values: &mut Vec<f64>, from: f64, step: f64, count: f64) {
    let (mut value, mut left) = (from, count);
    while left >= 1.0 {
        values.push(value);
        value += step;
        left -= 1.0;
    }
}
