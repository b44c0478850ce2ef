//! Traces: what happened in one run, tick by tick.

mod record;

pub use record::{Controls, Event, EventKind, Header, LaneOutline, Record, TickRecord};
