//! Writes a trace while the run goes on.

use super::TraceError;
use super::exact::Exact;
use super::record::{Header, TickRecord};
use super::rounded::Rounded;
use crate::verdict::Verdict;
use corridor_decider::frame::{Command, EgoState, Frame, Obstacle};
use serde::Serialize;
use serde_json::Serializer;
use serde_json::ser::Formatter;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use zstd::stream::write::Encoder;

/// Effort of the compressor. Level 1 takes half the time of the usual 3 for a tenth more bytes.
const LEVEL: i32 = 1;

/// Simulated time after which what was written must be on its way to the disk, s.
const FLUSH_PERIOD: f64 = 1.0;

/// A trace being written. Without [`TraceWriter::finish`] the file stays readable, but counts as cut off.
pub struct TraceWriter {
    path: PathBuf,
    encoder: Encoder<'static, BufWriter<File>>,
    /// The line under construction; kept for its memory.
    line: Vec<u8>,
    ticks_per_flush: u32,
    ticks_since_flush: u32,
    finished: bool,
}

/// A frame without its lines: they stand in the header.
#[derive(Serialize)]
struct FrameWithoutLines<'a> {
    tick: u32,
    time: f64,
    ego: &'a EgoState,
    command: &'a Command,
    cruise_speed: f64,
    lines: [(); 0],
    obstacles: &'a [Obstacle],
}

impl<'a> FrameWithoutLines<'a> {
    fn new(frame: &'a Frame) -> Self {
        Self {
            tick: frame.tick,
            time: frame.time,
            ego: &frame.ego,
            command: &frame.command,
            cruise_speed: frame.cruise_speed,
            lines: [],
            obstacles: &frame.obstacles,
        }
    }
}

impl TraceWriter {
    /// Starts a trace at `path` with its header. A file that is there already is replaced.
    ///
    /// # Errors
    /// [`TraceError::Io`] when the file cannot be made or written.
    pub fn create(path: &Path, header: &Header) -> Result<Self, TraceError> {
        let io = |source| TraceError::Io {
            path: path.to_owned(),
            source,
        };
        let file = BufWriter::new(File::create(path).map_err(io)?);
        let mut encoder = Encoder::new(file, LEVEL).map_err(io)?;
        encoder.include_checksum(true).map_err(io)?;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "saturates, which is right: a period that is nonsense flushes after every tick or never"
        )]
        let ticks_per_flush = (FLUSH_PERIOD / header.tick).round() as u32;
        let mut writer = Self {
            path: path.to_owned(),
            encoder,
            line: Vec::new(),
            ticks_per_flush: ticks_per_flush.max(1),
            ticks_since_flush: 0,
            finished: false,
        };
        writer.line.extend_from_slice(b"{\"header\":");
        serde_json::to_writer(&mut writer.line, header).map_err(|e| io(e.into()))?;
        writer.end_line().and_then(|()| writer.flush()).map_err(io)?;
        Ok(writer)
    }

    /// Adds one tick. A tick that cannot be written leaves no part of itself in the file.
    ///
    /// # Errors
    /// [`TraceError::NotFinite`] when the frame, the controls or the ego hold a number that is none,
    /// [`TraceError::Io`] when the disk is full.
    pub fn tick(&mut self, record: &TickRecord) -> Result<(), TraceError> {
        self.line.clear();
        self.tick_line(record).map_err(|_| TraceError::NotFinite {
            tick: record.frame.tick,
        })?;
        self.end_line().map_err(|e| self.io(e))?;
        self.ticks_since_flush += 1;
        if self.ticks_since_flush >= self.ticks_per_flush {
            self.flush().map_err(|e| self.io(e))?;
        }
        Ok(())
    }

    /// Ends the trace with the verdict.
    ///
    /// # Errors
    /// [`TraceError::Io`] when the disk is full.
    pub fn finish(mut self, verdict: &Verdict) -> Result<(), TraceError> {
        self.finished = true;
        self.line.clear();
        self.line.extend_from_slice(b"{\"verdict\":");
        let written = serde_json::to_writer(&mut self.line, verdict).map_err(Into::into);
        written
            .and_then(|()| self.end_line())
            .and_then(|()| self.encoder.do_finish())
            .and_then(|()| self.encoder.get_mut().flush())
            .map_err(|e| self.io(e))
    }

    /// The line of a tick: what was seen and done exactly, what was decided rounded.
    fn tick_line(&mut self, record: &TickRecord) -> serde_json::Result<()> {
        let line = &mut self.line;
        line.extend_from_slice(b"{\"tick\":");
        field(line, "{\"frame\":", &FrameWithoutLines::new(&record.frame), Exact)?;
        field(line, ",\"lines\":", &record.lines, Exact)?;
        if !record.new_lines.is_empty() {
            line.extend_from_slice(b",\"new_lines\":");
            serde_json::to_writer(&mut *line, &record.new_lines)?;
        }
        field(line, ",\"decision\":", &record.decision, Rounded)?;
        field(line, ",\"controls\":", &record.controls, Exact)?;
        field(line, ",\"ego\":", &record.ego, Exact)?;
        field(line, ",\"hash\":", &record.hash, Exact)?;
        field(line, ",\"clearance\":", &record.clearance, Rounded)?;
        field(line, ",\"events\":", &record.events, Exact)?;
        line.push(b'}');
        Ok(())
    }

    /// Hands the finished record, without its last brace, to the compressor.
    fn end_line(&mut self) -> std::io::Result<()> {
        self.line.extend_from_slice(b"}\n");
        self.encoder.write_all(&self.line)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.ticks_since_flush = 0;
        self.encoder.flush()
    }

    fn io(&self, source: std::io::Error) -> TraceError {
        TraceError::Io {
            path: self.path.clone(),
            source,
        }
    }
}

impl Drop for TraceWriter {
    /// A run that ends early leaves all its ticks behind.
    fn drop(&mut self) {
        if !self.finished {
            // There is nobody left to tell when this fails.
            let _ = self.encoder.flush();
        }
    }
}

/// Adds `prefix` and `value` to `line`.
fn field<F: Formatter>(
    line: &mut Vec<u8>,
    prefix: &str,
    value: &impl Serialize,
    formatter: F,
) -> serde_json::Result<()> {
    line.extend_from_slice(prefix.as_bytes());
    value.serialize(&mut Serializer::with_formatter(line, formatter))
}
