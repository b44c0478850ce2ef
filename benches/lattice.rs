//! How long does a planning cycle of the lattice planner take: the set-up alone, until the best trajectory is found, and
//! where every one of at least eight hundred is combined, costed and checked? A regression guard, not a marketing number.
//!
//! Twenty predicted obstacles drive in two of three lanes of a winding road, half as fast as the car, one of them cuts in.
//! Three quarters of them are in the car's own lane or reach into it, close together, so that many curves that keep their
//! limits end behind and before one. Nobody meets such traffic: it is made to give the number of pairs.

use corridor_decider::frame::{Obstacle, ObstacleId, ObstacleKind, PredictedPose};
use corridor_decider::geometry::frenet::FrenetMotion;
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2};
use corridor_decider::lattice::{Lattice, LatticeConfig, LineTable, LineTask, PlanningTarget, projection};
use corridor_decider::reference_line::{LineQuery, ReferenceLine, SlPoint};
use corridor_decider::vehicle::VehicleParams;
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

#[path = "roads.rs"]
#[allow(dead_code, reason = "shared with other benchmarks")]
mod roads;

/// Where the car is, m, and how fast, m/s.
const S: f64 = 40.0;
const V: f64 = 10.0;

/// Trajectories without which the measurement says little.
const LEAST: usize = 800;

/// An obstacle that drives along the line, and across it at `drift`.
fn moving(line: &ReferenceLine, id: u32, at: SlPoint, speed: f64, drift: f64) -> Obstacle {
    let pose = |t: f64| {
        let s = at.s + speed * t;
        let place = line.to_cartesian(SlPoint {
            s,
            l: at.l + drift * t,
        });
        Pose::new(place.x, place.y, line.point(s).theta)
    };
    let predicted = |k: u32| {
        let t = 0.1 * f64::from(k);
        PredictedPose { t, pose: pose(t) }
    };
    Obstacle {
        id: ObstacleId(id),
        kind: ObstacleKind::Car,
        pose: pose(0.0),
        shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 2.25, 2.25, 0.9),
        velocity: Vec2::new(speed, drift),
        is_static: false,
        prediction: (0..=80).map(predicted).collect(),
    }
}

fn traffic(line: &ReferenceLine) -> Vec<Obstacle> {
    let car = |k: u32| {
        let place = f64::from(k);
        let (ahead, l) = [(60.0, 1.2), (25.0, -3.6), (60.0, 0.2), (60.0, -1.4)][(k % 4) as usize];
        let at = SlPoint {
            s: ahead + 4.0 * place,
            l,
        };
        let drift = if k == 13 { 0.4 } else { 0.0 };
        moving(line, k, at, 5.0 + 0.1 * place, drift)
    };
    (0..20).map(car).collect()
}

fn with_lattice<T>(line: &ReferenceLine, obstacles: &[Obstacle], then: impl FnOnce(&Lattice) -> T) -> T {
    let (vehicle, config) = (VehicleParams::default(), LatticeConfig::default());
    let table = LineTable::sampled(line, S - 10.0, S + 200.0).expect("the line is long enough");
    let lane_width = |s| line.lane_width(s);
    let project = projection(line);
    then(&Lattice::new(LineTask {
        line: &table,
        initial: FrenetMotion {
            s: [S, V, 0.0],
            l: [0.2, 0.01, 0.0],
        },
        obstacles,
        target: PlanningTarget {
            cruise_speed: 14.0,
            stop_s: Some(line.length()),
        },
        vehicle: &vehicle,
        config: &config,
        lane_width: &lane_width,
        project: &project,
    }))
}

#[expect(
    clippy::redundant_closure_for_method_calls,
    reason = "the method has one lifetime too many for it"
)]
fn lattice(c: &mut Criterion) {
    let line = roads::winding_road(400.0);
    let obstacles = traffic(&line);
    let survey = with_lattice(&line, &obstacles, |lattice| lattice.assessed());
    let free = survey.iter().filter(|(_, rejection)| rejection.is_none()).count();
    assert!(
        survey.len() >= LEAST && free > 0,
        "{} pairs, {free} of them free",
        survey.len()
    );
    let mut group = c.benchmark_group("lattice");
    group.bench_function("set_up", |b| {
        b.iter(|| {
            with_lattice(black_box(&line), black_box(&obstacles), |lattice| {
                lattice.graph.entries.len()
            })
        });
    });
    group.bench_function("best_of_all", |b| {
        b.iter(|| with_lattice(black_box(&line), black_box(&obstacles), |lattice| lattice.plan()));
    });
    group.bench_function(format!("every_one_of_{}_with_20_obstacles", survey.len()), |b| {
        b.iter(|| {
            with_lattice(black_box(&line), black_box(&obstacles), |lattice| {
                lattice.assessed().len()
            })
        });
    });
    group.finish();
}

criterion_group!(benches, lattice);
criterion_main!(benches);
