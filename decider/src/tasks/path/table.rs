//! The line ahead of the ego at every metre, asked once per tick and shared by all paths.

use super::profile::Profile;
use crate::geometry::{Vec2, angle};
use crate::reference_line::{LineQuery, ReferenceLine};

/// Distance between the points of a path, m.
pub(crate) const STEP: f64 = 1.0;

/// No path is longer, in points: ten times the bounds of the original.
const MOST_ROWS: usize = 1000;

/// One point of the line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub s: f64,
    pub position: Vec2,
    pub forward: Vec2,
    pub theta: f64,
    pub kappa: f64,
    pub dkappa: f64,
    /// To the (left, right) edges of the road, m.
    pub road: (f64, f64),
}

/// The line at `s0`, `s0 + 1`, …
#[derive(Clone, Debug)]
pub struct LineTable {
    pub(super) rows: Vec<Row>,
}

impl LineTable {
    /// Samples the line from `s0` to `end_s` or to its end.
    pub fn new(line: &ReferenceLine, s0: f64, end_s: f64) -> Self {
        let mut rows: Vec<Row> = Vec::with_capacity(128);
        let end = end_s.min(line.length());
        let mut s = s0;
        while s <= end && rows.len() < MOST_ROWS {
            let at = line.point(s);
            let (sin, cos) = angle::sin_cos(at.theta);
            rows.push(Row {
                s,
                position: Vec2::new(at.x, at.y),
                forward: Vec2::new(cos, sin),
                theta: at.theta,
                kappa: at.kappa,
                dkappa: 0.0,
                road: line.road_width(s).unwrap_or((f64::MAX, f64::MAX)),
            });
            s += STEP;
        }
        for k in 1..rows.len().saturating_sub(1) {
            rows[k].dkappa = (rows[k + 1].kappa - rows[k - 1].kappa) / (2.0 * STEP);
        }
        Self { rows }
    }

    /// Number of its points.
    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    /// The least of `1 − κ l` along a profile: at 0 it runs through the line's centre of curvature.
    pub(crate) fn least_stretch(&self, profile: &Profile) -> f64 {
        let stretch = |(row, l): (&Row, &[f64; 4])| 1.0 - row.kappa * l[0];
        self.rows
            .iter()
            .zip(&profile.l)
            .map(stretch)
            .fold(f64::MAX, f64::min)
    }
}
