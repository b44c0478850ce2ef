//! Draws the numbers of a file, each from the stream that its key path names.

use crate::random::StreamName;
use crate::schema::number::{Number, Range};
use std::cell::Cell;
use std::fmt;

/// The numbers of one attempt at one seed.
#[derive(Debug)]
pub(crate) struct Sampler {
    root: StreamName,
    random: Cell<bool>,
}

impl Sampler {
    /// Attempt number `attempt` at `seed`. Attempts share nothing.
    pub(crate) fn new(seed: u64, attempt: u32) -> Self {
        let attempts = StreamName::root(seed).join(format_args!("attempt"));
        Self {
            root: StreamName::root(attempts.seed(u64::from(attempt))),
            random: Cell::new(false),
        }
    }

    /// Whether any number drawn so far came from a law.
    pub(crate) fn was_random(&self) -> bool {
        self.random.get()
    }

    /// The numbers under a table's key path, such as `parked[2].`.
    pub(crate) fn table(&self, path: fmt::Arguments<'_>) -> Table<'_> {
        Table {
            sampler: self,
            name: self.root.join(path),
            item: 0,
        }
    }
}

/// The numbers of one table of the file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Table<'a> {
    sampler: &'a Sampler,
    name: StreamName,
    item: u64,
}

impl Table<'_> {
    /// The same table for member number `item` of a row.
    pub(crate) fn item(self, item: u64) -> Self {
        Self { item, ..self }
    }

    /// A table inside this one.
    pub(crate) fn table(self, path: fmt::Arguments<'_>) -> Self {
        Self {
            name: self.name.join(path),
            ..self
        }
    }

    /// The number under `key`.
    pub(crate) fn number<R: Range>(self, key: &str, number: &Number<R>) -> f64 {
        if let Some(value) = number.value() {
            return value;
        }
        self.sampler.random.set(true);
        let name = self.name.join(format_args!("{key}"));
        number.draw(&mut name.stream(self.item))
    }

    /// The number under `key`, or `default` when the file has none.
    pub(crate) fn number_or<R: Range>(self, key: &str, number: Option<&Number<R>>, default: f64) -> f64 {
        number.map_or(default, |n| self.number(key, n))
    }
}
