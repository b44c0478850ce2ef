//! From lanelets to what a road map is built of: kinds, lines, speed limits, links, junctions.

use super::data::{self, Adjacent, File, Id};
use super::lengthen::{self, End};
use crate::import::ImportError;
use crate::import::lanelets::{self, Lanelet};
use crate::import::notes::Notes;
use crate::import::xml::{Lines, Place};
use corridor_decider::road::{BoundaryType, LaneId, LaneKind, Neighbour, RoadMap, Side};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// Signs that name a top speed: the German and the American ones, which the format writes in m/s.
const SPEED_SIGNS: [&str; 3] = ["274", "274.1", "R2-1"];

/// Junction of lanelets that call themselves part of an intersection while no intersection names them.
const UNNAMED_JUNCTION: &str = "intersection";

/// Lanelets and their junctions' names.
#[derive(Clone, Debug)]
pub(super) struct Network {
    lanelets: Vec<Lanelet>,
    junctions: Vec<String>,
    elements: Vec<Place>,
}

/// Name of a lanelet in the map.
pub(super) fn name(id: Id) -> String {
    id.to_string()
}

/// What the road map of a file is built of. Its lanelets stand at `elements`.
pub(super) fn network(file: &File, elements: Vec<Place>, notes: &mut Notes<'_>) -> Network {
    let limits = speed_signs(file);
    let (junctions, members) = junctions(file);
    let mut links = Links {
        places: (0..).zip(&file.lanelets).map(|(k, l)| (l.id, k)).collect(),
        notes,
    };
    let mut lanelets = Vec::with_capacity(file.lanelets.len());
    for (lanelet, element) in file.lanelets.iter().zip(&elements) {
        let [left, right] = &lanelet.bounds;
        let posted = lanelet.signs.iter().filter_map(|sign| limits.get(sign).copied());
        let own = lanelet.speed_limit.filter(|limit| *limit > 0.0);
        lanelets.push(Lanelet {
            name: name(lanelet.id),
            kind: kind(lanelet),
            left: left.points.clone(),
            right: right.points.clone(),
            left_mark: mark(left.marking.as_deref()),
            right_mark: mark(right.marking.as_deref()),
            neighbours: links.beside(lanelet.adjacent, *element),
            predecessors: links.ahead_or_behind(&lanelet.predecessors, *element),
            successors: links.ahead_or_behind(&lanelet.successors, *element),
            speed_limit: own.into_iter().chain(posted).reduce(f64::min),
            junction: members.get(&lanelet.id).copied(),
        });
    }
    Network {
        lanelets,
        junctions,
        elements,
    }
}

impl Network {
    /// The map.
    pub(super) fn build(&self, notes: &mut Notes<'_>) -> Result<RoadMap, ImportError> {
        lanelets::build(&self.lanelets, self.junctions.clone(), &self.elements, notes)
    }

    /// The same with `map`, which was built of this, going on straight at some of its ends.
    pub(super) fn lengthened(&self, map: &RoadMap, ends: &[(LaneId, End)]) -> Result<RoadMap, ImportError> {
        let lanelets = lengthen::lengthened(&self.lanelets, map, ends);
        // What was to be told has been told of the map; additions count as standing where the first lanelet does.
        let text = Lines::new("", "");
        let first = self.elements.iter().take(1).cycle();
        let elements: Vec<Place> = self
            .elements
            .iter()
            .chain(first)
            .copied()
            .take(lanelets.len())
            .collect();
        lanelets::build(
            &lanelets,
            self.junctions.clone(),
            &elements,
            &mut Notes::new(&text),
        )
    }
}

/// What a lanelet is for. Of several words the one that keeps cars away counts.
fn kind(lanelet: &data::Lanelet) -> LaneKind {
    let is = |word: &str| lanelet.types.iter().any(|known| known == word);
    let users = &lanelet.users;
    let for_cars =
        |user: &String| matches!(user.as_str(), "vehicle" | "car" | "motorcycle" | "taxi" | "truck");
    if is("sidewalk") || is("crosswalk") {
        LaneKind::Sidewalk
    } else if is("bicycleLane") {
        LaneKind::Biking
    } else if is("border") {
        LaneKind::Border
    } else if is("shoulder") {
        LaneKind::Shoulder
    } else if is("parking") {
        LaneKind::Parking
    } else if is("restricted")
        || is("busLane")
        || is("busStop")
        || (!users.is_empty() && !users.iter().any(for_cars))
    {
        LaneKind::Restricted
    } else if is("accessRamp") || is("exitRamp") {
        LaneKind::Ramp
    } else {
        LaneKind::Driving
    }
}

/// A line. One that is solid on one side only counts as solid: which side that is, files do not agree on.
fn mark(marking: Option<&str>) -> BoundaryType {
    match marking {
        Some("solid" | "broad_solid" | "solid_dashed" | "dashed_solid") => BoundaryType::SolidWhite,
        Some("dashed" | "broad_dashed" | "dashed_dashed") => BoundaryType::DottedWhite,
        Some("solid_solid") => BoundaryType::DoubleYellow,
        Some("curb" | "lowered_curb") => BoundaryType::Curb,
        _ => BoundaryType::Unknown,
    }
}

/// The top speeds that signs name, m/s.
fn speed_signs(file: &File) -> BTreeMap<Id, f64> {
    let limit = |(number, values): &(String, Vec<String>)| {
        let value: f64 = values.first()?.parse().ok()?;
        (SPEED_SIGNS.contains(&number.as_str()) && value > 0.0 && value.is_finite()).then_some(value)
    };
    let signs = file.signs.iter();
    signs
        .filter_map(|sign| Some((sign.id, sign.plates.iter().filter_map(limit).reduce(f64::min)?)))
        .collect()
}

/// Names of the junctions, and which lanelets lead through which.
fn junctions(file: &File) -> (Vec<String>, BTreeMap<Id, usize>) {
    let mut names: Vec<String> = file.intersections.iter().map(|i| name(i.id)).collect();
    let mut members: BTreeMap<Id, usize> = BTreeMap::new();
    for (place, intersection) in file.intersections.iter().enumerate() {
        for id in &intersection.through {
            members.entry(*id).or_insert(place);
        }
    }
    let says_so = |lanelet: &&data::Lanelet| lanelet.types.iter().any(|word| word == "intersection");
    for lanelet in file.lanelets.iter().filter(says_so) {
        if let Entry::Vacant(vacant) = members.entry(lanelet.id) {
            if names.last().map(String::as_str) != Some(UNNAMED_JUNCTION) {
                names.push(UNNAMED_JUNCTION.to_owned());
            }
            vacant.insert(names.len() - 1);
        }
    }
    (names, members)
}

/// Finds lanelets by id and tells of those that are not there.
struct Links<'a, 'n> {
    places: BTreeMap<Id, usize>,
    notes: &'a mut Notes<'n>,
}

impl Links<'_, '_> {
    /// The place of the lanelet that another one, at `from`, refers to.
    fn place(&mut self, id: Id, from: Place) -> Option<usize> {
        let place = self.places.get(&id).copied();
        if place.is_none() {
            let what = "a reference to a lanelet that does not exist is ignored";
            self.notes.add(what, from, || format!("lanelet `{id}`"));
        }
        place
    }

    fn ahead_or_behind(&mut self, ids: &[Id], from: Place) -> Vec<usize> {
        ids.iter().filter_map(|id| self.place(*id, from)).collect()
    }

    fn beside(&mut self, adjacent: [Option<Adjacent>; 2], from: Place) -> [Option<usize>; 4] {
        let mut neighbours = [None; 4];
        for (side, adjacent) in [Side::Left, Side::Right].into_iter().zip(adjacent) {
            let Some(adjacent) = adjacent else { continue };
            let reverse = !adjacent.same_direction;
            neighbours[Neighbour { side, reverse }.index()] = self.place(adjacent.id, from);
        }
        neighbours
    }
}
