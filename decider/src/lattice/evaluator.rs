//! The queue of pairs, cheapest first (the original's `TrajectoryEvaluator`).
//!
//! What a longitudinal curve costs alone bounds the cost of its pairs from below. So the pairs of a curve are made only
//! when that curve comes to the head of the queue: in most ticks a few of them. From then on the curve waits in the queue
//! with the cheapest of its pairs that is left.

use super::config::Weights;
use super::constraints::keeps_longitudinal_limits;
use super::cost::{Blocked, LateralProfile, LongitudinalCosts, Sampled, lateral_comfort};
use super::curve::Curve;
use super::grid::{HORIZON, SAMPLES};
use super::line_table::LineTable;
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// Room that is kept to the stop point, m (`lattice_stop_buffer`).
pub(super) const STOP_BUFFER: f64 = 0.02;

/// A pair of curves by their places in the bundles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Place of the longitudinal curve.
    pub longitudinal: usize,
    /// Place of the lateral curve.
    pub lateral: usize,
    /// What it costs.
    pub cost: f64,
}

/// Why a longitudinal curve is in no pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unfit {
    /// It passes the stop point.
    PassesStop,
    /// Its speed, acceleration or jerk is beyond what is allowed.
    BreaksLimits,
}

/// What is wrong with a longitudinal curve by itself, if anything is.
pub(super) fn unfit(curve: &Curve, stop_s: Option<f64>) -> Option<Unfit> {
    if !keeps_stop(curve, stop_s) {
        Some(Unfit::PassesStop)
    } else if !keeps_longitudinal_limits(curve) {
        Some(Unfit::BreaksLimits)
    } else {
        None
    }
}

/// Whether a curve from before the stop point stays before it within the horizon.
pub fn keeps_stop(curve: &Curve, stop_s: Option<f64>) -> bool {
    stop_s.is_none_or(|stop_s| curve.at(0.0)[0] >= stop_s || curve.at(HORIZON)[0] + STOP_BUFFER <= stop_s)
}

/// What is in the queue: a curve whose pairs are not made yet, or the cheapest of its pairs that are left.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Entry {
    cost: f64,
    longitudinal: usize,
    /// `None`: not made yet.
    lateral: Option<usize>,
}

impl Eq for Entry {}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        let places = |entry: &Self| (entry.longitudinal, entry.lateral);
        self.cost
            .total_cmp(&other.cost)
            .then(places(self).cmp(&places(other)))
    }
}

/// A longitudinal curve that may be driven.
#[derive(Clone, Debug, PartialEq)]
struct Candidate {
    /// Its place in the bundle.
    place: usize,
    /// Not in place: it is much to move when the candidates become more.
    sampled: Box<Sampled>,
    /// What it costs alone, weighted.
    costs: LongitudinalCosts,
    /// Its pairs that are left, cost and lateral curve, the cheapest last.
    left: Vec<(f64, usize)>,
}

/// The pairs of two bundles, cheapest first; among equals the first in the bundles.
#[derive(Clone, Debug)]
pub struct Evaluator<'a> {
    candidates: Vec<Candidate>,
    laterals: &'a [LateralProfile],
    weights: Weights,
    queue: BinaryHeap<Reverse<Entry>>,
}

/// What all curves are held against.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// Station that may not be passed.
    pub stop_s: Option<f64>,
    /// The guide speed.
    pub guide: &'a [f64; SAMPLES],
    /// What the path-time graph holds at the times of the grid.
    pub blocked: &'a Blocked,
    /// The line.
    pub line: &'a LineTable,
}

impl<'a> Evaluator<'a> {
    /// Filters and evaluates the longitudinal curves.
    pub fn new<'c>(
        curves: impl Iterator<Item = &'c Curve>,
        laterals: &'a [LateralProfile],
        around: &Surroundings,
        weights: Weights,
    ) -> Self {
        let mut evaluator = Self {
            candidates: Vec::new(),
            laterals,
            weights,
            queue: BinaryHeap::new(),
        };
        for (place, curve) in curves.enumerate() {
            if unfit(curve, around.stop_s).is_none() {
                evaluator.add(place, curve, around);
            }
        }
        evaluator
    }

    fn add(&mut self, place: usize, curve: &Curve, around: &Surroundings) {
        let sampled = Box::new(Sampled::new(curve));
        let costs = LongitudinalCosts::new(&sampled, around.guide, around.blocked, around.line);
        let costs = weighted(&self.weights, &costs);
        self.queue.push(Reverse(Entry {
            cost: sum(&costs),
            longitudinal: self.candidates.len(),
            lateral: None,
        }));
        self.candidates.push(Candidate {
            place,
            sampled,
            costs,
            left: Vec::new(),
        });
    }

    /// Places of the longitudinal curves that passed the filters.
    pub fn survivors(&self) -> impl Iterator<Item = usize> + '_ {
        self.candidates.iter().map(|candidate| candidate.place)
    }

    /// Number of pairs in all.
    pub fn pairs(&self) -> usize {
        self.candidates.len() * self.laterals.len()
    }

    /// Samples of a longitudinal curve by its place in the bundle.
    pub fn sampled(&self, place: usize) -> Option<&Sampled> {
        self.candidate(place).map(|candidate| &*candidate.sampled)
    }

    /// What a pair's cost is made of.
    pub fn costs(&self, pair: &Pair) -> Option<PairCosts> {
        let candidate = self.candidate(pair.longitudinal)?;
        let comfort = lateral_comfort(&candidate.sampled, &self.laterals.get(pair.lateral)?.curve);
        Some(self.pair_costs(candidate, pair.lateral, comfort))
    }

    /// What a pair's cost is made of, whose largest acceleration across the line is `comfort`.
    fn pair_costs(&self, candidate: &Candidate, lateral: usize, comfort: f64) -> PairCosts {
        let offset = self.laterals[lateral].offset_cost(candidate.sampled.way);
        PairCosts {
            longitudinal: candidate.costs,
            offset: offset * self.weights.lat_offset,
            comfort: comfort * self.weights.lat_comfort,
        }
    }

    /// The same for a survivor by its place among them.
    pub(super) fn costs_of(&self, survivor: usize, lateral: usize, comfort: f64) -> PairCosts {
        self.pair_costs(&self.candidates[survivor], lateral, comfort)
    }

    /// The survivors' places in the bundle, with their samples.
    pub(super) fn sampled_survivors(&self) -> impl Iterator<Item = (usize, &Sampled)> + '_ {
        let survivors = self.candidates.iter();
        survivors.map(|candidate| (candidate.place, &*candidate.sampled))
    }

    fn candidate(&self, place: usize) -> Option<&Candidate> {
        let found = self
            .candidates
            .binary_search_by_key(&place, |candidate| candidate.place);
        found.ok().map(|k| &self.candidates[k])
    }

    /// Makes the pairs of a survivor.
    fn open(&mut self, survivor: usize) {
        let candidate = &self.candidates[survivor];
        let cost = |(lateral, profile): (usize, &LateralProfile)| {
            let comfort = lateral_comfort(&candidate.sampled, &profile.curve);
            (self.pair_costs(candidate, lateral, comfort).sum(), lateral)
        };
        let mut pairs: Vec<(f64, usize)> = self.laterals.iter().enumerate().map(cost).collect();
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then(b.1.cmp(&a.1)));
        self.candidates[survivor].left = pairs;
    }
}

impl Iterator for Evaluator<'_> {
    type Item = Pair;

    fn next(&mut self) -> Option<Pair> {
        loop {
            let Reverse(entry) = self.queue.pop()?;
            if entry.lateral.is_none() {
                self.open(entry.longitudinal);
            }
            let candidate = &mut self.candidates[entry.longitudinal];
            if let Some((cost, lateral)) = candidate.left.pop() {
                self.queue.push(Reverse(Entry {
                    cost,
                    longitudinal: entry.longitudinal,
                    lateral: Some(lateral),
                }));
            }
            if let Some(lateral) = entry.lateral {
                return Some(Pair {
                    longitudinal: candidate.place,
                    lateral,
                    cost: entry.cost,
                });
            }
        }
    }
}

/// The six costs of a pair, each times its weight. Added up in this order they are what the pair costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairCosts {
    /// Those of the longitudinal curve alone.
    pub longitudinal: LongitudinalCosts,
    /// Departing from the line.
    pub offset: f64,
    /// Acceleration across the line.
    pub comfort: f64,
}

impl PairCosts {
    /// What the pair costs.
    pub fn sum(&self) -> f64 {
        sum(&self.longitudinal) + self.offset + self.comfort
    }
}

fn weighted(weights: &Weights, costs: &LongitudinalCosts) -> LongitudinalCosts {
    LongitudinalCosts {
        objective: costs.objective * weights.lon_objective,
        jerk: costs.jerk * weights.lon_jerk,
        collision: costs.collision * weights.lon_collision,
        centripetal: costs.centripetal * weights.centripetal_acceleration,
    }
}

fn sum(costs: &LongitudinalCosts) -> f64 {
    costs.objective + costs.jerk + costs.collision + costs.centripetal
}

/// The weighted sum of all costs of a pair.
pub fn total_cost(weights: &Weights, costs: &LongitudinalCosts, offset: f64, comfort: f64) -> f64 {
    let pair = PairCosts {
        longitudinal: weighted(weights, costs),
        offset: offset * weights.lat_offset,
        comfort: comfort * weights.lat_comfort,
    };
    pair.sum()
}
