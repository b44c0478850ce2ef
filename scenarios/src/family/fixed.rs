//! A family's file with the numbers of one seed in the places of its laws: a scenario that every seed gives alike.

use super::{Family, Origin, Template, attempt_of, way};
use crate::error::DrawError;
use crate::parameter::{Parameter, Told};
use crate::resolve::Draft;
use crate::resolve::sampler::Sampler;
use crate::schema::ScenarioFile;
use crate::schema::number::LAW_KEYS;
use crate::schema::obstacle::Parked;
use std::collections::BTreeMap;
use toml::{Table, Value};

/// The arrays of obstacles in a file, in the order in which they are placed.
const OBSTACLES: [&str; 6] = ["parked", "cone", "moving", "idm", "scripted", "pedestrian"];

impl Family {
    /// The family's file with the numbers of one seed: read with [`Family::parse`], it gives the scenario of that seed
    /// for every seed, to the bit.
    ///
    /// Rows become single obstacles. Where the ego's own station is a drawn number, the place of a row's member may be
    /// off by the last bit: the sum of station and distance then need not hit it.
    ///
    /// # Errors
    /// [`DrawError`] when the seed gives no scenario, or when it is that of a recorded scene.
    pub fn fixed(&self, seed: u64) -> Result<String, DrawError> {
        self.fixed_told(seed, Told::Nothing)
    }

    /// The same of a draw with some numbers at these quantiles of their laws: what [`Family::draw_at`] draws.
    ///
    /// # Errors
    /// [`DrawError`] as [`Family::fixed`] and [`Family::draw_at`].
    pub fn fixed_at(&self, seed: u64, quantiles: &BTreeMap<String, f64>) -> Result<String, DrawError> {
        self.fixed_told(seed, Told::Quantiles(quantiles.clone()))
    }

    fn fixed_told(&self, seed: u64, told: Told) -> Result<String, DrawError> {
        let Origin::Drawn(template) = &self.origin else {
            return Err(DrawError::Recorded {
                family: self.name.clone(),
            });
        };
        let drawn = self.draw_told(seed, told.clone())?;
        let sampler = Sampler::with(seed, attempt_of(&drawn), told);
        let draft =
            Draft::new(&template.file, &template.road, &sampler).map_err(|reason| self.impossible(reason))?;
        let mut content = self.content();
        for parameter in &drawn.parameters {
            put(&mut content, &parameter.key, parameter.value);
        }
        name_all(&mut content);
        expand_rows(&mut content, template, &draft, &drawn.parameters);
        remove_laws(&mut content);
        let mut named = Table::new();
        named.insert("name".to_owned(), self.name.clone().into());
        named.extend(content);
        named.insert("map".to_owned(), template.map.clone().into());
        keep_route(&mut named, &template.file);
        Ok(named.to_string())
    }

    fn content(&self) -> Table {
        self.source.parse().expect("it was read as a scenario file")
    }
}

/// Puts a number in the place of its law; that of a member of a row has none yet.
fn put(content: &mut Table, path: &str, value: f64) {
    let (place, key) = path.rsplit_once('.').unwrap_or(("", path));
    if key.ends_with(']') {
        return;
    }
    let mut table = Some(content);
    for step in place.split('.').filter(|step| !step.is_empty()) {
        table = table.and_then(|table| enter(table, step));
    }
    if let Some(table) = table {
        table.insert(key.to_owned(), value.into());
    }
}

/// The table under one step of a key path, such as `ego` or `parked[2]`.
fn enter<'a>(table: &'a mut Table, step: &str) -> Option<&'a mut Table> {
    let Some((key, index)) = step.split_once('[') else {
        return table.get_mut(step)?.as_table_mut();
    };
    let index: usize = index.trim_end_matches(']').parse().ok()?;
    table.get_mut(key)?.as_array_mut()?.get_mut(index)?.as_table_mut()
}

/// Puts single obstacles in the places of rows, each where the draw has it.
fn expand_rows(content: &mut Table, template: &Template, draft: &Draft<'_>, parameters: &[Parameter]) {
    let mut first = 0;
    for (key, rows) in [("parked", &template.file.parked), ("cone", &template.file.cone)] {
        let Some(entries) = content.get_mut(key).and_then(Value::as_array_mut) else {
            continue;
        };
        let mut expanded = Vec::new();
        for (k, (row, entry)) in rows.iter().zip(entries.iter()).enumerate() {
            let path = format!("{key}[{k}].");
            let bodies = 1 + usize::from(row.door.is_some());
            let Some(count) = members(row, &path, parameters) else {
                expanded.push(entry.clone());
                first += bodies;
                continue;
            };
            for member in 0..count {
                let numbers = of_member(&path, member, parameters);
                let place = first + member * bodies;
                let (s, name) = (draft.spots[place].s, &draft.obstacles[place].name);
                expanded.push(single(entry, numbers, distance_to(s, draft.ego_s), name));
            }
            first += count * bodies;
        }
        *entries = expanded;
    }
}

/// How many obstacles the row under `path` has, if it is one.
fn members(row: &Parked, path: &str, parameters: &[Parameter]) -> Option<usize> {
    let count = row.count.as_ref()?;
    let drawn = parameters
        .iter()
        .find(|parameter| parameter.key.strip_prefix(path) == Some("count"))
        .map(|parameter| parameter.value);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a whole number from 1 to 200"
    )]
    let count = count.value().or(drawn)? as usize;
    Some(count)
}

/// The numbers of one member of the row under `path`, by their keys.
fn of_member<'a>(
    path: &'a str,
    member: usize,
    parameters: &'a [Parameter],
) -> impl Iterator<Item = (&'a str, f64)> + 'a {
    let ending = format!("[{member}]");
    parameters.iter().filter_map(move |parameter| {
        let key = parameter.key.strip_prefix(path)?.strip_suffix(&ending)?;
        Some((key, parameter.value))
    })
}

/// One obstacle of a row as an entry of its own.
fn single<'a>(row: &Value, numbers: impl Iterator<Item = (&'a str, f64)>, ahead: f64, name: &str) -> Value {
    let mut single = row.as_table().cloned().unwrap_or_default();
    for (key, value) in numbers {
        put(&mut single, key, value);
    }
    single.insert("ahead".to_owned(), ahead.into());
    single.insert("name".to_owned(), name.into());
    single.remove("count");
    single.remove("spacing");
    single.into()
}

/// The distance that, added to the ego's station, gives `s`: rounded, their difference may miss it by a bit.
fn distance_to(s: f64, ego_s: f64) -> f64 {
    let distance = s - ego_s;
    let hits = |distance: &f64| (ego_s + *distance).to_bits() == s.to_bits();
    let near = [distance, distance.next_up(), distance.next_down()];
    near.into_iter().find(hits).unwrap_or(distance)
}

/// Gives every obstacle the name by which it is told of, which depends on its place in the file otherwise.
fn name_all(content: &mut Table) {
    for key in OBSTACLES {
        let entries = content.get_mut(key).and_then(Value::as_array_mut);
        for (k, entry) in entries.into_iter().flatten().enumerate() {
            if let Some(entry) = entry.as_table_mut().filter(|entry| !entry.contains_key("name")) {
                entry.insert("name".to_owned(), format!("{key}[{k}]").into());
            }
        }
    }
}

/// Removes the laws of numbers that nobody asked for, such as the length of a body that has an outline.
fn remove_laws(table: &mut Table) {
    table.retain(|_, value| !is_law(value));
    for (_, value) in table.iter_mut() {
        match value {
            Value::Table(inner) => remove_laws(inner),
            Value::Array(entries) => entries
                .iter_mut()
                .filter_map(Value::as_table_mut)
                .for_each(remove_laws),
            _ => {}
        }
    }
}

fn is_law(value: &Value) -> bool {
    let table = value.as_table();
    table.is_some_and(|table| !table.is_empty() && table.keys().all(|key| LAW_KEYS.contains(&key.as_str())))
}

/// Names the length of the route where it follows from the largest numbers that laws can give.
fn keep_route(content: &mut Table, family: &ScenarioFile) {
    let length = way::length(family);
    let fixed = ScenarioFile::parse(&content.to_string(), "").map(|file| way::length(&file));
    if fixed.ok() != Some(length) {
        content.insert("route_length".to_owned(), length.into());
    }
}
