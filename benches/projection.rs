//! How long does it take to find a point's place in the Frenet frame of a winding road of one kilometre? Points
//! in the lanes, where nearly all questions come from, and far beside the road. A regression guard, not a
//! marketing number.

mod roads;

use corridor_decider::geometry::Vec2;
use corridor_decider::reference_line::{LineQuery, ReferenceLine, SlPoint};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use roads::winding_road;
use std::hint::black_box;

/// Points per measured pass, spread over the road.
const POINTS: u32 = 97;

const LENGTH: f64 = 1000.0;

/// Points beside the road, to both sides in turn, no two at the same place between two cross-sections.
fn points(line: &ReferenceLine, l: f64) -> Vec<Vec2> {
    let point = |k: u32| {
        let s = LENGTH * (f64::from(k) + 0.371) / f64::from(POINTS);
        let l = if k.is_multiple_of(2) { l } else { -l };
        line.to_cartesian(SlPoint { s, l })
    };
    (0..POINTS).map(point).collect()
}

fn projection(c: &mut Criterion) {
    let line = winding_road(LENGTH);
    let mut group = c.benchmark_group("projection");
    group.throughput(Throughput::Elements(u64::from(POINTS)));
    for (name, l) in [("in_lane", 0.9), ("near", 5.0), ("far", 60.0)] {
        let points = points(&line, l);
        group.bench_function(format!("to_frenet/{name}"), |b| {
            b.iter(|| {
                points
                    .iter()
                    .map(|p| black_box(&line).to_frenet(*p).l)
                    .sum::<f64>()
            });
        });
        // From where a car of 12 m/s was a planning period ago.
        let hinted: Vec<(Vec2, f64)> = points.iter().map(|p| (*p, line.to_frenet(*p).s - 1.2)).collect();
        group.bench_function(format!("to_frenet_near/{name}"), |b| {
            b.iter(|| {
                hinted
                    .iter()
                    .map(|(p, s)| black_box(&line).to_frenet_near(*p, *s).l)
                    .sum::<f64>()
            });
        });
    }
    group.bench_function("point", |b| {
        let stations = (0..POINTS).map(|k| LENGTH * f64::from(k) / f64::from(POINTS));
        let stations: Vec<f64> = stations.collect();
        b.iter(|| stations.iter().map(|s| black_box(&line).point(*s).x).sum::<f64>());
    });
    group.finish();
}

criterion_group!(benches, projection);
criterion_main!(benches);
