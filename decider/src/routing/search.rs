//! A* over stretches of lanes.
//!
//! The cost so far is exact and the estimate of the rest never too high, so the route found is a cheapest one among
//! those that change lanes as soon as they can; the original stores the sum of both as the cost so far and loses
//! that.

use super::cuts::Cuts;
use super::graph::{LaneGraph, place};
use super::request::Position;
use crate::road::Side;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// How a stretch was reached from the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Move {
    /// It follows.
    Forward,
    /// By a change of lane.
    Change(Side),
}

/// One stretch of a found leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    pub stretch: usize,
    /// How it was reached; the first one is `Forward`.
    pub by: Move,
}

/// A found leg.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Leg {
    pub steps: Vec<Step>,
    pub cost: f64,
}

/// What is known of a stretch.
#[derive(Clone, Copy, Debug)]
struct Label {
    /// Cost to the place of entry.
    cost: f64,
    /// Where it is entered, m.
    entry: f64,
    from: Option<(usize, Move)>,
    is_done: bool,
}

/// A stretch to look at: the least total first, among equals the first in the list.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Open {
    total: f64,
    stretch: usize,
}

impl Eq for Open {}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_total = other.total.total_cmp(&self.total);
        by_total.then(other.stretch.cmp(&self.stretch))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Searches one leg. The error holds how many stretches can be reached.
pub(super) fn search(graph: &LaneGraph, cuts: &Cuts, from: Position, to: Position) -> Result<Leg, usize> {
    let (Some(start), Some(goal)) = (cuts.start(from), cuts.end(to)) else {
        return Err(0);
    };
    let mut search = Search {
        graph,
        cuts,
        to,
        labels: vec![None; cuts.stretches.len()],
        open: BinaryHeap::new(),
    };
    search.offer(start, 0.0, from.s, None);
    let mut reached = 0;
    while let Some(Open { stretch, .. }) = search.open.pop() {
        let Some(label) = search.labels[stretch].as_mut().filter(|label| !label.is_done) else {
            continue;
        };
        label.is_done = true;
        reached += 1;
        let label = *label;
        if stretch == goal && label.entry <= to.s {
            return Ok(search.leg(goal));
        }
        search.go_on(stretch, label);
        search.change(stretch, label, Side::Left);
        search.change(stretch, label, Side::Right);
    }
    Err(reached)
}

struct Search<'a> {
    graph: &'a LaneGraph,
    cuts: &'a Cuts,
    to: Position,
    labels: Vec<Option<Label>>,
    open: BinaryHeap<Open>,
}

impl Search<'_> {
    /// Notes a way to a stretch if it is the best so far. Ways that enter it at different places are compared as if
    /// both began at its start.
    fn offer(&mut self, stretch: usize, cost: f64, entry: f64, from: Option<(usize, Move)>) {
        let rate = self
            .graph
            .node(self.cuts.stretches[stretch].lane)
            .map_or(1.0, |node| node.rate);
        let is_worse = |label: Label| label.cost - label.entry * rate <= cost - entry * rate;
        if self.labels[stretch].is_some_and(|label| label.is_done || is_worse(label)) {
            return;
        }
        let total = cost + self.estimate(stretch, entry);
        self.labels[stretch] = Some(Label {
            cost,
            entry,
            from,
            is_done: false,
        });
        self.open.push(Open { total, stretch });
    }

    /// Never more than the rest costs: a stretch can be left no nearer to the destination than its lane's chord
    /// allows. On the destination's own stretch it is what is left of it.
    fn estimate(&self, stretch: usize, entry: f64) -> f64 {
        let here = self.cuts.stretches[stretch];
        let (Some(node), Some(goal)) = (self.graph.node(here.lane), self.graph.node(self.to.lane)) else {
            return 0.0;
        };
        if here.lane == self.to.lane && here.holds(self.to.s) && entry <= self.to.s {
            return (self.to.s - entry) * node.rate;
        }
        // From the lane's start, less what of it may lie behind.
        let direct = (goal.start - node.start).norm();
        (direct - entry - goal.length).max(0.0) * self.graph.least_rate
    }

    /// To the stretches that follow.
    fn go_on(&mut self, stretch: usize, label: Label) {
        let here = self.cuts.stretches[stretch];
        let Some(node) = self.graph.node(here.lane) else {
            return;
        };
        let cost = label.cost + (here.end - label.entry).max(0.0) * node.rate;
        let next = stretch + 1;
        let follows = |next: &super::cuts::Stretch| next.lane == here.lane && next.start <= here.end;
        if self.cuts.stretches.get(next).is_some_and(follows) {
            self.offer(next, cost, here.end, Some((stretch, Move::Forward)));
        }
        if here.end < node.length {
            return;
        }
        for successor in &node.successors {
            let first = self.cuts.of(*successor).next();
            let Some(first) = first.filter(|first| self.cuts.stretches[*first].start <= 0.0) else {
                continue;
            };
            let turn = self.graph.node(*successor).map_or(0.0, |node| node.turn);
            self.offer(first, cost + turn, 0.0, Some((stretch, Move::Forward)));
        }
    }

    /// To the stretches beside, if enough of both lies side by side ahead of the place of entry.
    fn change(&mut self, stretch: usize, label: Label, side: Side) {
        let here = self.cuts.stretches[stretch];
        let least = self.graph.config.min_length_for_lane_change;
        let Some(node) = self.graph.node(here.lane) else {
            return;
        };
        let Some((to, change)) = node.changes[place(side)] else {
            return;
        };
        if here.end - label.entry < least {
            return;
        }
        let beside = |s| self.graph.station_beside(here.lane, s, to);
        let (from, until) = (beside(label.entry + least), beside(here.end));
        for place in self.cuts.of(to) {
            let there = self.cuts.stretches[place];
            let entry = from.max(there.start);
            if entry > there.end.min(until) {
                continue;
            }
            let driven = self.graph.station_beside(to, entry, here.lane) - label.entry;
            let cost = label.cost + driven.max(0.0) * node.rate + change;
            self.offer(place, cost, entry, Some((stretch, Move::Change(side))));
        }
    }

    /// Follows the labels back from the goal.
    fn leg(&self, goal: usize) -> Leg {
        let mut steps = Vec::new();
        let mut at = Some(goal);
        while let Some(stretch) = at {
            let from = self.labels[stretch].and_then(|label| label.from);
            let by = from.map_or(Move::Forward, |(_, by)| by);
            steps.push(Step { stretch, by });
            at = from.map(|(before, _)| before);
        }
        steps.reverse();
        let cost = self.labels[goal].map_or(0.0, |label| label.cost + self.estimate(goal, label.entry));
        Leg { steps, cost }
    }
}
