//! The parts of a sweep as one.

use super::reader::Results;
use super::writer::ResultsWriter;
use super::{Header, ResultsError};
use crate::report::SweepReport;
use std::path::{Path, PathBuf};

/// Writes the results of all parts of one sweep to `out`, to the byte what the sweep in one piece would have written.
/// Returns what they add up to.
///
/// # Errors
/// [`ResultsError::Parts`] when a part is missing or there twice, [`ResultsError::Other`] when one is of another sweep or
/// another program, [`ResultsError::Unfinished`] when one is not done.
pub fn merge(out: &Path, paths: &[PathBuf]) -> Result<SweepReport, ResultsError> {
    let parts = complete(paths)?;
    let header = Header {
        part: 0,
        parts: 1,
        ..parts[0].header().clone()
    };
    let mut sources = Vec::new();
    for part in &parts {
        sources.push(part.rows()?);
    }
    // The file appears when it is whole: a merge that fails leaves nothing behind.
    let partial = out.with_added_extension("partial");
    let written = write(&partial, &header, &mut sources);
    let placed = written.and_then(|report| {
        let renamed = std::fs::rename(&partial, out);
        renamed
            .map(|()| report)
            .map_err(|source| super::writer::io_error(out, source))
    });
    if placed.is_err() {
        // The first error is the one to tell.
        let _ = std::fs::remove_file(&partial);
    }
    placed
}

/// All parts of one sweep, each once, in their order.
fn complete(paths: &[PathBuf]) -> Result<Vec<Results>, ResultsError> {
    let mut parts = Vec::new();
    for path in paths {
        parts.push(Results::open(path)?);
    }
    let Some(first) = parts.first() else {
        return Err(ResultsError::Parts("there is nothing to merge".to_owned()));
    };
    let whole = first.header().clone();
    for part in &parts {
        let expected = Header {
            part: part.header().part,
            ..whole.clone()
        };
        part.header().check(part.path(), &expected)?;
    }
    parts.sort_by_key(|part| part.header().part);
    if let Some(pair) = parts
        .windows(2)
        .find(|pair| pair[0].header().part == pair[1].header().part)
    {
        return Err(ResultsError::Parts(format!(
            "part {} is there twice: `{}` and `{}`",
            pair[0].header().part_text(),
            pair[0].path().display(),
            pair[1].path().display()
        )));
    }
    let is_there = |part: &u64| parts.iter().any(|found| found.header().part == *part);
    let missing: Vec<String> = (0..whole.parts)
        .filter(|part| !is_there(part))
        .take(10)
        .map(|part| format!("{}/{}", part + 1, whole.parts))
        .collect();
    if !missing.is_empty() {
        return Err(ResultsError::Parts(format!(
            "missing: part {}",
            missing.join(", ")
        )));
    }
    Ok(parts)
}

/// Takes a row of each part in turn, as the plan dealt them out.
fn write<R>(path: &Path, header: &Header, sources: &mut [R]) -> Result<SweepReport, ResultsError>
where
    R: Iterator<Item = Result<crate::sweep::SweepRow, ResultsError>>,
{
    let mut writer = ResultsWriter::begin(path, header)?;
    let mut report = SweepReport::default();
    let turns = sources.len();
    for turn in (0..turns).cycle() {
        let Some(row) = sources[turn].next() else { break };
        let row = row?;
        report.add(&row);
        writer.add(&row)?;
    }
    writer.finish(&report)?;
    Ok(report)
}
