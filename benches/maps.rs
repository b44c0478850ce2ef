//! What does a large real map cost: to read it, to find a way across it, and to follow that way tick by tick?
//! CARLA's Town07 of 1.7 MB, from the folder of real maps. A regression guard, not a marketing number.

use corridor_decider::hd_map::{HdMap, LaneSegment};
use corridor_decider::lane_follow_map::{LaneFollowConfig, LaneFollowMap, VehicleState};
use corridor_decider::reference_line::{LineProvider, StitchedLine};
use corridor_decider::road::{LaneId, RoadMap};
use corridor_decider::routing::{BlackList, LaneGraph, Position, RoutingConfig, RoutingResponse, WayPoint};
use corridor_decider::vehicle::VehicleParams;
use corridor_scenarios::import::opendrive;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The largest file there is.
const FILE: &str = "opendrive/carla_Town07_libOpenDRIVE_test.xodr";

/// Speed of the car, m/s, and its way in a planning period of 0.1 s, m.
const SPEED: f64 = 10.0;
const WAY_PER_TICK: f64 = 1.0;

/// Ticks of the drive along which lines are provided: six seconds, in which they begin and grow.
const DRIVEN: usize = 60;

/// Length of the stitched line before it grows, and of what it grows by, m: what the provider asks for.
const LINE: (f64, f64) = (200.0, 50.0);

/// The text of the map; `None`, said on the way, without the folder.
fn text() -> Option<String> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/maps");
    let folder = std::env::var_os("CORRIDOR_MAPS").map_or(beside, PathBuf::from);
    let text = std::fs::read_to_string(folder.join(FILE)).ok();
    if text.is_none() {
        eprintln!(
            "skipped: no `{FILE}` in `{}`, which CORRIDOR_MAPS names",
            folder.display()
        );
    }
    text
}

/// A map and the longest way through it that begins on its first lane.
struct Town {
    map: Arc<RoadMap>,
    hd_map: Arc<HdMap>,
    ends: [WayPoint; 2],
    route: RoutingResponse,
}

fn between(map: &RoadMap, from: LaneId, to: LaneId) -> [WayPoint; 2] {
    let at = |lane, s| WayPoint::OnLane(Position { lane, s });
    [at(from, 0.0), at(to, map.lane(to).length())]
}

fn town(text: &str) -> Town {
    let map = opendrive::read(text)
        .expect("a map that is read in the tests")
        .map;
    let graph = LaneGraph::new(&map, RoutingConfig::default());
    let drivable = (0..)
        .map(LaneId)
        .zip(map.lanes())
        .filter(|(_, lane)| lane.kind.is_drivable());
    let lanes: Vec<LaneId> = drivable.map(|(id, _)| id).collect();
    let ways = lanes.iter().filter_map(|to| {
        let ends = between(&map, lanes[0], *to);
        let route = graph.route(&map, &ends, &BlackList::default()).ok()?;
        Some((ends, route))
    });
    let (ends, route) = ways
        .max_by_key(|(_, route)| route.roads.len())
        .expect("lanes lead on");
    Town {
        hd_map: Arc::new(HdMap::of_roads(&map).expect("a map that is followed in the tests")),
        map: Arc::new(map),
        ends,
        route,
    }
}

impl Town {
    /// The stretches of lane of the way, the first passage of each road.
    fn chain(&self) -> Vec<LaneSegment> {
        let segments = self
            .route
            .roads
            .iter()
            .flat_map(|road| &road.passages[0].segments);
        let known =
            segments.map(|s| LaneSegment::new(self.map.find(&s.lane).expect("its lane"), s.start_s, s.end_s));
        known.collect()
    }

    /// The car tick by tick along the way, as long as it is on it.
    fn drive(&self) -> Vec<VehicleState> {
        let mut states = Vec::new();
        for stretch in self.chain() {
            let mut s = stretch.start_s;
            while s < stretch.end_s {
                let at = self.map.lane(stretch.lane).at(s);
                states.push(VehicleState {
                    position: at.offset(0.0),
                    heading: at.theta,
                    speed: SPEED,
                });
                s += WAY_PER_TICK;
            }
        }
        let mut follow = self.follow();
        let on_the_way = states
            .iter()
            .take_while(|state| follow.route_segments(state).is_ok())
            .count();
        states.truncate(on_the_way);
        states
    }

    fn follow(&self) -> LaneFollowMap {
        let mut follow = LaneFollowMap::new(Arc::clone(&self.hd_map), LaneFollowConfig::default());
        follow.update_route(self.route.clone()).expect("an own route");
        follow
    }

    fn provider(&self) -> LineProvider {
        let (map, hd_map) = (Arc::clone(&self.map), Arc::clone(&self.hd_map));
        LineProvider::new(map, hd_map, self.route.clone()).expect("an own route")
    }
}

/// The first `length` metres of a chain.
fn first(chain: &[LaneSegment], length: f64) -> Vec<LaneSegment> {
    let mut left = length;
    let mut cut = Vec::new();
    for stretch in chain {
        let end = stretch.end_s.min(stretch.start_s + left);
        cut.push(LaneSegment::new(stretch.lane, stretch.start_s, end));
        left -= stretch.length();
        if left <= 0.0 {
            break;
        }
    }
    cut
}

fn follow(c: &mut Criterion, town: &Town) {
    let drive = town.drive();
    assert!(drive.len() >= DRIVEN, "the way ends after {} ticks", drive.len());
    let mut group = c.benchmark_group("town07");
    group.throughput(Throughput::Elements(drive.len() as u64));
    group.bench_function("route_segments", |b| {
        b.iter_batched_ref(
            || town.follow(),
            |follow| {
                drive
                    .iter()
                    .filter(|state| black_box(follow.route_segments(state)).is_ok())
                    .count()
            },
            criterion::BatchSize::SmallInput,
        );
    });
    let start = &drive[..DRIVEN];
    group
        .sample_size(10)
        .throughput(Throughput::Elements(DRIVEN as u64));
    group.bench_function("provider_lines", |b| {
        b.iter_batched_ref(
            || town.provider(),
            |provider| {
                start
                    .iter()
                    .filter(|state| black_box(provider.lines(state)).is_ok())
                    .count()
            },
            criterion::BatchSize::SmallInput,
        );
    });
    group.finish();
}

fn grow(c: &mut Criterion, town: &Town) {
    let (chain, vehicle) = (town.chain(), VehicleParams::default());
    let (short, long) = (first(&chain, LINE.0), first(&chain, LINE.0 + LINE.1));
    let line = StitchedLine::new(&town.map, short.clone(), &vehicle).expect("a way of some length");
    let mut group = c.benchmark_group("town07");
    group.bench_function("stitched_line/new", |b| {
        b.iter(|| StitchedLine::new(black_box(&town.map), short.clone(), &vehicle));
    });
    group.bench_function("stitched_line/led_on", |b| {
        b.iter(|| line.led_on(black_box(&town.map), &long, &vehicle));
    });
    group.finish();
}

fn maps(c: &mut Criterion) {
    let Some(text) = text() else { return };
    let town = town(&text);
    let mut group = c.benchmark_group("town07");
    group.sample_size(10);
    group.bench_function("import", |b| b.iter(|| opendrive::read(black_box(&text))));
    group.bench_function("graph_and_route", |b| {
        b.iter(|| {
            let graph = LaneGraph::new(black_box(&town.map), RoutingConfig::default());
            graph.route(&town.map, &town.ends, &BlackList::default())
        });
    });
    group.finish();
    follow(c, &town);
    grow(c, &town);
}

criterion_group!(benches, maps);
criterion_main!(benches);
