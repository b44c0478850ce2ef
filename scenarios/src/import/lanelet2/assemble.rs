//! From the records of a file to its map: the order of the steps.

use super::bounds::{Bound, aligned};
use super::junctions::{Junctions, junctions};
use super::kinds::{is_two_way, kind};
use super::marks::mark;
use super::positions::positions;
use super::records::{File, RelationRecord, Tags};
use super::speed::{Limit, limit};
use super::topology::{Bounds, sides, successors};
use crate::import::ImportError;
use crate::import::lanelets::{self, Lanelet};
use crate::import::notes::Notes;
use crate::import::xml::Place;
use corridor_decider::geometry::Vec2;
use corridor_decider::road::{BoundaryType, LaneKind, RoadMap, Side};
use std::collections::BTreeMap;

/// Most points of all bounds together: a way counts once for each lanelet that uses it.
const MOST_POINTS: usize = 5_000_000;

/// A lane that turns by more is meant to turn, rad.
const CLEAR_TURN: f64 = std::f64::consts::FRAC_PI_4;

/// All lanes of a file, list by list. The twin of a lanelet for both directions follows right behind it.
#[derive(Default)]
struct Lanes<'a> {
    names: Vec<String>,
    kinds: Vec<LaneKind>,
    tags: Vec<&'a Tags<'a>>,
    places: Vec<Place>,
    limits: Vec<f64>,
    bounds: Vec<Bounds>,
    /// The number of the lanelet that a lane comes from.
    ground: Vec<usize>,
    /// Whether it is driven on, in this direction only.
    one_way: Vec<bool>,
    points: usize,
}

/// The map, and whether traffic keeps to the left.
pub(super) fn assemble(file: &File<'_>, notes: &mut Notes<'_>) -> Result<(RoadMap, bool), ImportError> {
    let positions = positions(file, notes);
    let mut lanes = Lanes::default();
    for (number, relation) in file.relations.iter().enumerate() {
        match relation.tags.get("type").copied() {
            Some("lanelet") => lanes.add(number, relation, file, &positions, notes)?,
            Some("multipolygon") if relation.tags.get("subtype") == Some(&"parking") => {
                note(notes, "an area for parking is not read", relation);
            }
            _ => {}
        }
    }
    let sides = sides(&lanes.bounds, &lanes.ground, &lanes.one_way);
    let successors = successors(&lanes.bounds);
    let junctions = junctions(&lanes.names, &lanes.tags, &lanes.bounds);
    let places = std::mem::take(&mut lanes.places);
    let lanelets = lanes.lanelets(file, &sides.neighbours, successors, &junctions);
    let map = lanelets::build(&lanelets, junctions.names, &places, notes)?;
    Ok((map, sides.oncoming.1 > sides.oncoming.0))
}

fn note(notes: &mut Notes<'_>, what: &'static str, relation: &RelationRecord<'_>) {
    notes.add(what, relation.place, || format!("relation {}", relation.id));
}

impl<'a> Lanes<'a> {
    /// Adds the lane of a lanelet, or both.
    fn add(
        &mut self,
        number: usize,
        relation: &'a RelationRecord<'a>,
        file: &File<'_>,
        positions: &BTreeMap<i64, Vec2>,
        notes: &mut Notes<'_>,
    ) -> Result<(), ImportError> {
        let Some(bounds) = bounds(relation, file, positions, notes) else {
            return Ok(());
        };
        let kind = kind_of(relation, notes);
        let limit = speed_limit(relation, kind, file, notes);
        let both = kind.is_drivable() && is_two_way(&relation.tags);
        let back = both.then(|| bounds.turned_round());
        self.points += (bounds.left.points.len() + bounds.right.points.len()) * (1 + usize::from(both));
        if self.points > MOST_POINTS {
            return Err(ImportError::TooLarge {
                place: notes.text_place(relation.place),
                road: relation.id.to_string(),
                limit: "5 million points of bounds",
            });
        }
        self.push(relation.id.to_string(), number, relation, kind, limit, bounds);
        if let Some(back) = back {
            note(
                notes,
                "a lanelet for both directions becomes two lanes on the same ground",
                relation,
            );
            self.push(
                format!("{}_back", relation.id),
                number,
                relation,
                kind,
                limit,
                back,
            );
        }
        Ok(())
    }

    fn push(
        &mut self,
        name: String,
        number: usize,
        relation: &'a RelationRecord<'a>,
        kind: LaneKind,
        limit: f64,
        bounds: Bounds,
    ) {
        self.names.push(name);
        self.kinds.push(kind);
        self.tags.push(&relation.tags);
        self.places.push(relation.place);
        self.limits.push(limit);
        self.bounds.push(bounds);
        self.ground.push(number);
        self.one_way
            .push(kind.is_drivable() && !is_two_way(&relation.tags));
    }

    /// The lanelets as the builder takes them.
    fn lanelets(
        self,
        file: &File<'_>,
        neighbours: &[[Option<usize>; 4]],
        successors: Vec<Vec<usize>>,
        junctions: &Junctions,
    ) -> Vec<Lanelet> {
        let line = |bound: &Bound, side: Side| {
            // The lane lies on the other side of its bound; along the way's own order if it is not inverted.
            let lane_side = if bound.inverted { side } else { side.opposite() };
            let way = file.ways.get(&bound.way);
            way.map_or(BoundaryType::Unknown, |way| mark(&way.tags, lane_side))
        };
        let named = self.names.into_iter().zip(self.kinds);
        let ruled = named.zip(self.limits).zip(self.bounds);
        let linked = ruled.zip(successors).enumerate();
        linked
            .map(
                |(number, ((((name, kind), limit), bounds), successors))| Lanelet {
                    name,
                    kind,
                    left_mark: line(&bounds.left, Side::Left),
                    right_mark: line(&bounds.right, Side::Right),
                    left: bounds.left.points,
                    right: bounds.right.points,
                    neighbours: neighbours[number],
                    predecessors: Vec::new(),
                    successors,
                    speed_limit: Some(limit),
                    junction: junctions.of_lane[number],
                },
            )
            .collect()
    }
}

/// The bounds of a lanelet in driving direction, or `None` with a note.
fn bounds(
    relation: &RelationRecord<'_>,
    file: &File<'_>,
    positions: &BTreeMap<i64, Vec2>,
    notes: &mut Notes<'_>,
) -> Option<Bounds> {
    let mut one = |role| {
        let mut ways = relation.members_as("way", role);
        let (way, more) = (ways.next(), ways.next());
        if way.is_none() || more.is_some() {
            note(
                notes,
                "a lanelet without exactly one left and one right bound is left out",
                relation,
            );
            return None;
        }
        let bound = Bound::of(file, positions, way?);
        if bound.is_none() {
            note(
                notes,
                "a lanelet with a bound of less than two points is left out",
                relation,
            );
        }
        bound
    };
    let (left, right) = (one("left")?, one("right")?);
    if relation.members_as("way", "centerline").next().is_some() {
        note(notes, "a centre line that is drawn is not used", relation);
    }
    let (left, right) = aligned(left, right);
    let bounds = Bounds { left, right };
    if !turns_as_told(&bounds, &relation.tags) {
        let what = "a lanelet turns the other way than its `turn_direction` says; its bounds are believed";
        note(notes, what, relation);
    }
    Some(bounds)
}

/// Whether nothing is said about turning, or the lane does not clearly turn the other way.
fn turns_as_told(bounds: &Bounds, tags: &Tags<'_>) -> bool {
    match tags.get("turn_direction").copied() {
        Some("left") => bounds.turn() > -CLEAR_TURN,
        Some("right") => bounds.turn() < CLEAR_TURN,
        _ => true,
    }
}

fn kind_of(relation: &RelationRecord<'_>, notes: &mut Notes<'_>) -> LaneKind {
    if !relation.tags.contains_key("subtype") {
        note(notes, "a lanelet without a subtype is taken as a road", relation);
    }
    kind(&relation.tags).unwrap_or_else(|| {
        note(
            notes,
            "a lanelet of an unknown subtype is not driven on",
            relation,
        );
        LaneKind::Other
    })
}

/// The speed limit, m/s; none of a lane that is not driven on matters enough for a note.
fn speed_limit(relation: &RelationRecord<'_>, kind: LaneKind, file: &File<'_>, notes: &mut Notes<'_>) -> f64 {
    let (what, limit) = match limit(relation, file) {
        Limit::Given(limit) => return limit,
        Limit::Default(limit) => (
            "a lanelet without a speed limit gets the German one of its place",
            limit,
        ),
        Limit::Unreadable(limit) => (
            "a speed limit that is no speed is replaced by the German one of its place",
            limit,
        ),
    };
    if kind.is_drivable() {
        note(notes, what, relation);
    }
    limit
}
