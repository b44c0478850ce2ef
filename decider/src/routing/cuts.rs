//! Lanes cut into stretches: where a leg starts and ends, and around what is not to be driven.

use super::graph::LaneGraph;
use super::request::{BlackList, Position};
use crate::road::{LaneId, RoadMap};

/// How much of a lane belongs to the stretch behind a start and before an end, m (the original's margin).
const MARGIN: f64 = 0.01;

/// A stretch of a lane that can be driven from its start to its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stretch {
    pub lane: LaneId,
    pub start: f64,
    pub end: f64,
}

impl Stretch {
    pub(super) fn holds(&self, s: f64) -> bool {
        self.start <= s && s <= self.end
    }
}

/// All stretches of one leg of a route.
#[derive(Clone, Debug)]
pub(super) struct Cuts {
    pub stretches: Vec<Stretch>,
    /// Place of each lane's first stretch, and one past the last lane's.
    first: Vec<usize>,
}

impl Cuts {
    /// Cuts every drivable lane.
    pub(super) fn new(
        map: &RoadMap,
        graph: &LaneGraph,
        black: &BlackList,
        from: Position,
        to: Position,
    ) -> Self {
        let mut cuts = Self {
            stretches: Vec::with_capacity(map.lanes().len() + 2),
            first: Vec::with_capacity(map.lanes().len() + 1),
        };
        for (id, lane) in (0u32..).map(LaneId).zip(map.lanes()) {
            cuts.first.push(cuts.stretches.len());
            let Some(node) = graph.node(id) else { continue };
            if black.roads.contains(&lane.road) {
                continue;
            }
            let mut borders = Vec::new();
            if from.lane == id {
                borders.push((from.s - MARGIN).max(0.0));
            }
            if to.lane == id {
                borders.push((to.s + MARGIN).min(node.length));
            }
            cuts.add(id, node.length, black, borders);
        }
        cuts.first.push(cuts.stretches.len());
        cuts
    }

    /// Adds what the black list leaves of a lane, cut at the borders.
    fn add(&mut self, lane: LaneId, length: f64, black: &BlackList, mut borders: Vec<f64>) {
        let mut closed: Vec<(f64, f64)> = black.closed(lane).collect();
        closed.sort_by(|a, b| a.0.total_cmp(&b.0));
        borders.push(length);
        borders.sort_by(f64::total_cmp);
        let mut start = 0.0;
        for border in borders {
            while let Some((from, to)) = closed.first().copied().filter(|(from, _)| *from < border) {
                self.push(lane, start, from);
                start = to.max(start);
                closed.remove(0);
            }
            self.push(lane, start, border);
            start = border.max(start);
        }
    }

    fn push(&mut self, lane: LaneId, start: f64, end: f64) {
        if end > start {
            self.stretches.push(Stretch { lane, start, end });
        }
    }

    /// Places of a lane's stretches.
    pub(super) fn of(&self, lane: LaneId) -> std::ops::Range<usize> {
        self.first[lane.0 as usize]..self.first[lane.0 as usize + 1]
    }

    /// The stretch that holds a start: the later one where two meet.
    pub(super) fn start(&self, at: Position) -> Option<usize> {
        self.of(at.lane)
            .rev()
            .find(|place| self.stretches[*place].holds(at.s))
    }

    /// The stretch that holds an end: the earlier one where two meet.
    pub(super) fn end(&self, at: Position) -> Option<usize> {
        self.of(at.lane).find(|place| self.stretches[*place].holds(at.s))
    }
}
