//! Which runs a sweep makes.

use corridor_scenarios::Family;

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
        let mut jobs: Vec<Job> = Vec::new();
        for (round, family, seed) in rounds(first, FIRST_ROUNDS).chain(rounds(all, count)) {
            if jobs.len() >= count {
                break;
            }
            let job = Job {
                family,
                seed: seed.wrapping_add(round as u64),
            };
            let is_fixed = self.families[family].0.is_fixed();
            let is_known = |other: &Job| other.family == family && (is_fixed || other.seed == job.seed);
            if !jobs.iter().any(is_known) {
                jobs.push(job);
            }
        }
        jobs
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
