//! Warnings: what was survived, counted by kind so that a bad file does not drown its reader.

use super::xml::{Lines, Place};
use crate::import::TextPlace;

struct Note {
    what: &'static str,
    count: usize,
    place: TextPlace,
    subject: String,
}

/// Collects warnings. The order is that of first occurrence.
pub(crate) struct Notes<'a> {
    lines: &'a Lines<'a>,
    notes: Vec<Note>,
}

impl<'a> Notes<'a> {
    pub(crate) fn new(lines: &'a Lines<'a>) -> Self {
        Self {
            lines,
            notes: Vec::new(),
        }
    }

    /// Counts one more `what`; the first one is remembered with its place and subject.
    pub(crate) fn add(&mut self, what: &'static str, at: Place, subject: impl FnOnce() -> String) {
        if let Some(note) = self.notes.iter_mut().find(|note| note.what == what) {
            note.count += 1;
            return;
        }
        let (place, subject) = (self.lines.place(at), subject());
        self.notes.push(Note {
            what,
            count: 1,
            place,
            subject,
        });
    }

    /// Line and column of a place, for an error.
    pub(crate) fn text_place(&self, at: Place) -> TextPlace {
        self.lines.place(at)
    }

    pub(crate) fn into_warnings(self) -> Vec<String> {
        let line = |note: Note| {
            let Note {
                what,
                count,
                place,
                subject,
            } = note;
            if count == 1 {
                format!("{place}: {subject}: {what}")
            } else {
                format!("{place}: {subject}: {what} ({count} of this kind in the file)")
            }
        };
        self.notes.into_iter().map(line).collect()
    }
}
