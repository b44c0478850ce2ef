//! Roads that others join in their middle: their sections are cut there, so that lane ends can touch.
//!
//! The main road of a virtual junction passes through it as if it were not there; the roads that leave it or join it
//! name the station (`elementS`). Profiles are by road station and hold on both sides of a cut.

use super::record::{Road, RoadLink};
use crate::import::notes::Notes;
use std::collections::BTreeMap;

/// A boundary of sections nearer than this is where roads meet anyway, m.
const NEAREST: f64 = 1e-3;

/// Lanes that cuts may add, so that many branches from a wide road cannot fill the memory.
const MOST_LANES: usize = 100_000;

/// Cuts all roads where links to their middle say so.
pub(super) fn split(roads: &mut [Road], notes: &mut Notes<'_>) {
    let numbers: BTreeMap<String, usize> = roads.iter().map(|road| road.id.clone()).zip(0..).collect();
    let mut cuts = Vec::new();
    for road in roads.iter() {
        for link in road.links.iter().flatten() {
            if let RoadLink::Middle { id, s } = link
                && let Some(&number) = numbers.get(id)
            {
                cuts.push((number, *s, road.place));
            }
        }
    }
    let mut added = 0;
    for (number, s, place) in cuts {
        if added > MOST_LANES {
            let what = "a road joins too wide a road in its middle and is not joined to it";
            notes.add(what, place, || format!("road `{}`", roads[number].id));
            continue;
        }
        added += cut(&mut roads[number], s);
    }
}

/// Cuts one section in two and says how many lanes that adds.
fn cut(road: &mut Road, s: f64) -> usize {
    let inside = |section: &usize| {
        let (start, end) = road.extent(*section);
        s > start + NEAREST && s < end - NEAREST
    };
    let Some(number) = (0..road.sections.len()).find(inside) else {
        return 0;
    };
    let mut second = road.sections[number].clone();
    second.s = s;
    for lane in &mut second.lanes {
        lane.links[0] = vec![lane.id];
    }
    for lane in &mut road.sections[number].lanes {
        lane.links[1] = vec![lane.id];
    }
    let lanes = second.lanes.len();
    road.sections.insert(number + 1, second);
    lanes
}
