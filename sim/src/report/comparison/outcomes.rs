//! What a run can have or lack, counted over pairs. Names are close to those of the metrics of a verdict; an outcome is to
//! be within the threshold.

use super::{Pair, Test};
use crate::sweep::SweepRow;
use crate::sweep::paired::mcnemar;
use crate::verdict::Ending;
use serde::Serialize;

/// Whether a run has it; `None` where it was not asked for or there was no occasion.
type Has = fn(&SweepRow) -> Option<bool>;

/// The outcomes in the order of the table.
const OUTCOMES: [(&str, Has); 10] = [
    ("passed", |row| Some(row.passed())),
    ("scenario_completed", |row| row.passes("scenario_completed")),
    ("no_at_fault_collision", |row| row.passes("no_at_fault_collision")),
    ("no_collision", |row| row.passes("no_collision")),
    ("drivable_area", |row| row.passes("drivable_area")),
    ("no_standstill", |row| row.passes("standstill")),
    ("goal_reached", |row| {
        row.has_goal.then(|| row.ending() == Some(Ending::GoalReached))
    }),
    ("pull_over_success", |row| {
        row.metric("pull_over_success").map(|share| share >= 1.0)
    }),
    ("ttc_kept", |row| row.passes("ttc")),
    ("comfort_kept", |row| {
        row.metric("comfort").map(|worst| worst <= 1.0)
    }),
];

/// How many pairs have it under both, one or neither.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub(super) struct Fourfold {
    pub(super) both: u64,
    pub(super) only_first: u64,
    pub(super) only_second: u64,
    pub(super) neither: u64,
}

impl Fourfold {
    /// Counts pairs.
    pub(super) fn of(pairs: impl IntoIterator<Item = [bool; 2]>) -> Self {
        let mut counts = Self::default();
        for pair in pairs {
            let count = match pair {
                [true, true] => &mut counts.both,
                [true, false] => &mut counts.only_first,
                [false, true] => &mut counts.only_second,
                [false, false] => &mut counts.neither,
            };
            *count += 1;
        }
        counts
    }

    /// All pairs.
    pub(super) fn pairs(self) -> u64 {
        self.both + self.only_first + self.only_second + self.neither
    }
}

/// One outcome over all pairs, tested by `McNemar`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct OutcomeRow {
    pub(super) name: &'static str,
    #[serde(flatten)]
    pub(super) counts: Fourfold,
    #[serde(flatten)]
    pub(super) test: Test,
}

/// A row for each outcome that any pair was asked for.
pub(super) fn rows(pairs: &[Pair]) -> Vec<OutcomeRow> {
    let row = |(name, has): (&'static str, Has)| {
        let counts = Fourfold::of(pairs.iter().filter_map(|pair| {
            let [first, second] = pair.map(has);
            Some([first?, second?])
        }));
        OutcomeRow {
            name,
            counts,
            test: Test::new(mcnemar(counts.only_first, counts.only_second)),
        }
    };
    let rows = OUTCOMES.into_iter().map(row);
    rows.filter(|row| row.counts.pairs() > 0).collect()
}
