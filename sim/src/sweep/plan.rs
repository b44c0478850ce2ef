//! Which runs a sweep makes.

use corridor_scenarios::Family;

/// One run: a family by its place in the plan, and a seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
