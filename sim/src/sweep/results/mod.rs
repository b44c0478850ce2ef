//! Results files: one JSON object a line, appended as the runs end, in the order of the plan.
//!
//! The first line says what is run, the last one that it is done and what it came to; between them stands a row for every
//! run. Nothing in it comes from a clock or from the number of threads: a sweep that was killed and resumed, or cut into
//! parts and merged, ends in the same bytes as one that was left alone.

mod merge;
mod reader;
#[cfg(test)]
mod tests;
mod writer;

pub use merge::merge;
pub use reader::Results;
pub use writer::ResultsWriter;

use super::{Plan, Shard, Variant};
use crate::report::SweepReport;
use crate::run::run;
use crate::settings::Settings;
use corridor_scenarios::{MapCache, catalog};
use serde::{Deserialize, Serialize};
use std::io;
use std::path::{Path, PathBuf};

/// Version of this layout.
const FORMAT: u32 = 1;

/// The run by whose states programs are told apart: it nudges past a parked car, on a map of the program.
const REFERENCE: &str = "nudge_parked_car";

/// Why a results file cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ResultsError {
    /// It cannot be read or written.
    #[error("`{path}`: {source}")]
    Io {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        source: io::Error,
    },
    /// A line is not what it should be.
    #[error("`{path}` line {line}: {problem}")]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// What is wrong with it.
        problem: String,
    },
    /// The sweep that wrote it has not come to its end.
    #[error("`{0}` is unfinished: `corridor sweep … --results {0} --resume` goes on with it")]
    Unfinished(PathBuf),
    /// It holds an unfinished sweep that would be lost.
    #[error("`{0}` holds an unfinished sweep: go on with it by `--resume`, or remove it")]
    WouldBeLost(PathBuf),
    /// It is of another sweep.
    #[error("`{path}` is of another sweep: its {what} is {found}, not {expected}")]
    Other {
        /// The file.
        path: PathBuf,
        /// What differs.
        what: &'static str,
        /// What the file has.
        found: String,
        /// What it should have.
        expected: String,
    },
    /// The parts do not make a whole.
    #[error("{0}")]
    Parts(String),
}

/// What is run: the first line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// Version of this layout.
    pub format: u32,
    /// Version of the program.
    pub build: String,
    /// What a reference run of the program comes to: programs that drive differently are not mixed.
    pub behaviour: String,
    /// The scenarios as given.
    pub scenarios: Vec<String>,
    /// Hash over the texts of all scenarios and maps.
    pub content: String,
    /// Settings that are not the defaults.
    pub settings: Vec<String>,
    /// How many runs the whole has; of a claim, how many at most.
    pub count: u64,
    /// The first seed.
    pub first_seed: u64,
    /// The failure rate that is claimed or refuted, if that ends the sweep.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<f64>,
    /// Which part of the whole this is, from 0.
    pub part: u64,
    /// Into how many parts it is cut.
    pub parts: u64,
}

impl Header {
    /// Of a sweep that is about to start.
    pub fn new(plan: &Plan, scenarios: &[String], variant: &Variant, until: Option<f64>) -> Self {
        let Shard { index, of } = plan.shard();
        Self {
            format: FORMAT,
            build: env!("CARGO_PKG_VERSION").to_owned(),
            behaviour: behaviour(),
            scenarios: scenarios.to_vec(),
            content: content(plan),
            settings: variant.overrides.clone(),
            count: plan.whole_len(),
            first_seed: plan.first_seed(),
            until,
            part: index,
            parts: of,
        }
    }

    /// The first thing in which a file of this header differs from what is `expected`, if anything does.
    fn check(&self, path: &Path, expected: &Self) -> Result<(), ResultsError> {
        let fields = [
            ("version", self.build.clone(), expected.build.clone()),
            ("behaviour", self.behaviour.clone(), expected.behaviour.clone()),
            (
                "list of scenarios",
                self.scenarios.join(" "),
                expected.scenarios.join(" "),
            ),
            (
                "hash of scenarios and maps",
                self.content.clone(),
                expected.content.clone(),
            ),
            (
                "list of settings",
                quoted(&self.settings),
                quoted(&expected.settings),
            ),
            ("count", self.count.to_string(), expected.count.to_string()),
            (
                "first seed",
                self.first_seed.to_string(),
                expected.first_seed.to_string(),
            ),
            (
                "claim",
                format!("{:?}", self.until),
                format!("{:?}", expected.until),
            ),
            ("part", self.part_text(), expected.part_text()),
        ];
        match fields.into_iter().find(|(_, found, expected)| found != expected) {
            Some((what, found, expected)) => Err(ResultsError::Other {
                path: path.to_owned(),
                what,
                found,
                expected,
            }),
            None => Ok(()),
        }
    }

    fn part_text(&self) -> String {
        format!("{}/{}", self.part + 1, self.parts)
    }

    /// The place in the plan of the `nth` run of this part.
    fn job(&self, nth: u64) -> u64 {
        self.part + nth * self.parts
    }
}

fn quoted(settings: &[String]) -> String {
    format!("`{}`", settings.join(" "))
}

/// The last line.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct End {
    end: Totals,
}

/// What the rows come to, to see that none is missing or changed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Totals {
    runs: u64,
    failures: u64,
    digest: String,
}

impl End {
    fn of(report: &SweepReport) -> Self {
        Self {
            end: Totals {
                runs: report.runs(),
                failures: report.failures(),
                digest: report.digest(),
            },
        }
    }
}

/// How the last line begins; no row begins so.
const END: &str = "{\"end\":";

/// One object as a line.
fn line(value: &impl Serialize) -> io::Result<String> {
    let mut line = serde_json::to_string(value)?;
    line.push('\n');
    Ok(line)
}

/// The digest of the reference run under the defaults.
fn behaviour() -> String {
    let entry = catalog::find(REFERENCE).expect("it is in the catalog");
    let family = entry.load(&MapCache::new()).expect("the catalog is sound");
    let drawn = family.draw(1).expect("it can be drawn");
    run(&drawn.scenario, &Settings::default()).digest
}

/// A hash over all that the plan's families read.
fn content(plan: &Plan) -> String {
    let mut hash = crate::world::Fnv::new();
    let mut text = |text: &str| {
        hash.word(text.len() as u64);
        text.bytes().for_each(|byte| hash.word(u64::from(byte)));
    };
    for family in plan.families() {
        text(family.name());
        text(family.source());
        text(family.map_text());
    }
    format!("{:016x}", hash.finish())
}
