//! One run from a family and a seed, with or without a trace.

use crate::closed_loop::{ClosedLoop, NoSink, Sink};
use crate::route::Route;
use crate::settings::Settings;
use crate::trace::{FORMAT, Header, LaneOutline, TickRecord, Trace, TraceError, TraceWriter};
use crate::verdict::Verdict;
use corridor_decider::geometry::Vec2;
use corridor_decider::road::Lane;
use corridor_scenarios::{Family, Scenario};
use std::path::Path;

/// Cross-sections of a lane that are left out between two drawn ones: half a metre apart is finer than a page
/// shows.
const OUTLINE_STRIDE: usize = 4;

/// Runs a scenario without keeping anything but the verdict.
pub fn run(scenario: &Scenario, settings: &Settings) -> Verdict {
    ClosedLoop::new(scenario, settings)
        .run(&mut NoSink)
        .expect("keeping nothing cannot fail")
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
    let verdict = run_into(scenario, settings, &mut ticks).expect("keeping in memory cannot fail");
    Trace {
        header: header(family, scenario, overrides, settings),
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
        lines: Route::new(scenario).all_lines(),
        lanes: scenario.map.lanes().iter().map(outline).collect(),
        tick: settings.tick,
    }
}

fn outline(lane: &Lane) -> LaneOutline {
    let last = lane.points.len() - 1;
    let kept = (0..=last).filter(|k| k % OUTLINE_STRIDE == 0 || *k == last);
    let edges: Vec<(Vec2, Vec2)> = kept
        .map(|k| &lane.points[k])
        .map(|point| (point.offset(point.left), point.offset(-point.right)))
        .collect();
    let (left, right) = edges.into_iter().unzip();
    LaneOutline {
        name: lane.name.clone(),
        kind: lane.kind,
        left,
        right,
    }
}
