//! One run of a sweep: what is kept of it, and how it stands in a line of a results file.

use super::CycleTimes;
use crate::report::{Decided, Situation};
use crate::signature::Signature;
use crate::verdict::{Collision, Ending, Metric, Verdict};
use corridor_scenarios::Parameter;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::time::Duration;

/// One run of a sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SweepRow {
    /// Its place in the plan.
    pub job: u64,
    /// Name of the scenario family.
    pub scenario: String,
    /// The seed that drew its numbers.
    pub seed: u64,
    /// What came of it.
    #[serde(flatten)]
    pub result: RunResult,
    /// Whether the scenario has a goal to get to.
    pub has_goal: bool,
    /// How often the drawn scenario was rejected before this one, by reason.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub rejected: BTreeMap<String, u32>,
    /// What was tried; absent where nothing was run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tried: Option<Box<Tried>>,
    /// The command that runs it again.
    pub replay: String,
    /// How long it took on this machine. Neither hashed nor written.
    #[serde(skip)]
    pub wall_time: Duration,
    /// How long the decider took for its answers on this machine. Neither hashed nor written.
    #[serde(skip)]
    pub cycles: CycleTimes,
}

/// What a run tried: of such the coverage of a sweep is counted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tried {
    /// The numbers that its family drew.
    pub parameters: Vec<Parameter>,
    /// What the scenario is like.
    pub situation: Situation,
    /// What was decided in it.
    pub decided: Decided,
}

/// What came of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RunResult {
    /// It was run and judged.
    Judged(Box<Judgement>),
    /// It could not be run: the testbed is to blame, not the decider. Why.
    Broken(String),
}

/// A verdict without what only the look at a single run needs: of a metric that is good enough its value is kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Judgement {
    /// Whether the run ended as expected and passed every gate.
    pub pass: bool,
    /// How it ended.
    pub ending: Ending,
    /// Why it passed or failed, in one sentence.
    pub summary: String,
    /// Simulated time, s.
    pub duration: f64,
    /// The value of every metric that was measured, and is a number.
    pub metrics: BTreeMap<String, f64>,
    /// The metrics that are not good enough, gates first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub failed: Vec<Metric>,
    /// First contacts.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub collisions: Vec<Collision>,
    /// Ticks per outcome of the decider, by name.
    pub outcomes: Vec<(String, u32)>,
    /// What kind of failure it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub signature: Option<Signature>,
    /// Hash over all states, hexadecimal.
    pub digest: String,
}

impl From<Verdict> for Judgement {
    fn from(verdict: Verdict) -> Self {
        let measured = |metric: &Metric| {
            let value = metric.value.filter(|value| value.is_finite())?;
            Some((metric.name.clone(), value))
        };
        Self {
            pass: verdict.pass,
            ending: verdict.ending,
            summary: verdict.summary,
            duration: verdict.duration,
            metrics: verdict.metrics.iter().filter_map(measured).collect(),
            failed: verdict
                .metrics
                .into_iter()
                .filter(|metric| !metric.pass)
                .collect(),
            collisions: verdict.collisions,
            outcomes: verdict.outcomes,
            signature: verdict.signature,
            digest: verdict.digest,
        }
    }
}

impl SweepRow {
    /// The judgement, if there is one.
    pub fn verdict(&self) -> Option<&Judgement> {
        match &self.result {
            RunResult::Judged(judgement) => Some(judgement),
            RunResult::Broken(_) => None,
        }
    }

    /// Whether it was judged and passed.
    pub fn passed(&self) -> bool {
        self.verdict().is_some_and(|verdict| verdict.pass)
    }

    /// The value of a metric, if it was measured.
    pub fn metric(&self, name: &str) -> Option<f64> {
        self.verdict()?.metrics.get(name).copied()
    }

    /// Whether a metric is good enough; `None` where it was not measured.
    pub fn passes(&self, name: &str) -> Option<bool> {
        if self.fails(name) {
            return Some(false);
        }
        self.metric(name).map(|_| true)
    }

    /// Whether a metric is not good enough.
    pub fn fails(&self, name: &str) -> bool {
        let failed = self.verdict().map_or(&[][..], |verdict| &verdict.failed);
        failed.iter().any(|metric| metric.name == name)
    }

    /// Why it failed, in one sentence; `None` when it passed.
    pub fn failure(&self) -> Option<&str> {
        match &self.result {
            RunResult::Judged(verdict) if verdict.pass => None,
            RunResult::Judged(verdict) => Some(&verdict.summary),
            RunResult::Broken(reason) => Some(reason),
        }
    }

    /// How it ended.
    pub fn ending(&self) -> Option<Ending> {
        self.verdict().map(|verdict| verdict.ending)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_survives_its_line_but_for_the_clock() {
        let metric = |name: &str, value, pass| Metric {
            name: name.to_owned(),
            value,
            threshold: Some(1.0),
            pass,
            gate: true,
            worst_t: Some(0.1 + 0.2),
            worst_obstacle: None,
        };
        let verdict = Verdict {
            pass: false,
            ending: Ending::Timeout,
            summary: "failed: ran out of time".to_owned(),
            duration: 60.0,
            metrics: vec![
                metric("standstill", Some(12.5), false),
                metric("ttc", Some(f64::NAN), false),
                metric("progress", Some(1.0 / 3.0), true),
                metric("pull_over_success", None, true),
            ],
            collisions: Vec::new(),
            outcomes: vec![("normal".to_owned(), 600)],
            fallbacks: Vec::new(),
            signature: None,
            digest: "0123".to_owned(),
        };
        let row = SweepRow {
            job: 7,
            scenario: "nudge".to_owned(),
            seed: u64::MAX,
            result: RunResult::Judged(Box::new(verdict.into())),
            has_goal: true,
            rejected: BTreeMap::from([("overlap".to_owned(), 2)]),
            tried: None,
            replay: "corridor run nudge".to_owned(),
            wall_time: Duration::from_secs(3),
            cycles: CycleTimes::default(),
        };
        assert_eq!(
            (
                row.passes("progress"),
                row.passes("standstill"),
                row.passes("ttc"),
                row.passes("pull_over_success")
            ),
            (Some(true), Some(false), Some(false), None)
        );
        assert_eq!(
            (row.metric("ttc"), row.metric("progress")),
            (None, Some(1.0 / 3.0))
        );
        let line = serde_json::to_string(&row).unwrap();
        let back: SweepRow = serde_json::from_str(&line).unwrap();
        assert_eq!(back.seed, u64::MAX);
        assert_eq!(
            serde_json::to_string(&back).unwrap(),
            line,
            "written again, the same bytes"
        );
        let broken = SweepRow {
            result: RunResult::Broken("no map".to_owned()),
            ..row
        };
        let line = serde_json::to_string(&broken).unwrap();
        let back: SweepRow = serde_json::from_str(&line).unwrap();
        assert_eq!((back.failure(), back.passed()), (Some("no map"), false));
    }
}
