//! Junctions: lanelets that turn, or say that they lie in an intersection, put together.
//!
//! Lanelets of one junction begin at the same cut, where a lane forks, or end at the same one, where lanes merge. A
//! junction is called by the tag `intersection_area`, else `at ` and the number of its first lanelet.

use super::kinds::is_no;
use super::records::Tags;
use super::topology::Bounds;
use std::collections::BTreeMap;

/// Names of the junctions, and the one of each lane.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Junctions {
    pub(super) names: Vec<String>,
    pub(super) of_lane: Vec<Option<usize>>,
}

/// The junctions of lanes with their names, tags and bounds.
pub(super) fn junctions(names: &[String], tags: &[&Tags<'_>], bounds: &[Bounds]) -> Junctions {
    let groups = groups(tags, bounds);
    let mut named: BTreeMap<usize, String> = BTreeMap::new();
    for (lane, group) in groups.iter().enumerate() {
        if let (Some(group), Some(area)) = (group, area(tags[lane])) {
            named.entry(*group).or_insert_with(|| area.to_owned());
        }
    }
    let mut junctions = Junctions::default();
    let mut numbers: BTreeMap<String, usize> = BTreeMap::new();
    for group in groups {
        let place = group.map(|group| {
            let name = named
                .get(&group)
                .cloned()
                .unwrap_or_else(|| format!("at {}", names[group]));
            *numbers.entry(name.clone()).or_insert_with(|| {
                junctions.names.push(name);
                junctions.names.len() - 1
            })
        });
        junctions.of_lane.push(place);
    }
    junctions
}

/// The first lane of each lane's junction.
fn groups(tags: &[&Tags<'_>], bounds: &[Bounds]) -> Vec<Option<usize>> {
    let mut groups: Vec<Option<usize>> = (0..tags.len())
        .map(|lane| {
            let inside = tags[lane].contains_key("turn_direction") || area(tags[lane]).is_some();
            inside.then_some(lane)
        })
        .collect();
    let mut first_at: BTreeMap<(usize, i64), usize> = BTreeMap::new();
    for lane in 0..groups.len() {
        if groups[lane].is_none() {
            continue;
        }
        for (end, node) in ends(&bounds[lane]) {
            let first = *first_at.entry((end, node)).or_insert(lane);
            let (a, b) = (root(&mut groups, first), root(&mut groups, lane));
            groups[a.max(b)] = Some(a.min(b));
        }
    }
    for lane in 0..groups.len() {
        if groups[lane].is_some() {
            groups[lane] = Some(root(&mut groups, lane));
        }
    }
    groups
}

/// The nodes at which a lane begins (0) and ends (1).
fn ends(bounds: &Bounds) -> impl Iterator<Item = (usize, i64)> {
    let (left, right) = (bounds.left.ends, bounds.right.ends);
    (0..2).flat_map(move |end| [(end, left[end]), (end, right[end])])
}

/// The first lane of a group.
fn root(groups: &mut [Option<usize>], mut lane: usize) -> usize {
    while let Some(next) = groups[lane].filter(|next| *next != lane) {
        groups[lane] = groups[next];
        lane = next;
    }
    lane
}

/// The intersection that a lanelet says it lies in.
fn area<'a>(tags: &Tags<'a>) -> Option<&'a str> {
    tags.get("intersection_area").copied().filter(|area| !is_no(area))
}
