//! Warnings about what has an id: counted by kind, the first one named.

use super::data::Id;

/// Collects warnings. The order is that of first occurrence.
#[derive(Debug, Default)]
pub(super) struct Remarks(Vec<(&'static str, Id, usize)>);

impl Remarks {
    /// Counts one more `what`.
    pub(super) fn add(&mut self, what: &'static str, id: Id) {
        match self.0.iter_mut().find(|(known, ..)| *known == what) {
            Some((.., count)) => *count += 1,
            None => self.0.push((what, id, 1)),
        }
    }

    pub(super) fn into_warnings(self) -> impl Iterator<Item = String> {
        self.0.into_iter().map(|(what, id, count)| match count {
            1 => format!("`{id}` {what}"),
            _ => format!("`{id}` {what} ({count} of this kind in the file)"),
        })
    }
}
