//! Gives equal values one place, so that they are written once.

use std::collections::BTreeMap;

/// Distinct texts (or JSON values as text) in the order of their first use.
#[derive(Default)]
pub(super) struct Pool {
    places: BTreeMap<String, usize>,
}

impl Pool {
    /// The place of `text`.
    pub(super) fn place(&mut self, text: String) -> usize {
        let next = self.places.len();
        *self.places.entry(text).or_insert(next)
    }

    /// All texts by place.
    pub(super) fn into_texts(self) -> Vec<String> {
        let mut texts: Vec<(usize, String)> = self
            .places
            .into_iter()
            .map(|(text, place)| (place, text))
            .collect();
        texts.sort_unstable();
        texts.into_iter().map(|(_, text)| text).collect()
    }
}
