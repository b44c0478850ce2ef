//! `corridor replay`, `corridor explain` and `corridor view`: what can be done with a trace.

use super::{Gate, output};
use anyhow::Context;
use clap::Args;
use corridor_sim::replay::{self, Replayed};
use corridor_sim::trace::Trace;
use corridor_sim::{explain, view};
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Replay {
    /// The trace.
    trace: PathBuf,
}

impl Replay {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        let trace = Trace::open(&self.trace)?;
        let replayed = replay::replay(&trace).with_context(|| format!("`{}`", self.trace.display()))?;
        output::print(&format!("{replayed}\n"));
        Ok(if matches!(replayed, Replayed::Same { .. }) {
            Gate::Passed
        } else {
            Gate::Failed
        })
    }
}

#[derive(Args)]
pub(crate) struct Explain {
    /// The trace.
    trace: PathBuf,
    /// Which moment, seconds since the start of the run.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    at: f64,
}

impl Explain {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        let trace = Trace::open(&self.trace)?;
        let name = self.trace.display();
        let last = trace
            .ticks
            .last()
            .with_context(|| format!("`{name}` holds no tick: the run was ended before its first one"))?;
        let end = last.frame.time + trace.header.tick;
        anyhow::ensure!(
            (0.0..=end).contains(&self.at),
            "`--at {}`: `{name}` goes from 0 to {end:.1} s",
            self.at
        );
        output::print(&explain::tick(&trace, self.at));
        Ok(Gate::Passed)
    }
}

#[derive(Args)]
pub(crate) struct View {
    /// The trace.
    trace: PathBuf,
    /// The page to write; the trace's name with `.html` unless given.
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl View {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        let trace = Trace::open(&self.trace)?;
        let path = self
            .output
            .clone()
            .unwrap_or_else(|| self.trace.with_extension("html"));
        output::write(&path, &view::page(&trace))?;
        output::print(&format!("{}\n", path.display()));
        Ok(Gate::Passed)
    }
}
