//! One run from a family and a seed, with or without a trace.

use crate::closed_loop::{ClosedLoop, NoSink, Sink};
use crate::faults::Planted;
use crate::route::Route;
use crate::settings::Settings;
use crate::trace::{FORMAT, Header, TickRecord, Trace, TraceError, TraceWriter, outline};
use crate::verdict::Verdict;
use corridor_scenarios::{Family, Scenario};
use std::path::Path;

/// Runs a scenario without keeping anything but the verdict.
pub fn run(scenario: &Scenario, settings: &Settings) -> Verdict {
    let Ok(verdict) = ClosedLoop::new(scenario, settings).run(&mut NoSink) else {
        unreachable!("keeping nothing cannot fail");
    };
    verdict
}

/// Runs a scenario and hands every tick to `sink`.
///
/// # Errors
/// [`TraceError`] of the sink.
pub fn run_into(
    scenario: &Scenario,
    settings: &Settings,
    sink: &mut dyn Sink,
) -> Result<Verdict, TraceError> {
    ClosedLoop::new(scenario, settings).run(sink)
}

/// Runs a scenario and writes its trace to `path` as it goes.
///
/// # Errors
/// [`TraceError`] when the file cannot be written.
pub fn run_traced(
    family: &Family,
    scenario: &Scenario,
    overrides: &[String],
    settings: &Settings,
    path: &Path,
) -> Result<Verdict, TraceError> {
    let mut sink = TraceSink(TraceWriter::create(
        path,
        &header(family, scenario, overrides, settings),
    )?);
    let verdict = run_into(scenario, settings, &mut sink)?;
    sink.0.finish(&verdict)?;
    Ok(verdict)
}

/// Runs a scenario and keeps its trace in memory, as it would be read back but for the writer's rounding.
pub fn run_recorded(
    family: &Family,
    scenario: &Scenario,
    overrides: &[String],
    settings: &Settings,
) -> Trace {
    let mut ticks = Recorder(Vec::new());
    let Ok(verdict) = run_into(scenario, settings, &mut ticks) else {
        unreachable!("keeping in memory cannot fail");
    };
    let mut header = header(family, scenario, overrides, settings);
    for tick in &mut ticks.0 {
        header.lines.append(&mut tick.new_lines);
    }
    Trace {
        header,
        ticks: ticks.0,
        verdict: Some(verdict),
        truncated: false,
    }
}

struct Recorder(Vec<TickRecord>);

impl Sink for Recorder {
    fn tick(&mut self, tick: &TickRecord) -> Result<(), TraceError> {
        self.0.push(tick.clone());
        Ok(())
    }
}

struct TraceSink(TraceWriter);

impl Sink for TraceSink {
    fn tick(&mut self, tick: &TickRecord) -> Result<(), TraceError> {
        self.0.tick(tick)
    }
}

/// What a trace says of the run before its first tick.
pub fn header(family: &Family, scenario: &Scenario, overrides: &[String], settings: &Settings) -> Header {
    let driven: Vec<_> = [&scenario.line]
        .into_iter()
        .chain(&scenario.target_line)
        .cloned()
        .collect();
    let planted = Planted::new(settings.fault);
    let config = planted.config(&settings.decider);
    Header {
        format: FORMAT,
        build: env!("CARGO_PKG_VERSION").to_owned(),
        scenario: scenario.name.clone(),
        source: family.source().to_string(),
        map: family.map_text().to_string(),
        seed: scenario.seed,
        overrides: overrides.to_vec(),
        vehicle: scenario.vehicle,
        obstacle_names: scenario
            .obstacles
            .iter()
            .map(|obstacle| obstacle.name.clone())
            .collect(),
        lanes: outline::near(scenario.map.lanes(), &driven),
        lines: Route::new(scenario, &config.lane_follow).first_lines().to_vec(),
        tick: settings.tick,
    }
}
