//! Reads a trace, whole or cut off, and refuses everything else with the place of the mistake.

use super::record::{Header, Record, TickRecord};
use super::{FORMAT, TraceError, check};
use crate::verdict::Verdict;
use corridor_decider::frame::{Frame, FrameLine, ObstacleId};
use corridor_decider::reference_line::ReferenceLine;
use serde::Deserialize;
use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Read};
use std::path::Path;

/// First bytes of every zstd frame.
const ZSTD_MAGIC: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];

/// Most bytes a trace may have when decompressed: ten minutes among a hundred obstacles take half of it.
const MAX_BYTES: u64 = 1 << 30;

/// Most bytes of one line: the header holds the map, and the largest map there is takes a third.
const MAX_LINE_BYTES: u64 = 256 << 20;

/// One run, as it was recorded.
#[derive(Clone, Debug)]
pub struct Trace {
    /// What was run.
    pub header: Header,
    /// What happened, in order.
    pub ticks: Vec<TickRecord>,
    /// How it ended; absent when the run was killed.
    pub verdict: Option<Verdict>,
    /// Whether the file ends before its end.
    pub truncated: bool,
}

impl Trace {
    /// Reads the trace at `path`.
    ///
    /// A trace that is cut off is read as far as it goes, and says so in [`Trace::truncated`].
    ///
    /// # Errors
    /// [`TraceError`] when there is no file, it is no trace, has another format, is damaged, or a line of it is
    /// not what it should be.
    pub fn open(path: &Path) -> Result<Self, TraceError> {
        let file = File::open(path).map_err(|source| TraceError::Io {
            path: path.to_owned(),
            source,
        })?;
        Self::read(BufReader::new(file), path, MAX_BYTES)
    }

    /// Reads a trace that is in memory; `name` is for messages only.
    ///
    /// # Errors
    /// As [`Trace::open`].
    pub fn from_bytes(bytes: &[u8], name: &Path) -> Result<Self, TraceError> {
        Self::read(bytes, name, MAX_BYTES)
    }

    /// Reads a trace of at most `limit` bytes; `path` is for messages only.
    pub(super) fn read(mut file: impl BufRead, path: &Path, limit: u64) -> Result<Self, TraceError> {
        let mut lines = Lines::new(&mut file, path, limit)?;
        let header = lines.header()?;
        let mut trace = Self {
            header,
            ticks: Vec::new(),
            verdict: None,
            truncated: false,
        };
        while let Some(line) = lines.next()? {
            let record = serde_json::from_slice(line).map_err(|e| e.to_string());
            let added = record.and_then(|record| trace.add(record));
            added.map_err(|problem| lines.problem(problem))?;
        }
        trace.truncated = lines.cut_off || trace.verdict.is_none();
        Ok(trace)
    }

    fn add(&mut self, record: Record) -> Result<(), String> {
        if self.verdict.is_some() {
            return Err("nothing may follow the verdict".to_owned());
        }
        match record {
            Record::Header(_) => return Err("a second header".to_owned()),
            Record::Tick(mut tick) => {
                let known = self.header.lines.len();
                self.header.lines.append(&mut tick.new_lines);
                check::lines(&self.header.lines, known)?;
                check::tick(&self.header, &tick)?;
                self.ticks.push(*tick);
            }
            Record::Verdict(verdict) => self.verdict = Some(*verdict),
        }
        Ok(())
    }

    /// What the decider saw in the tick at place `k`, lines included: it can be decided again alone.
    pub fn frame(&self, k: usize) -> Option<Frame> {
        let record = self.ticks.get(k)?;
        let line = |(place, is_change_lane): &(usize, bool)| FrameLine {
            line: self.header.lines[*place].clone(),
            is_change_lane: *is_change_lane,
        };
        Some(Frame {
            lines: record.lines.iter().map(line).collect(),
            ..record.frame.clone()
        })
    }

    /// Place of the last tick that started at or before `time`, or the first one; `None` without ticks.
    pub fn tick_at(&self, time: f64) -> Option<usize> {
        // A time typed in decimals must find the tick whose time is a sum of periods.
        let time = time + self.header.tick * 1e-6;
        let after = self.ticks.partition_point(|tick| tick.frame.time <= time);
        (!self.ticks.is_empty()).then(|| after.saturating_sub(1))
    }

    /// The line that `tick` was decided along.
    pub fn line(&self, tick: &TickRecord) -> &ReferenceLine {
        &self.header.lines[tick.lines[tick.decision.line].0]
    }

    /// Name of an obstacle, or its number where the header names none.
    pub fn obstacle(&self, id: ObstacleId) -> String {
        let name = self.header.obstacle_names.get(id.0 as usize);
        name.map_or_else(|| format!("#{}", id.0), Clone::clone)
    }
}

/// The decompressed lines of a trace.
struct Lines<'a, R: BufRead> {
    path: &'a Path,
    text: BufReader<zstd::stream::read::Decoder<'static, R>>,
    line: Vec<u8>,
    /// Number of the line, from 1.
    number: usize,
    bytes_left: u64,
    limit: u64,
    /// Whether the file ends before its frame does, or in the middle of a line.
    cut_off: bool,
}

/// Just enough of a header to see who wrote it.
#[derive(Deserialize)]
struct Version {
    header: FormatOnly,
}

#[derive(Deserialize)]
struct FormatOnly {
    format: u32,
}

impl<'a, R: BufRead> Lines<'a, R> {
    fn new(mut file: R, path: &'a Path, limit: u64) -> Result<Self, TraceError> {
        let io = |source| TraceError::Io {
            path: path.to_owned(),
            source,
        };
        let start = file.fill_buf().map_err(io)?;
        if start.is_empty() {
            return Err(TraceError::Empty(path.to_owned()));
        }
        let length = start.len().min(ZSTD_MAGIC.len());
        if start[..length] != ZSTD_MAGIC[..length] {
            return Err(TraceError::NotATrace {
                path: path.to_owned(),
                reason: "it is not compressed with zstd".to_owned(),
            });
        }
        let decoder = zstd::stream::read::Decoder::with_buffer(file).map_err(io)?;
        Ok(Self {
            path,
            text: BufReader::with_capacity(1 << 17, decoder),
            line: Vec::new(),
            number: 0,
            bytes_left: limit,
            limit,
            cut_off: false,
        })
    }

    /// The first line.
    fn header(&mut self) -> Result<Header, TraceError> {
        let path = self.path.to_owned();
        let Some(line) = self.next()? else {
            return Err(TraceError::Empty(path));
        };
        let version: Version = serde_json::from_slice(line).map_err(|e| TraceError::NotATrace {
            path: path.clone(),
            reason: format!("its first line is no header: {e}"),
        })?;
        let found = version.header.format;
        if found != FORMAT {
            return Err(TraceError::Version {
                path,
                found,
                expected: FORMAT,
            });
        }
        let header = match serde_json::from_slice(line) {
            Ok(Record::Header(header)) => check::header(&header).map(|()| *header),
            Ok(_) => Err("the first line must be the header".to_owned()),
            Err(e) => Err(e.to_string()),
        };
        header.map_err(|problem| self.problem(problem))
    }

    /// The next whole line; `None` at the end, or where the file was cut off.
    fn next(&mut self) -> Result<Option<&[u8]>, TraceError> {
        self.line.clear();
        let most = self.bytes_left.min(MAX_LINE_BYTES);
        let read = (&mut self.text).take(most).read_until(b'\n', &mut self.line);
        self.bytes_left -= (self.line.len() as u64).min(self.bytes_left);
        match read {
            Err(e) if e.kind() == ErrorKind::UnexpectedEof => self.cut_off = true,
            Err(e) => {
                return Err(TraceError::Damaged {
                    path: self.path.to_owned(),
                    line: self.number,
                    reason: e.to_string(),
                });
            }
            Ok(_) => {}
        }
        if self.line.last() == Some(&b'\n') {
            self.number += 1;
            return Ok(Some(&self.line));
        }
        if self.line.len() as u64 == most {
            return Err(TraceError::TooLong {
                path: self.path.to_owned(),
                line: self.number + 1,
                limit: most.max(self.limit.min(MAX_LINE_BYTES)),
            });
        }
        self.cut_off |= !self.line.is_empty();
        Ok(None)
    }

    fn problem(&self, problem: String) -> TraceError {
        TraceError::Line {
            path: self.path.to_owned(),
            line: self.number,
            problem,
        }
    }
}
