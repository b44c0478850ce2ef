//! Which runs a sweep makes.

use corridor_scenarios::Family;
use std::collections::BTreeSet;

/// Seeds of a family that something is likely to be found in, before all the others are looked at.
const FIRST_ROUNDS: usize = 8;

/// One run: a family by its place in the plan, and a seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Job {
    family: usize,
    /// The seed to draw with.
    pub seed: u64,
}

/// Families and the runs to make of them.
#[derive(Debug)]
pub struct Plan {
    /// Each with how the user named it.
    families: Vec<(Family, String)>,
    jobs: Vec<Job>,
}

impl Plan {
    /// `count` runs in all, seeds from `first_seed` on. A scenario without random numbers is run once: more
    /// would be the same run again. What is left of the count goes to the families in turn.
    pub fn new(families: Vec<(Family, String)>, count: usize, first_seed: u64) -> Self {
        let random: Vec<usize> = (0..families.len())
            .filter(|k| !families[*k].0.is_fixed())
            .collect();
        let fixed = (0..families.len()).filter(|k| families[*k].0.is_fixed());
        let mut jobs: Vec<Job> = fixed
            .take(count)
            .map(|family| Job {
                family,
                seed: first_seed,
            })
            .collect();
        if !random.is_empty() {
            for k in 0..count - jobs.len() {
                let seed = first_seed.wrapping_add((k / random.len()) as u64);
                jobs.push(Job {
                    family: random[k % random.len()],
                    seed,
                });
            }
        }
        Self { families, jobs }
    }

    /// At most `count` runs for the search for something: first some seeds of each of the `first` families, from the seed
    /// named with it on, then all families in turn, from `seed` on. None twice; families without random numbers once.
    pub(super) fn in_turn(&self, first: &[(&str, u64)], seed: u64, count: usize) -> Vec<Job> {
        let place = |name: &str| self.families().position(|family| family.name() == name);
        let first = first
            .iter()
            .filter_map(|(name, seed)| Some((place(name)?, *seed)));
        let first: Vec<(usize, u64)> = first.collect();
        let all: Vec<(usize, u64)> = (0..self.families.len()).map(|family| (family, seed)).collect();
        let rounds = |families: Vec<(usize, u64)>, rounds: usize| {
            (0..rounds).flat_map(move |round| {
                let jobs = families.clone().into_iter();
                jobs.map(move |(family, seed)| (round, family, seed))
            })
        };
        let mut known = BTreeSet::new();
        let jobs = rounds(first, FIRST_ROUNDS).chain(rounds(all, count));
        let jobs = jobs.filter_map(|(round, family, from)| {
            let seed = from.wrapping_add(round as u64);
            let is_fixed = self.families[family].0.is_fixed();
            let is_new = known.insert((family, if is_fixed { 0 } else { seed }));
            is_new.then_some(Job { family, seed })
        });
        jobs.take(count).collect()
    }

    /// The runs, in no particular order.
    pub fn jobs(&self) -> &[Job] {
        &self.jobs
    }

    /// The family of a job and how the user named it.
    pub fn family(&self, job: Job) -> (&Family, &str) {
        let (family, given) = &self.families[job.family];
        (family, given)
    }

    /// All families.
    pub fn families(&self) -> impl Iterator<Item = &Family> {
        self.families.iter().map(|(family, _)| family)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use corridor_scenarios::{MapCache, catalog};

    #[test]
    fn a_search_begins_where_it_is_told_and_looks_at_nothing_twice() {
        let maps = MapCache::new();
        let names = ["empty_road", "nudge_sweep", "two_cones"];
        let family = |name: &str| (catalog::find(name).unwrap().load(&maps).unwrap(), name.to_owned());
        let plan = Plan::new(names.map(family).into(), 0, 1);
        let jobs = plan.in_turn(&[("two_cones", 7), ("not_there", 1)], 1, 14);
        let told: Vec<(usize, u64)> = jobs.iter().map(|job| (job.family, job.seed)).collect();
        let first: Vec<(usize, u64)> = (7..15).map(|seed| (2, seed)).collect();
        assert_eq!(told[..8], first);
        assert_eq!(told[8..], [(0, 1), (1, 1), (2, 1), (1, 2), (2, 2), (1, 3)]);
        assert_eq!(plan.in_turn(&[], 1, 2).len(), 2);
    }
}
