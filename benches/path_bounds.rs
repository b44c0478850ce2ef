//! How long does one call of the path-bounds decider take? Four candidates (fallback, own lane, both neighbours)
//! of 200 stations past 0, 10 and 50 static obstacles; once with the look-ups along the reference line and once
//! without them. A regression guard, not a marketing number.

mod roads;

use corridor_decider::reference_line::LineQuery;
use corridor_decider::tasks::path_bounds::{
    Borrow, EgoFrenet, Input, Memory, ObstacleSl, PathBounds, PathBoundsConfig, decide,
};
use corridor_decider::vehicle::VehicleParams;
use criterion::{Criterion, criterion_group, criterion_main};
use roads::{Surveyed, obstacles, winding_road};
use std::hint::black_box;

const EGO: EgoFrenet = EgoFrenet {
    s: 40.2,
    s_dot: 10.0,
    l: 0.0,
    l_dot: 0.0,
};

/// Hundred metres at half a metre.
const STATIONS: usize = 200;

fn call<L: LineQuery>(line: &L, obstacles: &[ObstacleSl], memory: &mut Memory) -> PathBounds {
    let (config, vehicle) = (PathBoundsConfig::default(), VehicleParams::default());
    let input = Input {
        ego: EGO,
        ego_end_s: EGO.s + vehicle.front_edge_to_center,
        obstacles,
        config: &config,
        vehicle: &vehicle,
        cruise_speed: 10.0,
        is_change_lane: false,
        path_reusable: false,
        borrow: &[Borrow::Left, Borrow::Right],
        destination: None,
    };
    decide(line, &input, memory).expect("the road is open")
}

/// A shorter answer would be a faster one: nobody may measure that by mistake.
fn assert_is_whole(answer: &PathBounds) {
    let lengths: Vec<usize> = answer.bounds.iter().map(|bound| bound.points.len()).collect();
    assert_eq!(lengths, [STATIONS; 4], "four whole bounds");
}

fn path_bounds(c: &mut Criterion) {
    let line = winding_road(400.0);
    let mut stations = Vec::new();
    line.sample(EGO.s, 0.5, EGO.s + 100.0, &mut stations);
    let surveyed = Surveyed { line, stations };
    let mut group = c.benchmark_group("path_bounds");
    for count in [0, 10, 50] {
        let obstacles = obstacles(count, EGO.s);
        let mut memory = Memory::default();
        let answer = call(&surveyed, &obstacles, &mut memory);
        assert_is_whole(&answer);
        // From the second tick on the sides of the one before are known.
        memory.passed.clone_from(&answer.passed[1]);
        assert_eq!(answer, call(&surveyed.line, &obstacles, &mut memory));
        group.bench_function(format!("with_look_ups/{count}"), |b| {
            b.iter(|| call(black_box(&surveyed.line), black_box(&obstacles), &mut memory));
        });
        group.bench_function(format!("decider_alone/{count}"), |b| {
            b.iter(|| call(black_box(&surveyed), black_box(&obstacles), &mut memory));
        });
    }
    group.finish();
}

criterion_group!(benches, path_bounds);
criterion_main!(benches);
