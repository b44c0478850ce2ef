//! Everything that the page gets to draw.

use super::again::Again;
use super::intern::Pool;
use super::lane::{self, LaneData, MarkData};
use super::line::LineData;
use super::series::{self, Series};
use super::thin;
use super::tick::{self, Pools, TickData};
use crate::explain::words;
use crate::trace::Trace;
use crate::verdict::Verdict;
use corridor_decider::geometry::Vec2;
use serde::Serialize;
use serde_json::value::RawValue;

/// The data of a page.
#[derive(Serialize)]
pub(super) struct Page<'a> {
    scenario: &'a str,
    seed: String,
    build: &'a str,
    source: &'a str,
    overrides: &'a [String],
    truncated: bool,
    /// Planning period, s.
    tick: f64,
    /// All positions are metres from here.
    origin: [f64; 2],
    vehicle: Vehicle,
    /// Names of the obstacles.
    names: &'a [String],
    lanes: Vec<LaneData>,
    marks: Vec<MarkData>,
    lines: Vec<LineData>,
    ticks: Vec<TickData>,
    /// The ego after the last tick, `x, y, theta`.
    end: Option<[f64; 3]>,
    obstacles: Vec<Box<RawValue>>,
    tasks: Vec<Box<RawValue>>,
    curves: Vec<String>,
    /// The lattice planner's run; it has bundles instead of bounds.
    lattice: Option<LatticeRun>,
    labels: Vec<String>,
    texts: Vec<String>,
    series: Series,
    events: Vec<EventData<'a>>,
    verdict: &'a Option<Verdict>,
}

/// The ego's body around its rear axle, m.
#[derive(Serialize)]
struct Vehicle {
    front: f64,
    back: f64,
    half_width: f64,
    wheel_base: f64,
}

/// How far what was weighed is known.
#[derive(Serialize)]
struct LatticeRun {
    /// Place of the first tick that did not come out again as it was recorded.
    differs_from: Option<usize>,
}

#[derive(Serialize)]
struct EventData<'a> {
    t: f64,
    kind: &'static str,
    text: &'a str,
}

impl<'a> Page<'a> {
    pub(super) fn new(trace: &'a Trace) -> Self {
        let header = &trace.header;
        let origin = origin(trace);
        let mut pools = Pools::default();
        let mut again = Again::new(trace);
        let mut tick = |k: usize| {
            let survey = again.as_mut().and_then(|again| again.survey(k));
            TickData::new(trace, &trace.ticks[k], survey.as_ref(), origin, &mut pools)
        };
        let ticks = (0..trace.ticks.len()).map(&mut tick).collect();
        Self {
            scenario: &header.scenario,
            // As text: JavaScript would round it.
            seed: header.seed.to_string(),
            build: &header.build,
            source: &header.source,
            overrides: &header.overrides,
            truncated: trace.truncated,
            tick: header.tick,
            origin: [origin.x, origin.y],
            vehicle: Vehicle {
                front: header.vehicle.front_edge_to_center,
                back: header.vehicle.back_edge_to_center,
                half_width: header.vehicle.half_width(),
                wheel_base: header.vehicle.wheel_base,
            },
            names: &header.obstacle_names,
            lanes: header
                .lanes
                .iter()
                .map(|lane| LaneData::new(lane, origin))
                .collect(),
            marks: lane::marks(&header.lanes, origin),
            lines: header
                .lines
                .iter()
                .map(|line| LineData::new(line, origin))
                .collect(),
            ticks,
            end: (trace.ticks.last()).map(|tick| tick::pose(tick.ego.pose, origin)),
            obstacles: raw(pools.obstacles),
            tasks: raw(pools.tasks),
            curves: pools.curves.into_texts(),
            lattice: again.map(|again| LatticeRun {
                differs_from: again.differs_from(),
            }),
            labels: pools.labels.into_texts(),
            texts: pools.texts.into_texts(),
            series: Series::new(trace, &series::stations(trace)),
            events: events(trace),
            verdict: &trace.verdict,
        }
    }
}

/// What was written as JSON, as it was written.
fn raw(pool: Pool) -> Vec<Box<RawValue>> {
    let raw = |text| RawValue::from_string(text).expect("it was written as JSON");
    pool.into_texts().into_iter().map(raw).collect()
}

/// Where the ego starts, to the metre: digits before the point are as dear as those behind it.
fn origin(trace: &Trace) -> Vec2 {
    let start = trace.ticks.first().map(|tick| tick.frame.ego.pose.position());
    start.map_or(Vec2::new(0.0, 0.0), |p| Vec2::new(p.x.round(), p.y.round()))
}

fn events(trace: &Trace) -> Vec<EventData<'_>> {
    let all = trace.ticks.iter().flat_map(|tick| &tick.events);
    all.map(|event| EventData {
        t: thin::milli(event.time),
        kind: words::event(event.kind),
        text: &event.text,
    })
    .collect()
}
