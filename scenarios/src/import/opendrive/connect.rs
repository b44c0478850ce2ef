//! Predecessors and successors: touching lane ends, checked against the geometry and told in driving direction.
//!
//! A link counts when the centre lines meet. Lanes that were skipped are bridged; where the file links nothing,
//! lanes that meet exactly are joined.

use super::record::End;
use super::topology::{Port, Topology, Touch};
use crate::import::notes::Notes;
use crate::import::xml::Place;
use corridor_decider::geometry::angle;
use corridor_decider::road::{Lane, LaneId, LanePoint};
use std::collections::{BTreeMap, BTreeSet};

/// Centre lines that are linked meet within this, m.
const JOIN_DISTANCE: f64 = 0.5;

/// ... and turn by less than this, rad: a taper may start at an angle, a way back does not.
const JOIN_TURN: f64 = std::f64::consts::FRAC_PI_4;

/// Lanes that nobody linked must meet within this, m ...
const FOUND_DISTANCE: f64 = 0.2;

/// ... turn by less than this, rad ...
const FOUND_TURN: f64 = 0.1;

/// ... and both be at least this wide, m: a lane that has closed leads nowhere.
const FOUND_WIDTH: f64 = 1.0;

/// What became of a lane of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fate {
    /// It is in the map; `back` is its other direction, if it has both.
    Kept {
        id: LaneId,
        forward: bool,
        back: Option<LaneId>,
    },
    /// Its section is too short; links go through it.
    Bridged,
    /// It has no width; links end at it.
    Dropped,
}

impl Fate {
    /// The lanes of the map that it became, and whether they run with the road's station.
    pub(super) fn ways(self) -> impl Iterator<Item = (LaneId, bool)> {
        let ways = match self {
            Self::Kept { id, forward, back } => [Some((id, forward)), back.map(|id| (id, !forward))],
            Self::Bridged | Self::Dropped => [None, None],
        };
        ways.into_iter().flatten()
    }

    /// The lane that is entered at this end.
    fn entered_at(self, end: End) -> Option<LaneId> {
        let entry = |forward: bool| if forward { End::Start } else { End::Finish };
        self.ways()
            .find(|(_, forward)| entry(*forward) == end)
            .map(|(id, _)| id)
    }
}

/// Fills in the links of all lanes. `fates` are by lane number, `places` by [`LaneId`].
pub(super) fn connect(
    lanes: &mut [Lane],
    topology: &Topology,
    fates: &[Fate],
    places: &[Place],
    notes: &mut Notes<'_>,
) {
    let mut links: BTreeSet<(LaneId, LaneId)> = BTreeSet::new();
    for (lane, fate) in fates.iter().enumerate() {
        for (id, forward) in fate.ways() {
            let exit = if forward { End::Finish } else { End::Start };
            for touch in beyond(topology, fates, Port { lane, end: exit }) {
                let next = fates[touch.port.lane];
                if let Some(next) = next.entered_at(touch.port.end) {
                    join((id, next), touch.certain, lanes, &mut links, places, notes);
                } else if let (Fate::Kept { back: None, .. }, Some((next, _))) = (fate, next.ways().next()) {
                    let (from, to) = (&lanes[index(id)], &lanes[index(next)]);
                    if touch.certain && from.kind.is_drivable() && to.kind.is_drivable() {
                        let what = "linked lanes that lead against each other are not joined";
                        notes.add(what, places[index(id)], || {
                            format!("lanes `{}` and `{}`", from.name, to.name)
                        });
                    }
                }
            }
        }
    }
    found_by_geometry(lanes, &mut links, places, notes);
    for (from, to) in links {
        lanes[index(from)].successors.push(to);
        lanes[index(to)].predecessors.push(from);
    }
}

/// Links two lanes if they meet.
fn join(
    (id, next): (LaneId, LaneId),
    certain: bool,
    lanes: &[Lane],
    links: &mut BTreeSet<(LaneId, LaneId)>,
    places: &[Place],
    notes: &mut Notes<'_>,
) {
    let (from, to) = (&lanes[index(id)], &lanes[index(next)]);
    if meet(from, to, JOIN_DISTANCE, JOIN_TURN) {
        links.insert((id, next));
    } else if certain && from.kind.is_drivable() && to.kind.is_drivable() {
        let what = "linked lanes that do not meet are not joined";
        notes.add(what, places[index(id)], || describe_gap(from, to));
    }
}

fn index(id: LaneId) -> usize {
    id.0 as usize
}

fn describe_gap(from: &Lane, to: &Lane) -> String {
    let (a, b) = ends(from, to);
    let gap = libm::hypot(b.x - a.x, b.y - a.y);
    format!(
        "`{}` ends {gap:.2} m away from the start of `{}`",
        from.name, to.name
    )
}

/// The last cross-section of one lane and the first of the other.
fn ends<'a>(from: &'a Lane, to: &'a Lane) -> (&'a LanePoint, &'a LanePoint) {
    (&from.points[from.points.len() - 1], &to.points[0])
}

fn meet(from: &Lane, to: &Lane, distance: f64, turn: f64) -> bool {
    let (a, b) = ends(from, to);
    libm::hypot(b.x - a.x, b.y - a.y) <= distance && angle::difference(b.theta, a.theta).abs() <= turn
}

/// What a port touches when bridged lanes are walked through.
fn beyond(topology: &Topology, fates: &[Fate], port: Port) -> Vec<Touch> {
    let mut found = Vec::new();
    let mut seen = BTreeSet::new();
    let mut pending = vec![Touch { port, certain: true }];
    while let Some(from) = pending.pop() {
        for touch in topology.touching(from.port) {
            if !seen.insert(touch.port) {
                continue;
            }
            let certain = from.certain && touch.certain;
            if fates[touch.port.lane] == Fate::Bridged {
                let port = Port {
                    end: touch.port.end.other(),
                    ..touch.port
                };
                pending.push(Touch { port, certain });
            } else {
                found.push(Touch { certain, ..*touch });
            }
        }
    }
    found
}

/// Joins drivable lanes that lead nowhere to those that start where they end.
fn found_by_geometry(
    lanes: &[Lane],
    links: &mut BTreeSet<(LaneId, LaneId)>,
    places: &[Place],
    notes: &mut Notes<'_>,
) {
    let mut starts: BTreeMap<(i64, i64), Vec<u32>> = BTreeMap::new();
    for (number, lane) in (0u32..).zip(lanes) {
        if lane.kind.is_drivable() {
            starts.entry(cell(&lane.points[0])).or_default().push(number);
        }
    }
    for (number, from) in (0u32..).zip(lanes) {
        let id = LaneId(number);
        let leads_on = links
            .range((id, LaneId(0))..=(id, LaneId(u32::MAX)))
            .next()
            .is_some();
        if leads_on || !from.kind.is_drivable() {
            continue;
        }
        let (x, y) = cell(&from.points[from.points.len() - 1]);
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (x + dx, y + dy)));
        for &next in around.filter_map(|cell| starts.get(&cell)).flatten() {
            let to = &lanes[next as usize];
            let (a, b) = ends(from, to);
            let open = a.left + a.right >= FOUND_WIDTH && b.left + b.right >= FOUND_WIDTH;
            if next != number && open && meet(from, to, FOUND_DISTANCE, FOUND_TURN) {
                links.insert((id, LaneId(next)));
                let what = "lanes that meet but are not linked are joined";
                notes.add(what, places[number as usize], || {
                    format!("`{}` to `{}`", from.name, to.name)
                });
            }
        }
    }
}

/// A square metre of ground.
fn cell(point: &LanePoint) -> (i64, i64) {
    #[expect(clippy::cast_possible_truncation, reason = "coordinates are at most 1e8 m")]
    let cell = |v: f64| v.floor() as i64;
    (cell(point.x), cell(point.y))
}
