//! Which lane ends touch, by the links of the file: sections, roads and junctions.
//!
//! A *port* is one end of one lane. Touching ports are symmetric and know no driving direction yet.

use super::record::{Connection, End, JunctionRecord, Road, RoadLink};
use crate::import::notes::Notes;
use std::collections::BTreeMap;

/// How far a station in the middle of a road may be from the boundary of sections that it means, m.
const SAME_STATION: f64 = 2e-3;

/// One end of the lane with this number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Port {
    pub(super) lane: usize,
    pub(super) end: End,
}

impl Port {
    fn index(self) -> usize {
        self.lane * 2 + usize::from(self.end == End::Finish)
    }
}

/// A port that another one touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Touch {
    pub(super) port: Port,
    /// Whether the file says so outright; otherwise it is one of several readings and must prove itself.
    pub(super) certain: bool,
}

/// Numbers of all lanes of the file, and which of their ends touch.
pub(super) struct Topology {
    /// Number of the first lane of each section of each road.
    first: Vec<Vec<usize>>,
    touching: Vec<Vec<Touch>>,
}

impl Topology {
    pub(super) fn new(roads: &[Road], junctions: &[JunctionRecord], notes: &mut Notes<'_>) -> Self {
        let mut count = 0;
        let mut first = Vec::with_capacity(roads.len());
        for road in roads {
            let mut sections = Vec::with_capacity(road.sections.len());
            for section in &road.sections {
                sections.push(count);
                count += section.lanes.len();
            }
            first.push(sections);
        }
        let mut topology = Self {
            first,
            touching: vec![Vec::new(); 2 * count],
        };
        let by_id: BTreeMap<&str, usize> = roads
            .iter()
            .zip(0..)
            .map(|(road, k)| (road.id.as_str(), k))
            .collect();
        let mut joiner = Joiner {
            roads,
            by_id,
            topology: &mut topology,
            notes,
        };
        for road in 0..roads.len() {
            joiner.sections(road);
            joiner.road_end(road, End::Start);
            joiner.road_end(road, End::Finish);
        }
        for junction in junctions {
            for connection in &junction.connections {
                joiner.connection(junction, connection);
            }
        }
        for touches in &mut topology.touching {
            touches.sort_by_key(|touch| (touch.port, !touch.certain));
            touches.dedup_by_key(|touch| touch.port);
        }
        topology
    }

    /// Number of a lane by its place.
    pub(super) fn number(&self, road: usize, section: usize, lane: usize) -> usize {
        self.first[road][section] + lane
    }

    /// How many lanes there are.
    pub(super) fn lane_count(&self) -> usize {
        self.touching.len() / 2
    }

    /// What touches a port.
    pub(super) fn touching(&self, port: Port) -> &[Touch] {
        &self.touching[port.index()]
    }

    /// Whether the file links either end of a lane.
    pub(super) fn is_linked(&self, lane: usize) -> bool {
        [End::Start, End::Finish]
            .iter()
            .any(|&end| !self.touching(Port { lane, end }).is_empty())
    }
}

/// A section's end as seen from outside: road, section and which end.
#[derive(Clone, Copy)]
struct Mouth {
    road: usize,
    section: usize,
    end: End,
}

struct Joiner<'a, 'n> {
    roads: &'a [Road],
    by_id: BTreeMap<&'a str, usize>,
    topology: &'a mut Topology,
    notes: &'a mut Notes<'n>,
}

impl Joiner<'_, '_> {
    /// The outermost section at one end of a road.
    fn mouth(&self, road: usize, end: End) -> Mouth {
        let section = if end == End::Start {
            0
        } else {
            self.roads[road].sections.len() - 1
        };
        Mouth { road, section, end }
    }

    /// Joins lane `from` at one mouth to lane `to` at another; `false` when one of them does not exist.
    fn join(&mut self, (a, from): (Mouth, i32), (b, to): (Mouth, i32), certain: bool) -> bool {
        let port = |mouth: Mouth, id: i32| {
            let lane = self.roads[mouth.road].sections[mouth.section].find(id)?;
            Some(Port {
                lane: self.topology.number(mouth.road, mouth.section, lane),
                end: mouth.end,
            })
        };
        let (Some(a), Some(b)) = (port(a, from), port(b, to)) else {
            return false;
        };
        self.topology.touching[a.index()].push(Touch { port: b, certain });
        self.topology.touching[b.index()].push(Touch { port: a, certain });
        true
    }

    /// Joins the lanes at `a` as their records at that end say.
    fn join_as_recorded(&mut self, a: Mouth, b: Mouth, certain: bool) {
        let roads = self.roads;
        let side = usize::from(a.end == End::Finish);
        for lane in &roads[a.road].sections[a.section].lanes {
            for &to in &lane.links[side] {
                // Lane 0 is a line: some files link it, and nothing is lost.
                if to != 0 && !self.join((a, lane.id), (b, to), certain) {
                    self.missing(a.road, lane.place);
                }
            }
        }
    }

    fn missing(&mut self, road: usize, place: crate::import::xml::Place) {
        let id = &self.roads[road].id;
        self.notes
            .add("a link to a lane that does not exist is ignored", place, || {
                format!("road `{id}`")
            });
    }

    fn sections(&mut self, road: usize) {
        for section in 1..self.roads[road].sections.len() {
            let before = Mouth {
                road,
                section: section - 1,
                end: End::Finish,
            };
            let after = Mouth {
                road,
                section,
                end: End::Start,
            };
            self.join_as_recorded(before, after, true);
            self.join_as_recorded(after, before, true);
        }
    }

    fn road_end(&mut self, road: usize, end: End) {
        let roads = self.roads;
        let Some(RoadLink::Road { id, .. } | RoadLink::Middle { id, .. }) = roads[road].link(end) else {
            return;
        };
        let Some(&other) = self.by_id.get(id.as_str()) else {
            let content = &roads[road];
            let what = "a link to a road that does not exist is ignored";
            self.notes
                .add(what, content.place, || format!("road `{}` to `{id}`", content.id));
            return;
        };
        for (mouth, certain) in self.mouths(road, end, other) {
            self.join_as_recorded(self.mouth(road, end), mouth, certain);
        }
    }

    /// What one end of a road touches of `other`, which its link names.
    fn mouths(&self, road: usize, end: End, other: usize) -> Vec<(Mouth, bool)> {
        match self.roads[road].link(end) {
            Some(RoadLink::Road { contact, .. }) => readings(*contact)
                .into_iter()
                .map(|(contact, certain)| (self.mouth(other, contact), certain))
                .collect(),
            // Files do not agree on which of the two stretches is meant.
            Some(RoadLink::Middle { s, .. }) => self.mouths_at(other, *s),
            _ => Vec::new(),
        }
    }

    /// The ends of the sections that meet at a station in the middle of a road, as guesses.
    fn mouths_at(&self, road: usize, s: f64) -> Vec<(Mouth, bool)> {
        let mut mouths = Vec::new();
        for section in 0..self.roads[road].sections.len() {
            let (start, finish) = self.roads[road].extent(section);
            for (end, at) in [(End::Start, start), (End::Finish, finish)] {
                if (at - s).abs() <= SAME_STATION {
                    mouths.push((Mouth { road, section, end }, false));
                }
            }
        }
        mouths
    }

    fn connection(&mut self, junction: &JunctionRecord, connection: &Connection) {
        let find = |id: &str| self.by_id.get(id).copied();
        let (Some(incoming), Some(connecting)) = (find(&connection.incoming), find(&connection.connecting))
        else {
            let what = "a junction's connection to a road that does not exist is ignored";
            self.notes
                .add(what, connection.place, || format!("junction `{}`", junction.id));
            return;
        };
        for (contact, certain_contact) in readings(connection.contact) {
            let b = self.mouth(connecting, contact);
            for (a, certain_at) in self.incoming_mouths(incoming, connecting, contact, &junction.id) {
                for &(from, to) in &connection.lanes {
                    let joined = self.join((a, from), (b, to), certain_at && certain_contact);
                    if !joined && from != 0 && to != 0 {
                        self.missing(incoming, connection.place);
                    }
                }
            }
        }
    }

    /// The ends of the incoming road at which a connection begins: its own end at the junction or, where the main
    /// road of a virtual junction passes through, the station that the connecting road names.
    fn incoming_mouths(
        &self,
        incoming: usize,
        connecting: usize,
        contact: End,
        junction: &str,
    ) -> Vec<(Mouth, bool)> {
        if let Some(RoadLink::Middle { id, .. }) = self.roads[connecting].link(contact)
            && *id == self.roads[incoming].id
        {
            return self.mouths(connecting, contact, incoming);
        }
        let ends = readings(self.end_at(incoming, junction));
        ends.into_iter()
            .map(|(end, certain)| (self.mouth(incoming, end), certain))
            .collect()
    }

    /// The end of a road that touches a junction, when it is exactly one.
    fn end_at(&self, road: usize, junction: &str) -> Option<End> {
        let touches =
            |end: End| matches!(self.roads[road].link(end), Some(RoadLink::Junction(id)) if id == junction);
        match (touches(End::Start), touches(End::Finish)) {
            (true, false) => Some(End::Start),
            (false, true) => Some(End::Finish),
            _ => None,
        }
    }
}

/// One certain end, or both as guesses.
fn readings(end: Option<End>) -> Vec<(End, bool)> {
    match end {
        Some(end) => vec![(end, true)],
        None => vec![(End::Start, false), (End::Finish, false)],
    }
}
