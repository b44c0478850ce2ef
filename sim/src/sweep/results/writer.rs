//! Writing a results file, from the start or from where it was left.

use super::reader::{Line, Lines};
use super::{End, Header, ResultsError, line};
use crate::report::SweepReport;
use crate::sweep::SweepRow;
use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A results file that is being written.
#[derive(Debug)]
pub struct ResultsWriter {
    file: File,
    path: PathBuf,
    rows: u64,
    is_done: bool,
}

impl ResultsWriter {
    /// Begins a file.
    ///
    /// # Errors
    /// [`ResultsError::WouldBeLost`] where an unfinished one lies, [`ResultsError::Io`] when it cannot be written.
    pub fn create(path: &Path, header: &Header) -> Result<Self, ResultsError> {
        if path.is_file() && is_unfinished(path) {
            return Err(ResultsError::WouldBeLost(path.to_owned()));
        }
        Self::begin(path, header)
    }

    pub(super) fn begin(path: &Path, header: &Header) -> Result<Self, ResultsError> {
        let mut writer = Self {
            file: File::create(path).map_err(|source| io_error(path, source))?,
            path: path.to_owned(),
            rows: 0,
            is_done: false,
        };
        writer.put(header)?;
        Ok(writer)
    }

    /// Goes on with a file, or begins it where there is none. `taken` hears of every row that is in it. A last line of
    /// which only a part was written is cut off.
    ///
    /// # Errors
    /// [`ResultsError::Other`] when it is of another sweep, [`ResultsError::Line`] when it is damaged.
    pub fn resume(
        path: &Path,
        header: &Header,
        mut taken: impl FnMut(&SweepRow),
    ) -> Result<Self, ResultsError> {
        if !path.exists() {
            return Self::begin(path, header);
        }
        let mut lines = Lines::open(path)?;
        let Some(found) = lines.header()? else {
            return Self::begin(path, header);
        };
        found.check(path, header)?;
        let mut report = SweepReport::default();
        let mut is_done = false;
        while let Some(next) = lines.next(&found)? {
            match next {
                Line::Row(row) => {
                    report.add(&row);
                    taken(&row);
                }
                Line::End(end) => {
                    lines.check_end(&end, &report)?;
                    is_done = true;
                }
            }
        }
        let file = OpenOptions::new().append(true).open(path);
        let file = file.and_then(|file| file.set_len(lines.whole_bytes()).map(|()| file));
        Ok(Self {
            file: file.map_err(|source| io_error(path, source))?,
            path: path.to_owned(),
            rows: report.runs(),
            is_done,
        })
    }

    /// How many rows it holds.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Whether it has its last line.
    pub fn is_done(&self) -> bool {
        self.is_done
    }

    /// Appends a row.
    ///
    /// # Errors
    /// [`ResultsError::Io`] when it cannot be written.
    pub fn add(&mut self, row: &SweepRow) -> Result<(), ResultsError> {
        self.rows += 1;
        self.put(row)
    }

    /// Ends the file, if it is not ended yet. `report` holds all its rows.
    ///
    /// # Errors
    /// [`ResultsError::Io`] when it cannot be written.
    pub fn finish(mut self, report: &SweepReport) -> Result<(), ResultsError> {
        if self.is_done {
            return Ok(());
        }
        self.put(&End::of(report))
    }

    /// A line goes out in one piece, so that only the last one can be torn.
    fn put(&mut self, value: &impl serde::Serialize) -> Result<(), ResultsError> {
        line(value)
            .and_then(|line| self.file.write_all(line.as_bytes()))
            .map_err(|source| io_error(&self.path, source))
    }
}

/// Whether rows lie there that no last line follows.
fn is_unfinished(path: &Path) -> bool {
    let is_whole = || -> Result<bool, ResultsError> {
        let mut lines = Lines::open(path)?;
        let Some(header) = lines.header()? else {
            return Ok(true);
        };
        let mut rows = 0;
        while let Some(next) = lines.next(&header)? {
            match next {
                Line::Row(_) => rows += 1,
                Line::End(_) => return Ok(true),
            }
        }
        Ok(rows == 0)
    };
    // What is no results file at all is nobody's sweep.
    !is_whole().unwrap_or(true)
}

pub(super) fn io_error(path: &Path, source: io::Error) -> ResultsError {
    ResultsError::Io {
        path: path.to_owned(),
        source,
    }
}
