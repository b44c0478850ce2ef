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
    #[arg(long, value_name = "SECONDS")]
    at: f64,
}

impl Explain {
    pub(crate) fn execute(&self) -> anyhow::Result<Gate> {
        anyhow::ensure!(
            self.at.is_finite(),
            "`--at {}`: a time in seconds is wanted",
            self.at
        );
        output::print(&explain::tick(&Trace::open(&self.trace)?, self.at));
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
