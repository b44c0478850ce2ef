//! Which runs a sweep makes.

use corridor_scenarios::Family;
use std::collections::BTreeSet;

/// Seeds of a family that something is likely to be found in, before all the others are looked at.
const FIRST_ROUNDS: usize = 8;

/// One run: a family by its place in the plan, and a seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Job {
    /// Its place in the plan.
    pub index: u64,
    family: usize,
    /// The seed to draw with.
    pub seed: u64,
}

/// Families and the runs to make of them, in order; which run is where in it follows from the numbers alone.
#[derive(Debug)]
pub struct Plan {
    /// Each with how the user named it.
    families: Vec<(Family, String)>,
    /// Places of the families without random numbers, then of those with.
    fixed: Vec<usize>,
    random: Vec<usize>,
    count: u64,
    first_seed: u64,
    shard: Shard,
}

/// A part of a plan: of `of` parts the one that begins with job `index`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which part, from 0.
    pub index: u64,
    /// Into how many parts the plan is cut; at least 1.
    pub of: u64,
}

impl Shard {
    /// All of it.
    pub const WHOLE: Self = Self { index: 0, of: 1 };
}

impl Plan {
    /// `count` runs in all, seeds from `first_seed` on. A scenario without random numbers is run once: more
    /// would be the same run again. What is left of the count goes to the families in turn.
    pub fn new(families: Vec<(Family, String)>, count: u64, first_seed: u64) -> Self {
        let (fixed, random): (Vec<usize>, Vec<usize>) =
            (0..families.len()).partition(|place| families[*place].0.is_fixed());
        let count = if random.is_empty() {
            count.min(fixed.len() as u64)
        } else {
            count
        };
        Self {
            families,
            fixed,
            random,
            count,
            first_seed,
            shard: Shard::WHOLE,
        }
    }

    /// A part of this plan. Every part has runs of every family, so that all take about the same time.
    #[must_use]
    pub fn part(self, shard: Shard) -> Self {
        Self { shard, ..self }
    }

    /// How many runs there are.
    pub fn len(&self) -> u64 {
        self.count
            .saturating_sub(self.shard.index)
            .div_ceil(self.shard.of)
    }

    /// Whether there is nothing to run.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many runs the whole has of which this may be a part.
    pub fn whole_len(&self) -> u64 {
        self.count
    }

    /// Which part it is.
    pub fn shard(&self) -> Shard {
        self.shard
    }

    /// The first seed.
    pub fn first_seed(&self) -> u64 {
        self.first_seed
    }

    /// The `nth` run of this part.
    #[expect(
        clippy::missing_panics_doc,
        reason = "a remainder of the number of families is a place in them"
    )]
    pub fn job(&self, nth: u64) -> Job {
        let index = self.shard.index + nth * self.shard.of;
        let fixed = self.fixed.len() as u64;
        let place = |k: u64| usize::try_from(k).expect("a remainder of the number of families");
        if index < fixed {
            return Job {
                index,
                family: self.fixed[place(index)],
                seed: self.first_seed,
            };
        }
        let (turn, family) = (
            (index - fixed) / self.random.len() as u64,
            (index - fixed) % self.random.len() as u64,
        );
        Job {
            index,
            family: self.random[place(family)],
            seed: self.first_seed.wrapping_add(turn),
        }
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
            is_new.then_some(Job {
                index: 0,
                family,
                seed,
            })
        });
        jobs.take(count).collect()
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

    /// The family of this name.
    pub fn find(&self, name: &str) -> Option<&Family> {
        self.families().find(|family| family.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use corridor_scenarios::{MapCache, catalog};
    use std::path::Path;

    fn family(name: &str, cruise: &str) -> (Family, String) {
        let text = format!("description = \"x\"\nmap = \"urban_parking\"\ncruise_speed = {cruise}\n");
        let file = format!("{name}.toml");
        (
            Family::parse(&text, &file, Path::new("")).unwrap(),
            name.to_owned(),
        )
    }

    fn plan(count: u64) -> Plan {
        let law = "{ uniform = [5.0, 8.0] }";
        Plan::new(
            vec![family("a", law), family("b", "7.0"), family("c", law)],
            count,
            5,
        )
    }

    fn runs(plan: &Plan) -> Vec<(u64, String, u64)> {
        let run = |nth| {
            let job = plan.job(nth);
            (job.index, plan.family(job).1.to_owned(), job.seed)
        };
        (0..plan.len()).map(run).collect()
    }

    #[test]
    fn what_is_fixed_runs_once_and_first_and_the_others_in_turn() {
        let names: Vec<String> = runs(&plan(6))
            .iter()
            .map(|(_, name, seed)| format!("{name}{seed}"))
            .collect();
        assert_eq!(names, ["b5", "a5", "c5", "a6", "c6", "a7"]);
        assert_eq!(Plan::new(vec![family("b", "7.0")], 9, 1).len(), 1);
    }

    #[test]
    fn the_parts_are_the_whole_and_share_nothing() {
        for (count, of) in [(10, 4), (3, 4), (8, 1), (9, 3)] {
            let parts = (0..of).flat_map(|index| runs(&plan(count).part(Shard { index, of })));
            let mut parts: Vec<_> = parts.collect();
            parts.sort();
            assert_eq!(parts, runs(&plan(count)), "{count} in {of}");
        }
    }

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
