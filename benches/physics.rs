//! How long one physics step takes with everything that goes with it: overlap and clearance, the other road
//! users, the tracker. A guard against regressions: ten seconds of driving past 0, 10 and 50 obstacles.

use corridor_decider::decision::TrajectoryPoint;
use corridor_decider::frame::{Command, ObstacleId, ObstacleKind};
use corridor_decider::geometry::{ConvexPolygon, Pose, Vec2};
use corridor_decider::reference_line::ReferenceLine;
use corridor_decider::road::{Lane, LaneId, LaneKind, LanePoint, RoadMap};
use corridor_decider::vehicle::VehicleParams;
use corridor_scenarios::Scenario;
use corridor_scenarios::scenario::{
    AlongLine, Behaviour, EgoStart, Expectation, IdmParams, Obstacle, Trigger,
};
use corridor_sim::agents::Agents;
use corridor_sim::perception::{self, SENSOR_RANGE};
use corridor_sim::trace::Controls;
use corridor_sim::tracker::{Tracker, TrackerConfig};
use corridor_sim::world::{PhysicsConfig, World};
use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;

/// Steps per measured run, and steps per planning tick.
const STEPS: u32 = 1000;
const STEPS_PER_TICK: u32 = 10;
const SPEED: f64 = 12.0;

fn straight_road() -> Arc<RoadMap> {
    let point = |k: u32| LanePoint {
        s: f64::from(k) * 0.5,
        x: f64::from(k) * 0.5,
        y: 0.0,
        theta: 0.0,
        kappa: 0.0,
        left: 1.75,
        right: 1.75,
        road_left: 5.25,
        road_right: 4.0,
        speed_limit: 14.0,
    };
    let lane = Lane {
        name: "lane".to_owned(),
        kind: LaneKind::Driving,
        road: "road".to_owned(),
        junction: None,
        points: (0..=800).map(point).collect(),
        left_marks: Vec::new(),
        right_marks: Vec::new(),
        neighbours: [None; 4],
        predecessors: Vec::new(),
        successors: Vec::new(),
    };
    Arc::new(RoadMap::new(vec![lane], Vec::new()).expect("a straight lane is a map"))
}

/// Of five obstacles three are parked beside the lane, one drives in the next lane, and one follows another.
fn obstacle(id: u32, line: &Arc<ReferenceLine>) -> Obstacle {
    let s = 25.0 + 6.5 * f64::from(id);
    let along = |l, speed| AlongLine {
        line: Arc::clone(line),
        s,
        l,
        speed,
    };
    let behaviour = match id % 5 {
        3 => Behaviour::ConstantSpeed(along(3.5, 8.0)),
        4 => Behaviour::Idm {
            start: along(7.0, 8.0),
            params: IdmParams::default(),
            lane_change: None,
            mobil: None,
        },
        2 if id == 7 => Behaviour::Pedestrian {
            from: Vec2::new(s, -9.0),
            to: Vec2::new(s, -5.0),
            speed: 1.2,
            trigger: Trigger::Time(1.0),
        },
        _ => Behaviour::Parked(Pose::new(s, -3.2, 0.05)),
    };
    Obstacle {
        id: ObstacleId(id),
        name: format!("car {id}"),
        kind: ObstacleKind::Car,
        shape: ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), 2.3, 2.3, 0.95),
        behaviour,
    }
}

fn scenario(obstacles: u32) -> Scenario {
    let map = straight_road();
    let line = Arc::new(ReferenceLine::along(&map, &[LaneId(0)]).expect("one lane makes a line"));
    Scenario {
        name: "bench".to_owned(),
        description: String::new(),
        seed: 0,
        map,
        route: vec![LaneId(0)],
        provider: None,
        target_line: None,
        ego: EgoStart {
            pose: Pose::new(10.0, 0.0, 0.0),
            speed: SPEED,
        },
        command: Command::Cruise,
        command_time: 0.0,
        cruise_speed: SPEED,
        obstacles: (0..obstacles).map(|id| obstacle(id, &line)).collect(),
        line,
        vehicle: VehicleParams::default(),
        timeout: 60.0,
        expect: Expectation::Progress(100.0),
    }
}

fn straight_on(from: f64) -> Vec<TrajectoryPoint> {
    let point = |k: u32| {
        let t = f64::from(k) * 0.1;
        TrajectoryPoint {
            t,
            distance: SPEED * t,
            pose: Pose::new(from + SPEED * t, 0.0, 0.0),
            kappa: 0.0,
            v: SPEED,
            a: 0.0,
        }
    };
    (0..=80).map(point).collect()
}

fn physics(c: &mut Criterion) {
    let mut group = c.benchmark_group("step");
    group.throughput(Throughput::Elements(u64::from(STEPS)));
    for count in [0, 10, 50] {
        let scenario = scenario(count);
        let start = || {
            let world = World::new(&scenario, &PhysicsConfig::default());
            (world, Agents::new(&scenario))
        };
        let cruise = Controls::default();
        group.bench_function(format!("world/{count}"), |b| {
            let run = |(mut world, mut agents): (World, Agents)| {
                let moved = agents.advance(&world.ego(), world.dt()).to_vec();
                for _ in 0..STEPS {
                    world.step(cruise, &moved);
                    black_box(world.clearance());
                }
                world.state_hash()
            };
            b.iter_batched(start, run, BatchSize::LargeInput);
        });
        group.bench_function(format!("agents/{count}"), |b| {
            let run = |(world, mut agents): (World, Agents)| {
                for _ in 0..STEPS {
                    black_box(agents.advance(&world.ego(), world.dt()));
                }
            };
            b.iter_batched(start, run, BatchSize::LargeInput);
        });
        group.bench_function(format!("all/{count}"), |b| {
            let tracker = Tracker::new(scenario.vehicle, TrackerConfig::default());
            b.iter_batched(start, |state| drive(state, &tracker), BatchSize::LargeInput);
        });
    }
    group.finish();
}

/// The physics rate of the closed loop, and perception once per planning tick.
fn drive((mut world, mut agents): (World, Agents), tracker: &Tracker) -> u64 {
    let mut trajectory = Vec::new();
    for step in 0..STEPS {
        let since = f64::from(step % STEPS_PER_TICK) * world.dt();
        if step % STEPS_PER_TICK == 0 {
            black_box(perception::observe(&world, &agents, SENSOR_RANGE));
            trajectory = straight_on(world.ego().pose.x);
        }
        let ego = world.ego();
        let controls = tracker.track(&ego, &trajectory, since);
        world.step(controls, agents.advance(&ego, world.dt()));
        black_box(world.clearance());
    }
    world.state_hash()
}

criterion_group!(benches, physics);
criterion_main!(benches);
