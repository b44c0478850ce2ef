//! Everything that was weighed along one line, for people to look at: every curve, every pair, what it costs and why it
//! may not be driven.
//!
//! The plan stops at the first pair that may be driven; here all of them are held against everything, by the same code.

use super::PlanningTarget;
use super::bundle::Longitudinal;
use super::combine::Motions;
use super::cost::comfort_sampled;
use super::curve::Curve;
use super::evaluator::{Pair, PairCosts, Unfit, unfit};
use super::path_time_graph::PathTimeEntry;
use super::plan::{Laid, Lattice, Planned, Rejection};
use crate::geometry::frenet::FrenetMotion;

/// A pair with what is wrong with it, if anything is.
pub type Assessed = (Pair, Option<Rejection>);

/// What there was to choose from along one line, and what was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// Where the curves start.
    pub initial: FrenetMotion,
    /// What the plan was for.
    pub target: PlanningTarget,
    /// What the path-time graph holds.
    pub entries: Vec<PathTimeEntry>,
    /// The longitudinal curves, with what keeps them out of all pairs.
    pub longitudinal: Vec<(Longitudinal, Option<Unfit>)>,
    /// The lateral curves.
    pub lateral: Vec<Curve>,
    /// Every pair, in the order of the longitudinal curves and then of the lateral ones.
    pub pairs: Vec<Assessed>,
    /// What the cost of each pair is made of.
    pub costs: Vec<PairCosts>,
    /// What is driven.
    pub planned: Planned,
}

impl Lattice<'_> {
    /// Every pair with what is wrong with it, in the order of the longitudinal curves and then of the lateral ones.
    pub fn assessed(&self) -> Vec<Assessed> {
        let queue = self.pairs();
        let mut assessed = Vec::with_capacity(queue.pairs());
        let (mut laid, mut motions) = (Laid::default(), Motions::default());
        for (survivor, (longitudinal, sampled)) in queue.sampled_survivors().enumerate() {
            self.lay(sampled, &mut laid);
            for lateral in 0..self.laterals.len() {
                let rejection = self.rejection(&laid, lateral, &mut motions);
                let comfort = comfort_sampled(sampled, &self.laterals[lateral].curve, &motions.lateral);
                let pair = Pair {
                    longitudinal,
                    lateral,
                    cost: queue.costs_of(survivor, lateral, comfort).sum(),
                };
                assessed.push((pair, rejection));
            }
        }
        assessed
    }

    /// All that was weighed, and the plan that came of it; `None` where there is no plan.
    pub fn survey(&self) -> Option<Survey> {
        let planned = self.plan()?;
        let (pairs, queue) = (self.assessed(), self.pairs());
        let stop_s = self.task.target.stop_s;
        let with_fault =
            |longitudinal: &Longitudinal| (longitudinal.clone(), unfit(&longitudinal.curve, stop_s));
        Some(Survey {
            initial: self.task.initial,
            target: self.task.target,
            entries: self.graph.entries.clone(),
            longitudinal: self.longitudinal.iter().map(with_fault).collect(),
            lateral: self
                .laterals
                .iter()
                .map(|lateral| lateral.curve.clone())
                .collect(),
            costs: pairs.iter().filter_map(|(pair, _)| queue.costs(pair)).collect(),
            pairs,
            planned,
        })
    }
}
