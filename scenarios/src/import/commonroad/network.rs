//! From lanelets to what a road map is built of: kinds, lines, speed limits, links made mutual, junctions.

use super::data::{self, File, Id};
use crate::import::lanelets::Lanelet;
use corridor_decider::road::{BoundaryType, LaneKind, Neighbour, Side};
use std::collections::{BTreeMap, BTreeSet};

/// Signs that name a top speed: the German and the American ones, which the format writes in m/s.
const SPEED_SIGNS: [&str; 3] = ["274", "274.1", "R2-1"];

/// Junction of lanelets that call themselves part of an intersection while no intersection names them.
const UNNAMED_JUNCTION: &str = "intersection";

/// Lanelets with their junctions' names, and what was repaired or left out, each with how often.
pub(super) struct Network {
    pub(super) lanelets: Vec<Lanelet>,
    pub(super) junctions: Vec<String>,
    pub(super) warnings: Vec<String>,
}

/// Name of a lanelet in the map.
pub(super) fn name(id: Id) -> String {
    id.to_string()
}

/// All lanelets of a file.
pub(super) fn network(file: &File) -> Network {
    let places: BTreeMap<Id, usize> = (0..).zip(&file.lanelets).map(|(k, l)| (l.id, k)).collect();
    let limits = speed_signs(file);
    let (junctions, members) = junctions(file);
    let mut lanelets: Vec<Lanelet> = file
        .lanelets
        .iter()
        .map(|lanelet| {
            let [left, right] = &lanelet.bounds;
            let posted = lanelet.signs.iter().filter_map(|sign| limits.get(sign).copied());
            Lanelet {
                name: name(lanelet.id),
                kind: kind(lanelet),
                left: left.points.clone(),
                right: right.points.clone(),
                left_mark: mark(left.marking.as_deref()),
                right_mark: mark(right.marking.as_deref()),
                neighbours: [None; 4],
                predecessors: Vec::new(),
                successors: Vec::new(),
                speed_limit: lanelet.speed_limit.filter(|v| *v > 0.0).into_iter().chain(posted).reduce(f64::min),
                junction: members.get(&lanelet.id).copied(),
            }
        })
        .collect();
    let mut links = Links {
        places: &places,
        unknown: BTreeSet::new(),
        one_sided: 0,
        contradictions: 0,
    };
    links.connect(file, &mut lanelets);
    links.adjoin(file, &mut lanelets);
    Network {
        lanelets,
        junctions,
        warnings: links.warnings(),
    }
}

/// What a lanelet is for. Of several words the one that keeps cars away counts.
fn kind(lanelet: &data::Lanelet) -> LaneKind {
    let is = |word: &str| lanelet.types.iter().any(|known| known == word);
    let users = &lanelet.users;
    let for_cars = |user: &String| matches!(user.as_str(), "vehicle" | "car" | "motorcycle" | "taxi" | "truck");
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
    } else if is("restricted") || is("busLane") || is("busStop") {
        LaneKind::Restricted
    } else if !users.is_empty() && !users.iter().any(for_cars) {
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
        if !members.contains_key(&lanelet.id) {
            if names.last().map(String::as_str) != Some(UNNAMED_JUNCTION) {
                names.push(UNNAMED_JUNCTION.to_owned());
            }
            members.insert(lanelet.id, names.len() - 1);
        }
    }
    (names, members)
}

/// Ties lanelets together, and remembers what did not fit.
struct Links<'a> {
    places: &'a BTreeMap<Id, usize>,
    unknown: BTreeSet<Id>,
    one_sided: usize,
    contradictions: usize,
}

impl Links<'_> {
    fn place(&mut self, id: Id) -> Option<usize> {
        let place = self.places.get(&id).copied();
        if place.is_none() {
            self.unknown.insert(id);
        }
        place
    }

    /// Ahead and behind; either of two lanelets may be the one that says it.
    fn connect(&mut self, file: &File, lanelets: &mut [Lanelet]) {
        let mut pairs = BTreeSet::new();
        for (here, lanelet) in file.lanelets.iter().enumerate() {
            let ahead = lanelet.successors.iter().map(|id| (*id, true));
            let behind = lanelet.predecessors.iter().map(|id| (*id, false));
            for (id, is_ahead) in ahead.chain(behind) {
                let Some(there) = self.place(id).filter(|there| *there != here) else {
                    continue;
                };
                pairs.insert(if is_ahead { (here, there) } else { (there, here) });
            }
        }
        for (from, to) in pairs {
            lanelets[from].successors.push(to);
            lanelets[to].predecessors.push(from);
        }
    }

    /// Beside. What one lanelet says of another holds for both, unless the other says otherwise.
    fn adjoin(&mut self, file: &File, lanelets: &mut [Lanelet]) {
        let mut told = Vec::new();
        for (here, lanelet) in file.lanelets.iter().enumerate() {
            for (side, adjacent) in [Side::Left, Side::Right].into_iter().zip(lanelet.adjacent) {
                let Some(adjacent) = adjacent else { continue };
                let Some(there) = self.place(adjacent.id).filter(|there| *there != here) else {
                    continue;
                };
                let reverse = !adjacent.same_direction;
                lanelets[here].neighbours[Neighbour { side, reverse }.index()] = Some(there);
                // Who comes the other way has the same side in common.
                let back = if reverse { side } else { side.opposite() };
                told.push((here, there, Neighbour { side: back, reverse }));
            }
        }
        for (here, there, back) in told {
            let slot = &mut lanelets[there].neighbours[back.index()];
            match *slot {
                None => {
                    *slot = Some(here);
                    self.one_sided += 1;
                }
                Some(other) if other != here => self.contradictions += 1,
                Some(_) => {}
            }
        }
    }

    fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        let mut tell = |count: usize, what: &str| {
            if count > 0 {
                warnings.push(format!("{what} ({count} in the file)"));
            }
        };
        tell(self.one_sided, "only one of two lanelets names the other as beside it: taken as mutual");
        tell(self.contradictions, "a lanelet beside another names a third one in its place: each keeps its own");
        let unknown: Vec<String> = self.unknown.iter().take(5).map(|id| format!("`{id}`")).collect();
        let what = format!("references to lanelets that do not exist are ignored: {}", unknown.join(", "));
        tell(self.unknown.len(), &what);
        warnings
    }
}
