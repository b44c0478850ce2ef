//! What one input may cost: memory by the size of the file, work by what the machine counted for this thread.
//!
//! Memory is the growth of the process's peak (`VmHWM`), which Linux sets back on request; elsewhere it is not
//! checked. Work is the time that this thread was on a processor, which other load does not lengthen as it does
//! the time on a wall; the limit is far above what any input takes and below what anyone would call a hang.

use crate::setting;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Most memory that any input may take, bytes: 5 million cross-sections, up to which importers go, with the index
/// over them. The smallest file may ask for that many: a road of 100 km is one line.
const MEMORY: u64 = 2 << 30;

/// Memory for every byte of a file beyond that: trees of XML and text take some dozens.
const MEMORY_PER_BYTE: u64 = 200;

/// Most time on a processor, unoptimised, s.
const WORK: u64 = 30;

/// What the machine counted before an input.
pub(crate) struct Meter {
    memory: Option<u64>,
    work: Option<Duration>,
    /// Where the machine counts the time of the thread that this was started on.
    counted: Option<PathBuf>,
    /// Most time on a processor.
    allowed: Duration,
}

impl Meter {
    pub(crate) fn start() -> Self {
        // 5: sets the peak back to what is in use.
        let is_reset = fs::write("/proc/self/clear_refs", "5").is_ok();
        let thread = fs::read_link("/proc/thread-self").ok();
        let counted = thread.map(|thread| Path::new("/proc").join(thread).join("schedstat"));
        Self {
            memory: is_reset.then(peak).flatten(),
            work: counted.as_deref().and_then(on_processor),
            counted,
            allowed: Duration::from_secs(setting("CORRIDOR_FUZZ_SECONDS", WORK)),
        }
    }

    /// Memory in bytes and time since the start, as far as they are counted here.
    pub(crate) fn read(&self) -> (u64, Duration) {
        let memory = self.memory.zip(peak()).map(|(from, to)| to.saturating_sub(from));
        let work = self
            .work
            .zip(self.counted.as_deref().and_then(on_processor))
            .map(|(from, to)| to.saturating_sub(from));
        (memory.unwrap_or_default(), work.unwrap_or_default())
    }

    /// What an input of some length cost too much, in words.
    pub(crate) fn excess(&self, length: usize) -> Option<String> {
        let (memory, work) = self.read();
        let allowed = MEMORY + MEMORY_PER_BYTE * length as u64;
        if memory > allowed {
            return Some(format!("took {memory} bytes of memory, {allowed} are allowed"));
        }
        let allowed = self.allowed;
        (work > allowed).then(|| format!("took {work:?} of processor, {allowed:?} are allowed"))
    }
}

/// Most bytes this process had in memory.
fn peak() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix(" kB")?.trim().parse().ok()?;
    Some(kilobytes << 10)
}

/// How long a thread was on a processor.
fn on_processor(counted: &Path) -> Option<Duration> {
    let counted = fs::read_to_string(counted).ok()?;
    let nanoseconds = counted.split_whitespace().next()?.parse().ok()?;
    Some(Duration::from_nanos(nanoseconds))
}
