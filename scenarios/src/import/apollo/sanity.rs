//! What must hold between the messages of a map. A file of another schema may decode into nonsense; here it is found
//! out.

use super::fault::{Fault, Inside};
use corridor_decider::hd_map::{LaneData, MapData};
use std::collections::BTreeSet;

/// A map cut out of a larger one links to lanes that it does not have, but not this share of all links.
const MOST_UNKNOWN: f64 = 0.5;

/// Refuses maps without lanes, with two lanes of one name, or whose names lead nowhere.
pub(super) fn check(map: &MapData) -> Result<(), Fault> {
    if map.lanes.is_empty() {
        let expected = "lanes, as in Apollo's base_map.bin or base_map.txt";
        return Err(Fault::new("the map has none", expected)).inside("lane");
    }
    let mut known: BTreeSet<&str> = BTreeSet::new();
    for (nth, lane) in map.lanes.iter().enumerate() {
        if !known.insert(&lane.id) {
            let fault = Fault::new(
                format!("is `{}` for the second time", lane.id),
                "a name of its own",
            );
            return Err(fault).inside("id").inside_nth("lane", nth);
        }
    }
    let (mut count, mut unknown, mut first) = (0_usize, 0_usize, None);
    for link in map.lanes.iter().flat_map(links) {
        count += 1;
        if !known.contains(link) {
            unknown += 1;
            first = first.or(Some(link));
        }
    }
    match first {
        Some(first) if unknown as f64 > MOST_UNKNOWN * count as f64 => Err(Fault::new(
            format!("{unknown} of {count} links lead to lanes that are not there, the first to `{first}`"),
            "names of lanes of this map; files of an older schema are not read",
        ))
        .inside("lane"),
        _ => Ok(()),
    }
}

/// The lanes that a lane names.
fn links(lane: &LaneData) -> impl Iterator<Item = &str> {
    let around = lane.neighbours.iter().flatten();
    let names = lane.predecessors.iter().chain(&lane.successors).chain(around);
    names.map(String::as_str)
}
