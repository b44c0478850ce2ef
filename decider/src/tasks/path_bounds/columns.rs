//! How a path bound is written: one array per number, causes as runs, stations by rule.
//!
//! A bound of 200 stations has a handful of distinct causes and evenly spaced stations; spelled out point by
//! point it takes ten times the bytes. Nothing is lost: where the stations are not exactly
//! `first + k * delta_s`, they are listed.

use super::{BoundPoint, EdgeCause, Label, PathBound};
use crate::columns::{Column, Number};
use crate::frame::ObstacleId;
use serde::ser::SerializeStruct;
use serde::{Deserialize, Serialize, Serializer};

/// The written form of a [`PathBound`].
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BoundColumns {
    label: Label,
    delta_s: f64,
    /// The first station if they are evenly spaced.
    first_s: Option<Number>,
    /// All stations otherwise.
    s: Option<Vec<Number>>,
    l_min: Vec<Number>,
    l_max: Vec<Number>,
    /// Causes of the right limits, each with the number of points that share it.
    right: Vec<(EdgeCause, usize)>,
    left: Vec<(EdgeCause, usize)>,
    blocked_by: Option<ObstacleId>,
    padding: usize,
}

/// What makes columns unusable as a bound.
#[derive(Debug, thiserror::Error)]
pub(super) enum ColumnsError {
    #[error("a bound with {l_min} right limits has {other} {what}")]
    Length {
        l_min: usize,
        other: usize,
        what: &'static str,
    },
    #[error("a bound needs either `first_s` or `s`")]
    NoStations,
    #[error("a bound of {points} points cannot end with {padding} points of padding")]
    Padding { points: usize, padding: usize },
}

/// Runs of equal causes.
struct Runs<'a>(&'a [BoundPoint], fn(&BoundPoint) -> EdgeCause);

impl Serialize for Runs<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let runs = self.0.chunk_by(|a, b| (self.1)(a) == (self.1)(b));
        serializer.collect_seq(runs.map(|run| ((self.1)(&run[0]), run.len())))
    }
}

fn station(first: f64, k: usize, delta_s: f64) -> f64 {
    first + k as f64 * delta_s
}

impl Serialize for PathBound {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let points = &self.points[..];
        let even = (points.iter().enumerate())
            .all(|(k, p)| p.s.to_bits() == station(points[0].s, k, self.delta_s).to_bits());
        let mut out = serializer.serialize_struct("PathBound", 9)?;
        out.serialize_field("label", &self.label)?;
        out.serialize_field("delta_s", &self.delta_s)?;
        if even {
            out.serialize_field("first_s", &Number(self.start_s()))?;
        } else {
            out.serialize_field("s", &Column(points, |p: &BoundPoint| p.s))?;
        }
        out.serialize_field("l_min", &Column(points, |p: &BoundPoint| p.l_min))?;
        out.serialize_field("l_max", &Column(points, |p: &BoundPoint| p.l_max))?;
        out.serialize_field("right", &Runs(points, |p| p.right))?;
        out.serialize_field("left", &Runs(points, |p| p.left))?;
        out.serialize_field("blocked_by", &self.blocked_by)?;
        out.serialize_field("padding", &self.padding)?;
        out.end()
    }
}

impl TryFrom<BoundColumns> for PathBound {
    type Error = ColumnsError;

    fn try_from(columns: BoundColumns) -> Result<Self, ColumnsError> {
        let points = columns.points()?;
        if columns.padding > points.len() {
            return Err(ColumnsError::Padding {
                points: points.len(),
                padding: columns.padding,
            });
        }
        Ok(Self {
            label: columns.label,
            delta_s: columns.delta_s,
            points,
            blocked_by: columns.blocked_by,
            padding: columns.padding,
        })
    }
}

impl BoundColumns {
    fn points(&self) -> Result<Vec<BoundPoint>, ColumnsError> {
        let count = self.l_min.len();
        // Runs are counted before they are spread out: a few bytes must not ask for gigabytes.
        let total = |runs: &[(EdgeCause, usize)]| {
            runs.iter()
                .fold(0_usize, |sum, (_, length)| sum.saturating_add(*length))
        };
        let lengths = [
            (self.l_max.len(), "left limits"),
            (self.s.as_ref().map_or(count, Vec::len), "stations"),
            (total(&self.right), "causes on the right"),
            (total(&self.left), "causes on the left"),
        ];
        if let Some((other, what)) = lengths.into_iter().find(|(length, _)| *length != count) {
            return Err(ColumnsError::Length {
                l_min: count,
                other,
                what,
            });
        }
        let s = |k: usize| match (&self.s, &self.first_s) {
            (Some(all), _) => Ok(all[k].0),
            (None, Some(first)) => Ok(station(first.0, k, self.delta_s)),
            (None, None) => Err(ColumnsError::NoStations),
        };
        let causes = spread(&self.right).zip(spread(&self.left));
        let numbers = self.l_min.iter().zip(&self.l_max);
        causes
            .zip(numbers)
            .enumerate()
            .map(|(k, ((right, left), (l_min, l_max)))| {
                Ok(BoundPoint {
                    s: s(k)?,
                    l_min: l_min.0,
                    l_max: l_max.0,
                    right,
                    left,
                })
            })
            .collect()
    }
}

/// One cause per point.
fn spread(runs: &[(EdgeCause, usize)]) -> impl Iterator<Item = EdgeCause> + '_ {
    runs.iter()
        .flat_map(|(cause, length)| std::iter::repeat_n(*cause, *length))
}
