//! Which lane leads to which, which lie side by side, and which cross a junction.
//!
//! Files often give a link on one side only; here both sides know of it.

use super::warnings::Warnings;
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::hd_map::{LaneData, MapData, Overlap, OverlapKind};
use corridor_decider::road::{Junction, JunctionId, Lane, LaneId, Neighbour};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::FRAC_PI_4;

/// Lanes that are linked meet within this, m.
const JOIN_DISTANCE: f64 = 0.5;

/// ... and turn by less than this, rad.
const JOIN_TURN: f64 = FRAC_PI_4;

/// A lane belongs to a junction that covers more than this share of it; the lanes that lead there only reach in.
const MOST: f64 = 0.5;

/// Links by places of lanes.
#[derive(Debug)]
pub(super) struct Topology {
    lane_count: usize,
    /// From a lane to one that follows.
    links: BTreeSet<(usize, usize)>,
}

impl Topology {
    /// The links that either side names, between lanes that are there and meet.
    pub(super) fn new(map: &MapData, warnings: &mut Warnings) -> Self {
        let places = places(map);
        let mut links = BTreeSet::new();
        for (number, lane) in map.lanes.iter().enumerate() {
            let mut known = |name: &String| {
                let place = places.get(name.as_str()).copied();
                if place.is_none() {
                    let what = "a link to a lane that is not there";
                    warnings.add(what, || format!("lane `{}`, link to `{name}`", lane.id));
                }
                place
            };
            links.extend(
                lane.successors
                    .iter()
                    .filter_map(&mut known)
                    .map(|next| (number, next)),
            );
            links.extend(
                lane.predecessors
                    .iter()
                    .filter_map(&mut known)
                    .map(|before| (before, number)),
            );
        }
        links.retain(|&(from, to)| {
            let gap = gap(&map.lanes[from], &map.lanes[to]);
            if gap > JOIN_DISTANCE {
                let what = "linked lanes that do not meet are not joined";
                let (from, to) = (&map.lanes[from].id, &map.lanes[to].id);
                warnings.add(what, || {
                    format!("`{from}` ends {gap:.2} m away from the start of `{to}`")
                });
            }
            gap <= JOIN_DISTANCE
        });
        Self {
            lane_count: map.lanes.len(),
            links,
        }
    }

    /// For the start (port `2 lane`) and the end (port `2 lane + 1`) of every lane the joint it is part of, named by
    /// its lowest port.
    pub(super) fn joints(&self) -> Vec<usize> {
        let mut joints: Vec<usize> = (0..2 * self.lane_count).collect();
        for &(from, to) in &self.links {
            let (a, b) = (root(&mut joints, 2 * from + 1), root(&mut joints, 2 * to));
            joints[a.max(b)] = a.min(b);
        }
        (0..joints.len()).map(|port| root(&mut joints, port)).collect()
    }

    /// Fills in links, neighbours and junctions of the lanes, and returns the junctions.
    pub(super) fn connect(self, map: &MapData, lanes: &mut [Lane], warnings: &mut Warnings) -> Vec<Junction> {
        for (from, to) in self.links {
            let (a, b) = (
                lanes[from].points[lanes[from].points.len() - 1],
                lanes[to].points[0],
            );
            if angle::difference(b.theta, a.theta).abs() > JOIN_TURN {
                let what = "linked lanes that turn by more than 45 degrees where they meet are not joined";
                warnings.add(what, || format!("`{}` to `{}`", lanes[from].name, lanes[to].name));
                continue;
            }
            lanes[from].successors.push(id(to));
            lanes[to].predecessors.push(id(from));
        }
        neighbours(map, lanes, warnings);
        junctions(map, lanes)
    }
}

fn places(map: &MapData) -> BTreeMap<&str, usize> {
    map.lanes
        .iter()
        .enumerate()
        .map(|(place, lane)| (lane.id.as_str(), place))
        .collect()
}

fn id(place: usize) -> LaneId {
    LaneId(u32::try_from(place).expect("a file of 256 MB at most"))
}

fn gap(from: &LaneData, to: &LaneData) -> f64 {
    let (a, b): (Vec2, Vec2) = (from.points[from.points.len() - 1], to.points[0]);
    (b - a).norm()
}

/// The lowest port of a joint; shortens the way there.
fn root(joints: &mut [usize], port: usize) -> usize {
    let mut root = port;
    while joints[root] != root {
        joints[root] = joints[joints[root]];
        root = joints[root];
    }
    root
}

/// Links adjacent drivable lanes to each other. Where both sides name somebody, each is believed.
fn neighbours(map: &MapData, lanes: &mut [Lane], warnings: &mut Warnings) {
    let places = places(map);
    for kind in Neighbour::ALL {
        // Who lies on my left sees me on its right, unless it comes towards me.
        let back = if kind.reverse {
            kind
        } else {
            Neighbour {
                side: kind.side.opposite(),
                ..kind
            }
        };
        // Asked once per lane: a lane of very many wrong names may be named by very many lanes.
        let names_one = |lane: &LaneData| {
            lane.neighbours[back.index()]
                .iter()
                .any(|name| places.contains_key(name.as_str()))
        };
        let known: Vec<bool> = map.lanes.iter().map(names_one).collect();
        for (number, data) in map.lanes.iter().enumerate() {
            let named = data.neighbours[kind.index()]
                .iter()
                .filter_map(|name| places.get(name.as_str()).copied());
            let mut drivable = named.filter(|other| *other != number && lanes[*other].kind.is_drivable());
            let Some(other) = drivable.next().filter(|_| lanes[number].kind.is_drivable()) else {
                continue;
            };
            lanes[number].neighbours[kind.index()] = Some(id(other));
            if !known[other] && lanes[other].neighbours[back.index()].is_none() {
                lanes[other].neighbours[back.index()] = Some(id(number));
                let what = "a neighbour that only one side names";
                warnings.add(what, || {
                    format!("lanes `{}` and `{}`", data.id, map.lanes[other].id)
                });
            }
        }
    }
}

/// Gives lanes the junction that they name, that their road names, or that covers them; returns all junctions.
fn junctions(map: &MapData, lanes: &mut [Lane]) -> Vec<Junction> {
    let mut ids: BTreeMap<&str, JunctionId> = BTreeMap::new();
    let mut junctions = Vec::new();
    for area in &map.junctions {
        let next = JunctionId(u32::try_from(junctions.len()).expect("a file of 256 MB at most"));
        ids.entry(&area.id).or_insert_with(|| {
            junctions.push(Junction {
                name: area.id.clone(),
            });
            next
        });
    }
    let places = places(map);
    let mut join = |lane: usize, junction: &str| {
        lanes[lane].junction = lanes[lane].junction.or(ids.get(junction).copied());
    };
    for (number, lane) in map.lanes.iter().enumerate() {
        lane.junction.iter().for_each(|junction| join(number, junction));
    }
    for road in &map.roads {
        let members = road.sections.iter().flat_map(|section| &section.lanes);
        members
            .filter_map(|name| places.get(name.as_str()))
            .for_each(|&lane| join(lane, &road.junction));
    }
    for overlap in &map.overlaps {
        for (name, junction) in covered(overlap, map, &places) {
            if let Some(&lane) = places.get(name) {
                join(lane, junction);
            }
        }
    }
    junctions
}

/// The lanes of an overlap most of which a junction covers, with the junction.
fn covered<'a>(
    overlap: &'a Overlap,
    map: &MapData,
    places: &BTreeMap<&str, usize>,
) -> Vec<(&'a str, &'a str)> {
    let is_junction = |kind: &Option<OverlapKind>| *kind == Some(OverlapKind::Junction);
    let Some(junction) = overlap.objects.iter().find(|object| is_junction(&object.kind)) else {
        return Vec::new();
    };
    let covers = |name: &str, start: f64, end: f64| {
        places
            .get(name)
            .is_some_and(|&lane| end - start > MOST * map.lanes[lane].length)
    };
    let lane = |object: &'a corridor_decider::hd_map::OverlapObject| match object.kind {
        Some(OverlapKind::Lane { start_s, end_s, .. }) if covers(&object.id, start_s, end_s) => {
            Some((object.id.as_str(), junction.id.as_str()))
        }
        _ => None,
    };
    overlap.objects.iter().filter_map(lane).collect()
}
