//! Failures by kind: those of one signature are one group, with their number and the smallest example.

use crate::signature::Signature;
use crate::sweep::SweepRow;
use serde::Serialize;
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// What failures are told apart by.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Failed(Signature),
    /// Runs that could not be made, by scenario: their reasons name seeds and numbers.
    Broken(String),
}

/// Failures of one kind.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Group {
    /// What kind: its signature in one line.
    pub kind: String,
    /// The signature; absent for runs that could not be made.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub signature: Option<Signature>,
    /// How many there are.
    pub count: u64,
    /// How many of each scenario.
    pub scenarios: BTreeMap<String, u64>,
    /// The one that is over first.
    pub smallest: Example,
}

/// One run of a group.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Example {
    /// Name of the scenario.
    pub scenario: String,
    /// Its seed.
    pub seed: u64,
    /// Simulated time, s.
    pub duration: f64,
    /// Why it failed.
    pub failure: String,
    /// The command that runs it again.
    pub replay: String,
}

impl Example {
    fn of(row: &SweepRow) -> Self {
        Self {
            scenario: row.scenario.clone(),
            seed: row.seed,
            duration: row.verdict().map_or(0.0, |verdict| verdict.duration),
            failure: row.failure().unwrap_or_default().to_owned(),
            replay: row.replay.clone(),
        }
    }

    fn is_smaller_than(&self, other: &Self) -> bool {
        let by_time = self.duration.total_cmp(&other.duration);
        let by_name = (&self.scenario, self.seed).cmp(&(&other.scenario, other.seed));
        by_time.then(by_name).is_lt()
    }
}

/// All groups.
#[derive(Clone, Debug, Default)]
pub(super) struct Groups(BTreeMap<Kind, Group>);

impl Groups {
    /// Takes in a row, if it failed.
    pub(super) fn add(&mut self, row: &SweepRow) {
        if row.passed() {
            return;
        }
        let signature = row.verdict().and_then(|verdict| verdict.signature.clone());
        let kind = match &signature {
            Some(signature) => Kind::Failed(signature.clone()),
            None => Kind::Broken(row.scenario.clone()),
        };
        let example = Example::of(row);
        let group = self.0.entry(kind).or_insert_with(|| Group {
            kind: signature
                .as_ref()
                .map_or("could not be run".to_owned(), Signature::to_string),
            signature,
            count: 0,
            scenarios: BTreeMap::new(),
            smallest: example.clone(),
        });
        group.count += 1;
        *group.scenarios.entry(row.scenario.clone()).or_insert(0) += 1;
        if example.is_smaller_than(&group.smallest) {
            group.smallest = example;
        }
    }

    /// The most frequent first; of equals, in the order of their signatures.
    pub(super) fn by_count(&self) -> Vec<&Group> {
        let mut groups: Vec<&Group> = self.0.values().collect();
        groups.sort_by_key(|group| Reverse(group.count));
        groups
    }
}
