//! The speed limit along a path: a step function.

use serde::{Deserialize, Serialize};

/// Why entries make no speed limit.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpeedLimitError {
    /// Fewer than two.
    #[error("{0} entries; a speed limit has two or more")]
    TooFew(usize),
    /// Not in the order of the path.
    #[error("the entry at place {0} lies before the one before it")]
    OutOfOrder(usize),
}

/// Speed limits at places of the path, by ascending place; two or more.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpeedLimit {
    entries: Vec<(f64, f64)>,
}

impl SpeedLimit {
    /// From entries `(s, v)`, m and m/s.
    ///
    /// # Errors
    ///
    /// When there are fewer than two or they are out of order.
    pub fn new(entries: Vec<(f64, f64)>) -> Result<Self, SpeedLimitError> {
        if entries.len() < 2 {
            return Err(SpeedLimitError::TooFew(entries.len()));
        }
        let falls = |pair: &[(f64, f64)]| pair[1].0 < pair[0].0;
        match entries.windows(2).position(falls) {
            Some(k) => Err(SpeedLimitError::OutOfOrder(k + 1)),
            None => Ok(Self { entries }),
        }
    }

    /// The entries `(s, v)`.
    pub fn entries(&self) -> &[(f64, f64)] {
        &self.entries
    }

    /// The limit at `s`: that of the first entry there or beyond, and past the end the last one.
    pub fn at(&self, s: f64) -> f64 {
        let next = self.entries.partition_point(|entry| entry.0 < s);
        self.entries[next.min(self.entries.len() - 1)].1
    }
}
