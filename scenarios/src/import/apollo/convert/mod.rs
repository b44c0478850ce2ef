//! From messages to [`MapData`](corridor_decider::hd_map::MapData): names out of their wrappers, numbers checked,
//! enumerations within their range.

mod curve;
mod lane;
mod road;
mod things;

pub(super) use curve::point;
pub(super) use lane::lane;
pub(super) use road::road;
pub(super) use things::{clear_area, outline, overlap, sign, signal, speed_bump};

use super::fault::{Fault, Inside};
use super::messages::Id;
use corridor_decider::routing::ChangeLaneType;

/// Ways to leave a passage of a routing.
pub(super) const LANE_CHANGES: [(i32, ChangeLaneType); 3] = [
    (0, ChangeLaneType::Forward),
    (1, ChangeLaneType::Left),
    (2, ChangeLaneType::Right),
];

/// Farthest a station or a width may be from zero, m.
const LARGEST: f64 = 1e6;

/// The name of something that must have one.
fn name(id: Option<Id>) -> Result<String, Fault> {
    let name = id.and_then(|id| id.id).filter(|name| !name.is_empty());
    name.ok_or_else(|| Fault::new("is missing or empty", "a name, as in `id { id: \"1_-1\" }`"))
        .inside("id")
}

/// A name that may be missing.
fn optional_name(id: Option<Id>) -> Option<String> {
    id.and_then(|id| id.id).filter(|name| !name.is_empty())
}

/// Names of other things, under the field they stand in.
fn names(ids: Vec<Id>, field: &'static str) -> Result<Vec<String>, Fault> {
    let each = |(nth, id)| name(Some(id)).inside_nth(field, nth);
    ids.into_iter().enumerate().map(each).collect()
}

/// A number that must be there.
pub(super) fn number(value: Option<f64>, field: &'static str) -> Result<f64, Fault> {
    let bounded = |value: &f64| value.abs() <= LARGEST;
    match value {
        Some(value) if bounded(&value) => Ok(value),
        Some(value) => Err(Fault::new(format!("is {value}"), "a number between -1e6 and 1e6")),
        None => Err(Fault::new("is missing", "a number")),
    }
    .inside(field)
}

/// A number that may be missing.
pub(super) fn optional_number(value: Option<f64>, field: &'static str) -> Result<Option<f64>, Fault> {
    value.map(|value| number(Some(value), field)).transpose()
}

/// The value that an enumeration's number stands for; the first one when it is missing.
pub(super) fn choice<T: Copy>(value: Option<i32>, values: &[(i32, T)]) -> Result<T, Fault> {
    let Some(value) = value else {
        return Ok(values[0].1);
    };
    let known = values.iter().find(|(number, _)| *number == value);
    known.map(|(_, known)| *known).ok_or_else(|| {
        let (first, last) = (values[0].0, values[values.len() - 1].0);
        Fault::new(format!("is {value}"), format!("{first} to {last}"))
    })
}
