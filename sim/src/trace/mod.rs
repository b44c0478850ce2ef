//! Traces: what happened in one run, tick by tick.
//!
//! A trace is one file of JSON lines in one zstd frame: a [`Header`], one [`TickRecord`] per planning tick, and a
//! [`Verdict`](crate::verdict::Verdict). `zstd -dc run.trace | jq` reads it too. It is written as the run goes, so a
//! run that was killed leaves everything up to about its last second.
//!
//! What the decider saw is kept exactly, so that any tick can be decided again alone; what it decided is kept
//! to a tenth of a millimetre. The lines of a frame stand once in the header.

mod check;
mod error;
mod exact;
pub(crate) mod outline;
mod reader;
mod record;
mod rounded;
#[cfg(test)]
pub(crate) mod synthetic;
#[cfg(test)]
mod tests;
mod writer;

pub use error::TraceError;
pub use reader::Trace;
pub use record::{Controls, Event, EventKind, Header, LaneOutline, Record, TickRecord};
pub use writer::TraceWriter;

/// Version of the layout that this program writes, and the only one it reads.
pub const FORMAT: u32 = 3;
