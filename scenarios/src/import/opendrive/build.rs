//! From records to lanes: the order of the steps.

use super::budget::Budget;
use super::connect::{Fate, connect};
use super::cross_section::{CrossSection, cross_sections};
use super::lane_build::{CentreLine, centre_line, runs_forward};
use super::marks::marks;
use super::record::{Direction, JunctionRecord, Road};
use super::surface::surface;
use super::topology::Topology;
use crate::import::ImportError;
use crate::import::notes::Notes;
use crate::import::xml::{Lines, Place};
use corridor_decider::road::{Junction, JunctionId, Lane, LaneId, LaneKind, Neighbour, RoadMap, Side};
use std::collections::BTreeMap;

/// Shorter sections are rounding dust, m; links go through them.
const DUST: f64 = 1e-3;

/// A lane narrower than this is closed, m.
const CLOSED: f64 = 1e-3;

/// A driving lane of a smaller mean width that nothing is linked to is a bay beside the road, m.
const BAY_WIDTH: f64 = 2.0;

/// A driving lane of a larger mean width that nothing is linked to is a parking lot, m.
const LOT_WIDTH: f64 = 8.0;

/// Everything that grows while the roads are walked.
struct Builder<'a, 'n> {
    topology: &'a Topology,
    notes: &'a mut Notes<'n>,
    budget: Budget<'n>,
    junctions: Vec<Junction>,
    junction_ids: BTreeMap<String, JunctionId>,
    lanes: Vec<Lane>,
    /// By lane number.
    fates: Vec<Fate>,
    /// By [`LaneId`].
    places: Vec<Place>,
}

/// The map of all roads.
pub(super) fn build<'n>(
    roads: &[Road],
    junctions: &[JunctionRecord],
    lines: &'n Lines<'n>,
    notes: &mut Notes<'n>,
) -> Result<RoadMap, ImportError> {
    let topology = Topology::new(roads, junctions, notes);
    let mut builder = Builder {
        topology: &topology,
        notes,
        budget: Budget::new(lines),
        junctions: Vec::new(),
        junction_ids: BTreeMap::new(),
        lanes: Vec::new(),
        fates: vec![Fate::Bridged; topology.lane_count()],
        places: Vec::new(),
    };
    for junction in junctions {
        builder.junction(&junction.id);
    }
    for (number, road) in roads.iter().enumerate() {
        for section in 0..road.sections.len() {
            builder.section(road, number, section)?;
        }
        if !names_a_speed(road) {
            let what = "a road without a speed limit";
            builder
                .notes
                .add(what, road.place, || format!("road `{}`", road.id));
        }
    }
    let Builder {
        mut lanes,
        junctions,
        fates,
        places,
        ..
    } = builder;
    connect(&mut lanes, &topology, &fates, &places, notes);
    Ok(RoadMap::new(lanes, junctions)?)
}

impl Builder<'_, '_> {
    fn junction(&mut self, id: &str) -> JunctionId {
        if let Some(&known) = self.junction_ids.get(id) {
            return known;
        }
        let next = JunctionId(u32::try_from(self.junctions.len()).expect("a file of 4 GB at most"));
        self.junctions.push(Junction { name: id.to_owned() });
        self.junction_ids.insert(id.to_owned(), next);
        next
    }

    /// Adds the lanes of one section.
    fn section(&mut self, road: &Road, road_number: usize, number: usize) -> Result<(), ImportError> {
        let section = &road.sections[number];
        let (start, end) = road.extent(number);
        if end - start < DUST {
            let what = "a lane section shorter than 1 mm is skipped";
            self.notes
                .add(what, section.place, || format!("road `{}`", road.id));
            return Ok(());
        }
        let cuts = cross_sections(road, number, &mut self.budget)?;
        let first = self.topology.number(road_number, number, 0);
        let kinds = self.kinds(road, number, first, &cuts);
        let surfaces: Vec<_> = cuts
            .iter()
            .map(|cut| surface(section, &kinds, &cut.edges))
            .collect();
        let mut kept = Vec::new();
        for (lane, &kind) in kinds.iter().enumerate() {
            let fate = self.lane(road, number, (lane, kind), &cuts, &surfaces)?;
            if matches!(fate, Fate::Kept { .. }) {
                kept.push(fate);
            }
            self.fates[first + lane] = fate;
        }
        self.neighbours(&kept);
        Ok(())
    }

    /// The uses of a section's lanes, with bays told from through lanes.
    fn kinds(&mut self, road: &Road, section: usize, first: usize, cuts: &[CrossSection]) -> Vec<LaneKind> {
        let mut kinds = Vec::new();
        for (lane, record) in road.sections[section].lanes.iter().enumerate() {
            let bay =
                record.kind == LaneKind::Driving && is_bay(cuts, lane, self.topology.is_linked(first + lane));
            if bay {
                let what =
                    "a driving lane that leads nowhere and is no lane by its width is taken as parking";
                self.notes.add(what, record.place, || {
                    format!("road `{}` lane {}", road.id, record.id)
                });
            }
            kinds.push(if bay { LaneKind::Parking } else { record.kind });
        }
        kinds
    }

    /// Adds one lane, unless nothing of it is there.
    fn lane(
        &mut self,
        road: &Road,
        section: usize,
        (lane, kind): (usize, LaneKind),
        cuts: &[CrossSection],
        surfaces: &[Vec<(f64, f64)>],
    ) -> Result<Fate, ImportError> {
        let record = &road.sections[section].lanes[lane];
        let name = format!("{}_{section}_{}", road.id, record.id);
        if cuts.iter().all(|cut| width(cut, lane) < CLOSED) {
            self.notes
                .add("a lane without any width is left out", record.place, || {
                    format!("lane `{name}`")
                });
            return Ok(Fate::Dropped);
        }
        let forward = runs_forward(road, record);
        let line = centre_line(road, (record, forward), lane, cuts, surfaces, &mut self.budget)?;
        if line.points.len() < 2 {
            self.notes
                .add("a lane without any length is left out", record.place, || {
                    format!("lane `{name}`")
                });
            return Ok(Fate::Dropped);
        }
        if line.folded && kind.is_road_surface() {
            let what = "a lane that reaches beyond the centre of its bend";
            self.notes.add(what, record.place, || format!("lane `{name}`"));
        }
        let back = if record.direction == Direction::Both && kind.is_drivable() {
            let line = centre_line(road, (record, !forward), lane, cuts, surfaces, &mut self.budget)?;
            (line.points.len() > 1).then_some((line, format!("{name}r")))
        } else {
            None
        };
        let id = self.add(road, section, (lane, kind), (line, name), forward);
        let back = back.map(|way| self.add(road, section, (lane, kind), way, !forward));
        Ok(Fate::Kept { id, forward, back })
    }

    /// Adds one direction of a lane.
    fn add(
        &mut self,
        road: &Road,
        section: usize,
        (lane, kind): (usize, LaneKind),
        (line, name): (CentreLine, String),
        forward: bool,
    ) -> LaneId {
        let (left_marks, right_marks) = marks(&road.sections[section], lane, &line, forward);
        let id = LaneId(u32::try_from(self.lanes.len()).expect("a file of 4 GB at most"));
        let junction = road.junction.as_deref().map(|id| self.junction(id));
        self.lanes.push(Lane {
            name,
            kind,
            road: road.id.clone(),
            junction,
            points: line.points,
            left_marks,
            right_marks,
            neighbours: [None; 4],
            predecessors: Vec::new(),
            successors: Vec::new(),
        });
        self.places.push(road.sections[section].lanes[lane].place);
        id
    }

    /// Makes drivable lanes side by side neighbours. `kept` runs from left to right.
    fn neighbours(&mut self, kept: &[Fate]) {
        for pair in kept.windows(2) {
            for (a, a_forward) in pair[0].ways() {
                for (b, b_forward) in pair[1].ways() {
                    self.side_by_side((a, a_forward), (b, b_forward));
                }
            }
        }
    }

    /// Makes two lanes neighbours, the left one first, if both can be driven on.
    fn side_by_side(&mut self, (a, a_forward): (LaneId, bool), (b, b_forward): (LaneId, bool)) {
        if !self.lanes[a.0 as usize].kind.is_drivable() || !self.lanes[b.0 as usize].kind.is_drivable() {
            return;
        }
        let reverse = a_forward != b_forward;
        let a_sees_b = if a_forward { Side::Right } else { Side::Left };
        let b_sees_a = if b_forward { Side::Left } else { Side::Right };
        let mut set = |lane: LaneId, side: Side, other: LaneId| {
            self.lanes[lane.0 as usize].neighbours[Neighbour { side, reverse }.index()] = Some(other);
        };
        set(a, a_sees_b, b);
        set(b, b_sees_a, a);
    }
}

/// Whether any limit is given, be it for one lane.
fn names_a_speed(road: &Road) -> bool {
    let lanes = road.sections.iter().flat_map(|section| &section.lanes);
    lanes
        .flat_map(|lane| &lane.speeds)
        .chain(&road.speeds)
        .any(|record| record.limit.is_finite())
        || road.signs.iter().any(|sign| sign.limit.is_finite())
}

fn width(cut: &CrossSection, lane: usize) -> f64 {
    cut.edges[lane][0] - cut.edges[lane + 1][0]
}

/// Whether a driving lane is a row of parking bays or a lot: it opens and closes, or nothing is linked to it and
/// it is too narrow or too wide for a lane. A lane that only opens or only closes is a taper.
fn is_bay(cuts: &[CrossSection], lane: usize, linked: bool) -> bool {
    let open: Vec<bool> = cuts.iter().map(|cut| width(cut, lane) >= CLOSED).collect();
    let closings = open.windows(2).filter(|pair| pair[0] && !pair[1]).count();
    let openings = open.windows(2).filter(|pair| !pair[0] && pair[1]).count();
    let mean = cuts.iter().map(|cut| width(cut, lane)).sum::<f64>() / cuts.len() as f64;
    let toggles = openings > 0 && closings > 0;
    toggles || (!linked && !(BAY_WIDTH..=LOT_WIDTH).contains(&mean))
}
