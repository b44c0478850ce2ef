//! How long does one planning tick take, one tick of the closed loop, and how many seconds are simulated in one
//! second? On scenarios of the catalog: an empty road, one of median cost, and one full of traffic. The throughput
//! of `planning` and `loop` counts ticks, that of `run` simulated seconds. A regression guard, not a marketing
//! number.

use corridor_decider::config::Config;
use corridor_decider::context::Context;
use corridor_decider::frame::Frame;
use corridor_decider::planner::Planner;
use corridor_scenarios::{MapCache, Scenario, catalog};
use corridor_sim::closed_loop::Sink;
use corridor_sim::run;
use corridor_sim::settings::Settings;
use corridor_sim::trace::{TickRecord, TraceError};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

/// Cheap, median and dear; each an urban or rural street of the catalog.
const SCENARIOS: [&str; 3] = ["empty_road", "nudge_several", "pull_over_gap_sweep"];

/// The planning tick that is measured: the ego drives and is beside or before the obstacles.
const TICK: usize = 60;

fn scenario(name: &str) -> Scenario {
    let entry = catalog::find(name).expect("the catalog has it");
    let family = entry.load(&MapCache::new()).expect("the catalog can be read");
    family.draw(1).expect("seed 1 can be drawn").scenario
}

#[derive(Default)]
struct Frames(Vec<Frame>);

impl Sink for Frames {
    fn tick(&mut self, tick: &TickRecord) -> Result<(), TraceError> {
        self.0.push(tick.frame.clone());
        Ok(())
    }
}

fn runs(c: &mut Criterion) {
    for name in SCENARIOS {
        let scenario = scenario(name);
        let settings = Settings::default();
        let mut frames = Frames::default();
        let verdict = run::run_into(&scenario, &settings, &mut frames).expect("frames are kept in memory");
        planning(c, name, &scenario, &frames.0);
        whole_run(c, name, &scenario, &settings, (frames.0.len(), verdict.duration));
    }
}

/// One call of the planner, in the middle of the run and with the memory that it has there.
fn planning(c: &mut Criterion, name: &str, scenario: &Scenario, frames: &[Frame]) {
    let planner = Planner::new(Config::default(), scenario.vehicle);
    let mut before = Context::default();
    for frame in &frames[..TICK] {
        planner.decide(frame, &mut before);
    }
    let mut group = c.benchmark_group("planning");
    group.throughput(Throughput::Elements(1));
    group.bench_function(name, |b| {
        b.iter_batched_ref(
            || before.clone(),
            |context| planner.decide(black_box(&frames[TICK]), context),
            criterion::BatchSize::SmallInput,
        );
    });
    group.finish();
}

/// The whole run, counted in ticks and in simulated seconds.
fn whole_run(
    c: &mut Criterion,
    name: &str,
    scenario: &Scenario,
    settings: &Settings,
    (ticks, duration): (usize, f64),
) {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "less than a hundred seconds"
    )]
    let seconds = duration.round() as u64;
    for (kind, count) in [("loop", ticks as u64), ("run", seconds)] {
        let mut group = c.benchmark_group(kind);
        group.throughput(Throughput::Elements(count));
        group.sample_size(20);
        group.bench_function(name, |b| b.iter(|| run::run(black_box(scenario), settings)));
        group.finish();
    }
}

criterion_group!(benches, runs);
criterion_main!(benches);
