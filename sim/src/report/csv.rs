//! Rows as CSV (RFC 4180): a line per run, a column per metric.
//!
//! Which metrics there are is known only when all rows are: the names are asked for first.

use crate::sweep::{RunResult, SweepRow};
use std::collections::BTreeSet;
use std::io::{self, Write};

/// What stands before the metrics.
const COLUMNS: [&str; 10] = [
    "job",
    "scenario",
    "seed",
    "result",
    "ending",
    "duration",
    "signature",
    "failure",
    "digest",
    "replay",
];

/// A table that is being written.
pub struct Csv<W: Write> {
    out: W,
    metrics: BTreeSet<String>,
}

impl<W: Write> Csv<W> {
    /// Begins a table with a column for each of these metrics.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn begin(mut out: W, metrics: BTreeSet<String>) -> io::Result<Self> {
        let names: Vec<&str> = COLUMNS
            .into_iter()
            .chain(metrics.iter().map(String::as_str))
            .collect();
        writeln!(out, "{}", names.join(","))?;
        Ok(Self { out, metrics })
    }

    /// Writes one run.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn row(&mut self, row: &SweepRow) -> io::Result<()> {
        let mut cells: Vec<String> = fixed(row).into_iter().map(|cell| quoted(&cell)).collect();
        let number = |name: &String| row.metric(name).map_or(String::new(), |value| value.to_string());
        cells.extend(self.metrics.iter().map(number));
        writeln!(self.out, "{}", cells.join(","))
    }

    /// Gives back what it was written to.
    pub fn end(self) -> W {
        self.out
    }
}

fn fixed(row: &SweepRow) -> [String; COLUMNS.len()] {
    let verdict = row.verdict();
    let result = match &row.result {
        RunResult::Judged(verdict) if verdict.pass => "passed",
        RunResult::Judged(_) => "failed",
        RunResult::Broken(_) => "broken",
    };
    let word = |ending| match serde_json::to_value(ending) {
        Ok(serde_json::Value::String(word)) => word,
        _ => unreachable!("an ending is a plain name"),
    };
    let signature = verdict.and_then(|verdict| verdict.signature.as_ref());
    [
        row.job.to_string(),
        row.scenario.clone(),
        row.seed.to_string(),
        result.to_owned(),
        verdict.map_or(String::new(), |verdict| word(verdict.ending)),
        verdict.map_or(String::new(), |verdict| verdict.duration.to_string()),
        signature.map_or(String::new(), ToString::to_string),
        row.failure().unwrap_or_default().to_owned(),
        verdict.map_or(String::new(), |verdict| verdict.digest.clone()),
        row.replay.clone(),
    ]
}

/// A cell in quotes where it needs them.
fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_break_a_cell_is_quoted() {
        assert_eq!(quoted("plain text"), "plain text");
        assert_eq!(quoted("a,b"), "\"a,b\"");
        assert_eq!(quoted("the `\"x\"`\n"), "\"the `\"\"x\"\"`\n\"");
    }
}
