//! What is fuzzed: one target for each format, from bytes to everything that the program does with what came out.
//!
//! A target never looks at whether the input was read or refused; it gives back which, and how large the result is.
//! Whatever the bytes are, it must come to an end, without a panic, within the limits of `limits.rs`.

use corridor_decider::geometry::Vec2;
use corridor_decider::hd_map::HdMap;
use corridor_decider::lane_follow_map::{LaneFollowConfig, LaneFollowMap, VehicleState};
use corridor_decider::reference_line::{LineQuery, ReferenceLine};
use corridor_decider::road::{LaneId, RoadMap};
use corridor_decider::routing::{BlackList, LaneGraph, Position, RoutingConfig, WayPoint};
use corridor_scenarios::import::{apollo, commonroad, lanelet2, opendrive};
use corridor_scenarios::{Family, MapCache};
use corridor_sim::trace::Trace;
use corridor_sim::{explain, view};
use std::path::Path;
use std::sync::{Arc, LazyLock};

/// Maps that scenarios name, read once.
static MAPS: LazyLock<MapCache> = LazyLock::new(MapCache::new);

/// Lanes of a map that are asked and driven along: enough to meet every kind of lane in a small file.
const ASKED: usize = 12;

/// Cross-sections up to which a map is also searched for routes: larger ones take seconds, and nothing new happens.
const SMALL: usize = 50_000;

/// Length of the longest trace that is drawn as a page, ticks.
const DRAWN: usize = 40;

/// What became of an input: how many parts the result has, or that it was refused with a message.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Outcome {
    /// Cross-sections, ticks or whatever the result is made of.
    Read(usize),
    /// What the user gets to read.
    Refused(String),
}

/// A reader of one format, and what follows on it.
pub(crate) type Target = fn(&[u8]) -> Outcome;

/// Every target by name.
pub(crate) const TARGETS: [(&str, Target); 9] = [
    ("opendrive", open_drive),
    ("lanelet2", lanelet2),
    ("commonroad", common_road),
    ("apollo_binary", apollo_map),
    ("apollo_text", apollo_map),
    ("apollo_routing", apollo_routing),
    ("scenario", scenario),
    ("trace", trace),
    ("trace_lines", trace_lines),
];

fn outcome<T, E: ToString>(result: Result<T, E>, parts: impl FnOnce(T) -> usize) -> Outcome {
    match result {
        Ok(result) => Outcome::Read(parts(result)),
        Err(error) => Outcome::Refused(error.to_string()),
    }
}

fn open_drive(bytes: &[u8]) -> Outcome {
    let read = opendrive::read(&String::from_utf8_lossy(bytes));
    outcome(read, |read| asked(&read.map))
}

fn lanelet2(bytes: &[u8]) -> Outcome {
    let read = lanelet2::read(&String::from_utf8_lossy(bytes));
    outcome(read, |read| asked(&read.map))
}

/// The road, and the scene of every planning problem.
fn common_road(bytes: &[u8]) -> Outcome {
    let read = commonroad::read(&String::from_utf8_lossy(bytes));
    outcome(read, |read| {
        let problems = read.file.problems.iter().map(|problem| Some(problem.id));
        for problem in problems.chain([None]).take(ASKED) {
            let _ = read.scenario(problem).map_err(|error| error.to_string());
        }
        asked(&read.map)
    })
}

fn apollo_map(bytes: &[u8]) -> Outcome {
    let read = apollo::read_map(bytes).and_then(|data| Ok((apollo::to_road_map(&data)?.0, data)));
    outcome(read, |(map, data)| {
        if let Ok(map) = HdMap::new(data) {
            ask_hd_map(&map);
        }
        asked(&map)
    })
}

fn ask_hd_map(map: &HdMap) {
    for lane in map.lanes().iter().take(ASKED) {
        for s in [-1.0, 0.0, lane.length() / 2.0, f64::INFINITY, f64::NAN] {
            let point = lane.point_at(s);
            let _ = (lane.project(point), lane.heading_at(s));
        }
    }
}

/// A routing on the street that the corpus of routings is drawn for.
fn apollo_routing(bytes: &[u8]) -> Outcome {
    static STREET: LazyLock<Arc<HdMap>> = LazyLock::new(|| {
        let data = apollo::read_map(include_bytes!("corpus/street.apollo.txt"));
        Arc::new(HdMap::new(data.expect("an own map")).expect("an own map"))
    });
    let _ = apollo::read_routing_request(bytes).map_err(|error| error.to_string());
    outcome(apollo::read_routing(bytes), |route| {
        let mut follow = LaneFollowMap::new(Arc::clone(&STREET), LaneFollowConfig::default());
        let _ = follow
            .update_route(route.clone())
            .map_err(|error| error.to_string());
        for x in [0.0, 20.0, 55.0, 90.0] {
            let state = VehicleState {
                position: Vec2::new(x, 0.3),
                heading: 0.0,
                speed: 10.0,
            };
            let _ = follow.route_segments(&state).map_err(|error| error.to_string());
        }
        route.roads.len()
    })
}

/// A scenario file, and the scenarios of some seeds.
fn scenario(bytes: &[u8]) -> Outcome {
    // Every map that is named is there: what a file system holds is no matter of the format.
    let street = include_str!("../../scenarios/maps/urban_parking.xodr");
    let text = String::from_utf8_lossy(bytes);
    let maps = if text.contains('/') {
        &MapCache::holding(street).expect("an own map")
    } else {
        &*MAPS
    };
    let read = Family::parse_with(&text, "fuzz.toml", Path::new(""), maps);
    outcome(read, |family| {
        let draw = |seed: u64| family.draw(seed).map_err(|error| error.to_string());
        [0, 1, u64::MAX]
            .map(draw)
            .iter()
            .filter(|drawn| drawn.is_ok())
            .count()
    })
}

fn trace(bytes: &[u8]) -> Outcome {
    outcome(Trace::from_bytes(bytes, Path::new("fuzz.trace")), |trace| {
        told(&trace)
    })
}

/// The lines inside a trace: damage to compressed bytes never gets as far.
fn trace_lines(bytes: &[u8]) -> Outcome {
    let packed = zstd::encode_all(bytes, 1).expect("memory takes everything");
    trace(&packed)
}

/// Everything that is made of a trace. Its length in ticks.
fn told(trace: &Trace) -> usize {
    for tick in trace.ticks.iter().take(ASKED) {
        let _ = explain::tick(trace, tick.frame.time);
    }
    let _ = (explain::tick(trace, -1.0), trace.frame(0));
    if trace.ticks.len() <= DRAWN {
        let _ = view::page(trace);
    }
    trace.ticks.len()
}

/// Asks a map what the program asks of it. The number of its cross-sections.
fn asked(map: &RoadMap) -> usize {
    let size = map.lanes().iter().map(|lane| lane.points.len()).sum();
    for (id, lane) in (0..).map(LaneId).zip(map.lanes()).take(ASKED) {
        let middle = lane.at(lane.length() / 2.0);
        let point = middle.offset(0.4);
        let _ = (map.lanes_at(point), map.distance_off_road(point));
        let _ = map.nearest_lane(point, 10.0, middle.theta, 0.5);
        for next in lane.successors.iter().take(2) {
            if let Ok(line) = ReferenceLine::along(map, &[id, *next]) {
                let _ = (line.to_frenet(point), line.point(f64::NAN));
            }
        }
    }
    if size <= SMALL {
        find_a_way(map);
    }
    size
}

/// Routes from the first lane to the last ones, and a drive along each.
fn find_a_way(map: &RoadMap) {
    let graph = LaneGraph::new(map, RoutingConfig::default());
    let on = |lane: u32, s: f64| {
        WayPoint::OnLane(Position {
            lane: LaneId(lane),
            s,
        })
    };
    let drivable = (0_u32..)
        .zip(map.lanes())
        .filter(|(_, lane)| lane.kind.is_drivable());
    let lanes: Vec<u32> = drivable.map(|(id, _)| id).collect();
    let hd_map = HdMap::of_roads(map).map(Arc::new);
    for to in lanes.iter().rev().take(ASKED) {
        let end = map.lane(LaneId(*to)).length();
        let Ok(route) = graph.route(map, &[on(lanes[0], 0.0), on(*to, end)], &BlackList::default()) else {
            continue;
        };
        let Ok(hd_map) = &hd_map else { continue };
        let mut follow = LaneFollowMap::new(Arc::clone(hd_map), LaneFollowConfig::default());
        let _ = follow.update_route(route);
        let start = map.lane(LaneId(lanes[0])).at(1.0);
        let state = VehicleState {
            position: start.offset(0.0),
            heading: start.theta,
            speed: 10.0,
        };
        let _ = follow.route_segments(&state);
    }
}
