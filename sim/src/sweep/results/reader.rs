//! Reading a results file line by line.

use super::writer::io_error;
use super::{END, End, FORMAT, Header, ResultsError};
use crate::report::SweepReport;
use crate::sweep::SweepRow;
use serde::Deserialize;
use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind};
use std::path::{Path, PathBuf};

/// Longest line that a row can come to, bytes; what is longer is no results file.
const LONGEST_LINE: u64 = 16 << 20;

/// What stands in a line after the first.
pub(super) enum Line {
    Row(Box<SweepRow>),
    End(End),
}

/// The lines of a file, up to the first that was not written to its end.
pub(super) struct Lines {
    file: BufReader<File>,
    path: PathBuf,
    /// Lines and bytes read so far, whole lines only.
    count: u64,
    bytes: u64,
    is_ended: bool,
}

impl Lines {
    pub(super) fn open(path: &Path) -> Result<Self, ResultsError> {
        let file = File::open(path).map_err(|source| io_error(path, source))?;
        Ok(Self {
            file: BufReader::new(file),
            path: path.to_owned(),
            count: 0,
            bytes: 0,
            is_ended: false,
        })
    }

    /// The first line; `None` when there is not even one whole line.
    pub(super) fn header(&mut self) -> Result<Option<Header>, ResultsError> {
        /// What tells a results file of any version from other files.
        #[derive(Deserialize)]
        struct Versioned {
            format: u32,
        }
        let Some(text) = self.line()? else { return Ok(None) };
        let versioned: Versioned = serde_json::from_str(&text)
            .map_err(|_| self.problem("this is no results file of a sweep".to_owned()))?;
        if versioned.format != FORMAT {
            let problem = format!(
                "results of format {}, this program reads {FORMAT}",
                versioned.format
            );
            return Err(self.problem(problem));
        }
        let header: Header = self.parse(&text)?;
        if header.parts == 0 || header.part >= header.parts {
            return Err(self.problem(format!("there is no part {}", header.part_text())));
        }
        Ok(Some(header))
    }

    /// The next line; `None` after the last whole one.
    pub(super) fn next(&mut self, header: &Header) -> Result<Option<Line>, ResultsError> {
        let Some(text) = self.line()? else { return Ok(None) };
        if self.is_ended {
            return Err(self.problem("stands behind the end".to_owned()));
        }
        if text.starts_with(END) {
            self.is_ended = true;
            return Ok(Some(Line::End(self.parse(&text)?)));
        }
        let row: Box<SweepRow> = self.parse(&text)?;
        let expected = header.job(self.count - 2);
        if row.job != expected {
            return Err(self.problem(format!("is job {}, expected {expected}", row.job)));
        }
        Ok(Some(Line::Row(row)))
    }

    /// Holds the last line against the rows before it.
    pub(super) fn check_end(&self, end: &End, report: &SweepReport) -> Result<(), ResultsError> {
        let expected = End::of(report);
        if *end == expected {
            return Ok(());
        }
        Err(self.problem(format!(
            "the rows come to {} runs, {} failures and digest {}, not to what the last line says",
            expected.end.runs, expected.end.failures, expected.end.digest
        )))
    }

    /// The length of all whole lines read.
    pub(super) fn whole_bytes(&self) -> u64 {
        self.bytes
    }

    /// The next whole line, without its end.
    fn line(&mut self) -> Result<Option<String>, ResultsError> {
        let mut text = Vec::new();
        let read = std::io::Read::take(&mut self.file, LONGEST_LINE).read_until(b'\n', &mut text);
        let read = read.map_err(|source| io_error(&self.path, source))?;
        if text.pop() != Some(b'\n') {
            if read as u64 == LONGEST_LINE {
                self.count += 1;
                return Err(self.problem(format!("is longer than {LONGEST_LINE} bytes")));
            }
            return Ok(None);
        }
        self.count += 1;
        self.bytes += read as u64;
        let text = String::from_utf8(text);
        text.map(Some)
            .map_err(|_| self.problem("the text is not UTF-8".to_owned()))
    }

    fn parse<T: for<'a> Deserialize<'a>>(&self, text: &str) -> Result<T, ResultsError> {
        serde_json::from_str(text).map_err(|error| self.problem(error.to_string()))
    }

    fn problem(&self, problem: String) -> ResultsError {
        ResultsError::Line {
            path: self.path.clone(),
            line: self.count,
            problem,
        }
    }
}

/// A finished results file.
#[derive(Clone, Debug)]
pub struct Results {
    path: PathBuf,
    header: Header,
    report: SweepReport,
}

impl Results {
    /// Reads a file through once, holds it against its last line, and keeps what its rows add up to.
    ///
    /// # Errors
    /// [`ResultsError::Unfinished`] without a last line, [`ResultsError::Line`] when it is damaged.
    pub fn open(path: &Path) -> Result<Self, ResultsError> {
        let mut lines = Lines::open(path)?;
        let Some(header) = lines.header()? else {
            return Err(io_error(path, ErrorKind::UnexpectedEof.into()));
        };
        let mut report = SweepReport::default();
        let mut is_done = false;
        while let Some(next) = lines.next(&header)? {
            match next {
                Line::Row(row) => report.add(&row),
                Line::End(end) => {
                    lines.check_end(&end, &report)?;
                    is_done = true;
                }
            }
        }
        if !is_done {
            return Err(ResultsError::Unfinished(path.to_owned()));
        }
        Ok(Self {
            path: path.to_owned(),
            header,
            report,
        })
    }

    /// What was run.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// What the rows add up to, but for the clock's times.
    pub fn report(&self) -> &SweepReport {
        &self.report
    }

    /// Where it lies.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The rows once more, in the order of the plan.
    ///
    /// # Errors
    /// [`ResultsError`] when the file has changed meanwhile.
    pub fn rows(&self) -> Result<impl Iterator<Item = Result<SweepRow, ResultsError>> + use<>, ResultsError> {
        let mut lines = Lines::open(&self.path)?;
        let header = self.header.clone();
        lines.header()?;
        Ok(std::iter::from_fn(move || match lines.next(&header) {
            Ok(Some(Line::Row(row))) => Some(Ok(*row)),
            Ok(Some(Line::End(_)) | None) => None,
            Err(error) => Some(Err(error)),
        }))
    }
}
