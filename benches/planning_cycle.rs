//! How long does one whole planning cycle take, every task of the stage, on a busy street: 20 obstacles, 8 of them
//! moving with predictions of 8 s? Once as it comes in a drive, with what the optimisers know of the tick before, and once
//! as the first tick of all. A regression guard, not a marketing number.

use corridor_decider::config::Config;
use corridor_decider::context::Context;
use corridor_decider::decision::Outcome;
use corridor_decider::frame::{Frame, Obstacle, ObstacleId, ObstacleKind, PredictedPose};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2, angle};
use corridor_decider::planner::Planner;
use corridor_decider::reference_line::{LineQuery, SlPoint};
use corridor_scenarios::{MapCache, catalog};
use corridor_sim::closed_loop::Sink;
use corridor_sim::run;
use corridor_sim::settings::Settings;
use corridor_sim::trace::{TickRecord, TraceError};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

/// The tick that is measured: the ego drives, its way past what stands is under way.
const TICK: usize = 30;

#[derive(Default)]
struct Frames(Vec<Frame>);

impl Sink for Frames {
    fn tick(&mut self, tick: &TickRecord) -> Result<(), TraceError> {
        self.0.push(tick.frame.clone());
        Ok(())
    }
}

/// A body on the line's left, standing or driving along the line.
fn body(frame: &Frame, id: u32, at: SlPoint, speed: f64) -> Obstacle {
    let line = &frame.lines[0].line;
    let pose_at = |s: f64| {
        let place = line.to_cartesian(SlPoint { s, l: at.l });
        let along = line.point(s).theta;
        let theta = if speed < 0.0 {
            angle::wrap(along + std::f64::consts::PI)
        } else {
            along
        };
        Pose::new(place.x, place.y, theta)
    };
    let pose = pose_at(at.s);
    let is_static = speed.abs() < 0.01;
    let steps = if is_static { 0 } else { 80 };
    Obstacle {
        id: ObstacleId(1000 + id),
        kind: ObstacleKind::Car,
        pose,
        shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 2.3, 2.3, 0.9),
        velocity: Vec2::new(
            line.point(at.s).theta.cos() * speed,
            line.point(at.s).theta.sin() * speed,
        ),
        is_static,
        prediction: (0..=steps)
            .filter(|_| !is_static)
            .map(|k| {
                let t = f64::from(k) * 0.1;
                PredictedPose {
                    t,
                    pose: pose_at(at.s + speed * t),
                }
            })
            .collect(),
    }
}

/// The frame with so many obstacles more that there are 20, of which 8 move: oncoming, ahead and behind.
fn crowded(frame: &Frame) -> Frame {
    let mut frame = frame.clone();
    let line = &frame.lines[0].line;
    let ego = line.to_frenet(frame.ego.pose.position());
    let moving = frame
        .obstacles
        .iter()
        .filter(|obstacle| !obstacle.is_static)
        .count();
    let mut more = Vec::new();
    for k in 0..8_usize.saturating_sub(moving) {
        let (s, l, speed) = match k {
            0 => (ego.s + 40.0, 0.0, 7.0),
            1 => (ego.s - 20.0, 0.0, 6.0),
            _ => (ego.s + 15.0 + 18.0 * k as f64, 3.6, -8.0),
        };
        more.push((s, l, speed));
    }
    let standing = frame.obstacles.len() - moving;
    for k in 0..12_usize.saturating_sub(standing) {
        more.push((ego.s + 10.0 + 7.0 * k as f64, -3.4, 0.0));
    }
    for (k, (s, l, speed)) in more.into_iter().enumerate() {
        let id = u32::try_from(k).expect("a few obstacles");
        let obstacle = body(&frame, id, SlPoint { s, l }, speed);
        frame.obstacles.push(obstacle);
    }
    assert_eq!(frame.obstacles.len(), 20, "20 obstacles");
    assert_eq!(
        frame
            .obstacles
            .iter()
            .filter(|obstacle| !obstacle.is_static)
            .count(),
        8,
        "8 of them move"
    );
    frame
}

fn cycle(c: &mut Criterion) {
    let entry = catalog::find("nudge_several").expect("the catalog has it");
    let family = entry.load(&MapCache::new()).expect("the catalog can be read");
    let scenario = family.draw(1).expect("seed 1 can be drawn").scenario;
    let mut frames = Frames::default();
    run::run_into(&scenario, &Settings::default(), &mut frames).expect("frames are kept in memory");
    let frames: Vec<Frame> = frames.0[..=TICK].iter().map(crowded).collect();
    let planner = Planner::new(Config::default(), scenario.vehicle);
    let mut context = Context::default();
    for frame in &frames[..TICK] {
        planner.decide(frame, &mut context);
    }
    // A fallback would be faster: nobody may measure that by mistake.
    let decision = planner.decide(&frames[TICK], &mut context.clone());
    assert_eq!(decision.outcome, Outcome::Normal, "{:?}", decision.tasks);
    let mut group = c.benchmark_group("planning_cycle");
    group.bench_function("in a drive", |b| {
        b.iter_batched_ref(
            || context.clone(),
            |context| black_box(planner.decide(&frames[TICK], context)),
            criterion::BatchSize::SmallInput,
        );
    });
    group.bench_function("first tick", |b| {
        b.iter_batched_ref(
            Context::default,
            |context| black_box(planner.decide(&frames[TICK], context)),
            criterion::BatchSize::SmallInput,
        );
    });
    group.finish();
}

criterion_group!(benches, cycle);
criterion_main!(benches);
