//! Draws the numbers of a file, each from the stream that its key path names, and keeps what it drew.

use crate::parameter::{Parameter, Told};
use crate::random::StreamName;
use crate::schema::number::{Number, Range};
use std::cell::RefCell;
use std::fmt;

/// The numbers of one attempt at one seed.
#[derive(Debug)]
pub(crate) struct Sampler {
    root: StreamName,
    told: Told,
    drawn: RefCell<Vec<Parameter>>,
    /// What it was told and cannot do: key path and reason.
    mistake: RefCell<Option<(String, String)>>,
}

impl Sampler {
    /// Attempt number `attempt` at `seed`. Attempts share nothing.
    pub(crate) fn new(seed: u64, attempt: u32) -> Self {
        Self::with(seed, attempt, Told::Nothing)
    }

    /// The same attempt, but with the numbers that it is told.
    pub(crate) fn with(seed: u64, attempt: u32, told: Told) -> Self {
        let attempts = StreamName::root(seed).join(format_args!("attempt"));
        Self {
            root: StreamName::root(attempts.seed(u64::from(attempt))),
            told,
            drawn: RefCell::default(),
            mistake: RefCell::default(),
        }
    }

    /// Whether any number drawn so far came from a law.
    pub(crate) fn was_random(&self) -> bool {
        !self.drawn.borrow().is_empty()
    }

    /// The numbers that came from laws, in the order in which they were asked for.
    pub(crate) fn into_drawn(self) -> Vec<Parameter> {
        self.drawn.into_inner()
    }

    /// The first thing that it was told and could not do, with the reason; after a draw to the end.
    pub(crate) fn mistake(&mut self) -> Option<(String, String)> {
        let told = match &self.told {
            Told::Nothing => return None,
            Told::Quantiles(numbers) | Told::Values(numbers) => numbers,
        };
        let drawn = self.drawn.get_mut();
        // A row is as long as it is drawn; what is told of a member beyond its end plays no role.
        let unknown = told
            .keys()
            .find(|key| !key.ends_with(']') && !drawn.iter().any(|parameter| parameter.key == **key));
        let unknown = unknown.map(|key| (key.clone(), "no law draws a number of this name".to_owned()));
        self.mistake.take().or(unknown)
    }

    /// The number at `path`, if it was told and fits there.
    fn told<R: Range>(&self, path: &str, number: &Number<R>) -> Option<f64> {
        match &self.told {
            Told::Nothing => None,
            Told::Quantiles(quantiles) => quantiles.get(path).map(|quantile| number.at(*quantile)),
            Told::Values(values) => {
                let value = *values.get(path)?;
                let Some(problem) = R::problem(value) else {
                    return Some(value);
                };
                self.mistake
                    .borrow_mut()
                    .get_or_insert((path.to_owned(), problem));
                None
            }
        }
    }

    /// The numbers under a table's key path, such as `parked[2].`.
    pub(crate) fn table(&self, path: fmt::Arguments<'_>) -> Table<'_> {
        Table {
            sampler: self,
            name: self.root.join(path),
            path: path.to_string(),
            item: None,
        }
    }
}

/// The numbers of one table of the file.
#[derive(Clone, Debug)]
pub(crate) struct Table<'a> {
    sampler: &'a Sampler,
    name: StreamName,
    path: String,
    item: Option<u64>,
}

impl Table<'_> {
    /// The same table for member number `item` of a row.
    pub(crate) fn item(&self, item: u64) -> Self {
        Self {
            item: Some(item),
            ..self.clone()
        }
    }

    /// A table inside this one.
    pub(crate) fn table(&self, path: fmt::Arguments<'_>) -> Self {
        Self {
            name: self.name.join(path),
            path: format!("{}{path}", self.path),
            ..self.clone()
        }
    }

    /// The number under `key`.
    pub(crate) fn number<R: Range>(&self, key: &str, number: &Number<R>) -> f64 {
        if let Some(value) = number.value() {
            return value;
        }
        let path = match self.item {
            Some(item) => format!("{}{key}[{item}]", self.path),
            None => format!("{}{key}", self.path),
        };
        let value = self.sampler.told(&path, number).unwrap_or_else(|| {
            let name = self.name.join(format_args!("{key}"));
            number.draw(&mut name.stream(self.item.unwrap_or(0)))
        });
        self.sampler
            .drawn
            .borrow_mut()
            .extend(number.parameter(path, value));
        value
    }

    /// The number under `key`, or `default` when the file has none.
    pub(crate) fn number_or<R: Range>(&self, key: &str, number: Option<&Number<R>>, default: f64) -> f64 {
        number.map_or(default, |n| self.number(key, n))
    }
}
