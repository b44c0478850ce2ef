//! A scenario file as a tree that can be cut: its obstacles, its numbers, its optional keys.

use toml::{Table, Value};

/// The arrays of obstacles in a file.
const OBSTACLES: [&str; 6] = ["parked", "cone", "moving", "idm", "scripted", "pedestrian"];

/// Numbers below a table that are no measures to be rounded on their own: corners of an outline.
const OUTLINE: &str = "polygon";

/// One scenario file.
#[derive(Clone, Debug, PartialEq)]
pub struct Document(Table);

/// The place of a value: keys, and places in arrays.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Key {
    Name(String),
    Place(usize),
}

impl Document {
    /// Reads a scenario file that is known to be one.
    ///
    /// # Panics
    /// When it is no TOML: whoever has a family of it has read it before.
    pub fn parse(text: &str) -> Self {
        Self(text.parse().expect("a family was read from it"))
    }

    /// As text.
    pub fn text(&self) -> String {
        self.0.to_string()
    }

    /// The arrays that hold obstacles, and the place of each in them, in the order of the file.
    pub fn obstacles(&self) -> Vec<(&'static str, usize)> {
        let of = |key: &'static str| {
            let count = self.0.get(key).and_then(Value::as_array).map_or(0, Vec::len);
            (0..count).map(move |place| (key, place))
        };
        OBSTACLES.into_iter().flat_map(of).collect()
    }

    /// Without the obstacles of these numbers in [`Document::obstacles`].
    #[must_use]
    pub(super) fn without_obstacles(&self, numbers: std::ops::Range<usize>) -> Self {
        let mut document = self.clone();
        let obstacles = self.obstacles();
        for (key, place) in obstacles[numbers].iter().rev() {
            let Some(entries) = document.0.get_mut(*key).and_then(Value::as_array_mut) else {
                continue;
            };
            entries.remove(*place);
            if entries.is_empty() {
                document.0.remove(*key);
            }
        }
        document
    }

    /// A number at the top or in a table of it.
    pub(super) fn number(&self, table: Option<&str>, key: &str) -> Option<f64> {
        let table = match table {
            Some(name) => self.0.get(name)?.as_table()?,
            None => &self.0,
        };
        number(table.get(key)?)
    }

    /// A text at the top.
    pub(super) fn text_of(&self, key: &str) -> Option<&str> {
        self.0.get(key)?.as_str()
    }

    /// With a value at the top or in a table of it.
    #[must_use]
    pub(super) fn with(&self, table: Option<&str>, key: &str, value: impl Into<Value>) -> Self {
        let mut document = self.clone();
        let table = match table {
            Some(name) => document
                .0
                .entry(name)
                .or_insert_with(|| Table::new().into())
                .as_table_mut(),
            None => Some(&mut document.0),
        };
        if let Some(table) = table {
            table.insert(key.to_owned(), value.into());
        }
        document
    }

    /// Without a value at the top or in a table of it.
    #[must_use]
    pub(super) fn without(&self, path: &[Key]) -> Self {
        let mut document = self.clone();
        if let Some((Key::Name(last), above)) = path.split_last()
            && let Some(table) = find(&mut document.0, above)
        {
            table.remove(last);
        }
        document
    }

    /// With every obstacle, and what it does, this much nearer to the ego, m.
    #[must_use]
    pub(super) fn nearer(&self, by: f64) -> Self {
        let mut document = self.clone();
        let shift = |key: &str, value: &mut Value| {
            if let (true, Some(old)) = (key == "ahead" || key == "to_ahead", number(value)) {
                *value = (old - by).into();
            }
        };
        let keys: Vec<&str> = OBSTACLES.into_iter().chain(["command"]).collect();
        for key in keys {
            if let Some(value) = document.0.get_mut(key) {
                each(key, value, &shift);
            }
        }
        document
    }

    /// The paths of all values that are neither arrays of obstacles nor tables, in the order of the file.
    pub(super) fn leaves(&self) -> Vec<Vec<Key>> {
        let mut paths = Vec::new();
        collect(&self.0, &mut Vec::new(), &mut paths);
        paths
    }

    /// The number at a path.
    pub(super) fn number_at(&self, path: &[Key]) -> Option<f64> {
        let (Key::Name(last), above) = path.split_last()? else {
            return None;
        };
        let mut document = self.clone();
        number(find(&mut document.0, above)?.get(last)?)
    }

    /// With a number at a path.
    #[must_use]
    pub(super) fn with_number(&self, path: &[Key], value: f64) -> Self {
        let mut document = self.clone();
        if let Some((Key::Name(last), above)) = path.split_last()
            && let Some(table) = find(&mut document.0, above)
        {
            table.insert(last.clone(), value.into());
        }
        document
    }

    /// The digits of all numbers.
    pub(super) fn digits(&self) -> usize {
        let digits = |value: f64| value.to_string().chars().filter(char::is_ascii_digit).count();
        let numbers = self.leaves().into_iter().filter_map(|path| self.number_at(&path));
        numbers.map(digits).sum()
    }
}

fn number(value: &Value) -> Option<f64> {
    value.as_float().or(value.as_integer().map(|whole| whole as f64))
}

/// Calls `with` for every value below `value`, with its key.
fn each(key: &str, value: &mut Value, with: &dyn Fn(&str, &mut Value)) {
    match value {
        Value::Table(table) => table.iter_mut().for_each(|(key, value)| each(key, value, with)),
        Value::Array(entries) => entries.iter_mut().for_each(|entry| each(key, entry, with)),
        _ => with(key, value),
    }
}

fn find<'a>(table: &'a mut Table, path: &[Key]) -> Option<&'a mut Table> {
    let Some((Key::Name(name), mut rest)) = path.split_first() else {
        return path.is_empty().then_some(table);
    };
    let mut value = table.get_mut(name)?;
    while let Some((Key::Place(place), further)) = rest.split_first() {
        value = value.as_array_mut()?.get_mut(*place)?;
        rest = further;
    }
    find(value.as_table_mut()?, rest)
}

fn collect(table: &Table, above: &mut Vec<Key>, paths: &mut Vec<Vec<Key>>) {
    for (name, value) in table.iter().filter(|(name, _)| *name != OUTLINE) {
        above.push(Key::Name(name.clone()));
        match value {
            Value::Table(inner) => collect(inner, above, paths),
            Value::Array(entries) if entries.iter().any(Value::is_table) => {
                for (place, entry) in entries.iter().enumerate() {
                    above.push(Key::Place(place));
                    entry
                        .as_table()
                        .into_iter()
                        .for_each(|entry| collect(entry, above, paths));
                    above.pop();
                }
            }
            _ => paths.push(above.clone()),
        }
        above.pop();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "map = \"x\"\ncruise_speed = 8.25\n[ego]\ns = 30\n[[parked]]\nahead = 40.5\nl = -1.125\n\
                        [[parked]]\nahead = 60.0\n[[cone]]\nahead = 9.0\n[[pedestrian]]\nahead = 50.0\nwhen = { within = 20.0 }\n";

    fn document() -> Document {
        Document::parse(TEXT)
    }

    #[test]
    fn obstacles_are_counted_and_taken_away() {
        let all = document().obstacles();
        assert_eq!(
            all,
            [("parked", 0), ("parked", 1), ("cone", 0), ("pedestrian", 0)]
        );
        let left = document().without_obstacles(1..3);
        assert_eq!(left.obstacles(), [("parked", 0), ("pedestrian", 0)]);
        assert!(!left.text().contains("cone") && left.text().contains("40.5"));
        assert_eq!(document().without_obstacles(0..4).obstacles(), []);
    }

    #[test]
    fn everything_comes_nearer_but_nobody_is_set_off_earlier() {
        let nearer = document().nearer(10.0).text();
        for part in ["30.5", "50.0", "-1.0", "40.0", "within = 20.0"] {
            assert!(nearer.contains(part), "{part}: {nearer}");
        }
    }

    #[test]
    fn numbers_are_found_and_put() {
        let document = document();
        let numbers: Vec<f64> = document
            .leaves()
            .iter()
            .filter_map(|path| document.number_at(path))
            .collect();
        assert_eq!(numbers.len(), 8, "{numbers:?}");
        // 8.25, 30, 40.5, 1.125, 60, 9, 50, 20.
        assert_eq!(document.digits(), 3 + 2 + 3 + 4 + 2 + 1 + 2 + 2);
        let path = document
            .leaves()
            .into_iter()
            .find(|path| document.number_at(path) == Some(-1.125))
            .unwrap();
        assert!(document.with_number(&path, -1.0).text().contains("l = -1.0"));
        assert!(!document.without(&path).text().contains("l ="));
    }
}
