//! Columns of text under their headings, as wide as what stands in them.

use std::fmt::Write;

/// Rows of `N` cells; the first cell is left-aligned, the others right-aligned.
#[derive(Clone, Debug)]
pub(super) struct Grid<const N: usize> {
    rows: Vec<[String; N]>,
}

impl<const N: usize> Grid<N> {
    pub(super) fn new(headings: [impl Into<String>; N]) -> Self {
        Self {
            rows: vec![headings.map(Into::into)],
        }
    }

    pub(super) fn row(&mut self, cells: [String; N]) {
        self.rows.push(cells);
    }

    /// The headings and the rows, a line each, without line breaks.
    pub(super) fn lines(&self) -> impl Iterator<Item = String> {
        let width = |column: usize| self.rows.iter().map(|row| row[column].chars().count()).max();
        let widths: [usize; N] = std::array::from_fn(|column| width(column).unwrap_or(0));
        self.rows.iter().map(move |row| line(row, &widths))
    }
}

fn line<const N: usize>(cells: &[String; N], widths: &[usize; N]) -> String {
    let mut text = String::new();
    for (k, (cell, width)) in cells.iter().zip(widths).enumerate() {
        // Writing to a string cannot fail.
        let _ = if k == 0 {
            write!(text, "{cell:<width$}")
        } else {
            write!(text, "  {cell:>width$}")
        };
    }
    text
}
