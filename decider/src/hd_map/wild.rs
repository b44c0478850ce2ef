//! Whatever numbers a map, a route or a question holds, the answer comes, and nothing panics.

use super::testing::{connect, lane};
use super::{HdMap, LaneSegment, LaneWaypoint, MapData, ObjectKind, Path, PathQuirks};
use crate::geometry::{ConvexPolygon, Pose, Vec2};
use crate::lane_follow_map::{
    LaneFollowConfig, LaneFollowMap, LaneFollowQuirks, RouteSegments, VehicleState,
};
use crate::road::{LaneId, Neighbour, Side};
use crate::routing::{self, ChangeLaneType, RoutingResponse};
use proptest::prelude::*;
use std::hint::black_box;
use std::sync::Arc;

const NASTY: [f64; 12] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    1e300,
    -1e154,
    1e-300,
    -0.0,
    1e-8,
    2e-4,
    1e17,
    4e6,
    -3.5,
];

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![6 => -40.0..40.0, 1 => prop::sample::select(&NASTY[..])]
}

fn map_data() -> impl Strategy<Value = MapData> {
    let points = prop::collection::vec((number(), number()), 1..5);
    let lanes = prop::collection::vec((points, prop::collection::vec((number(), number()), 0..3)), 1..4);
    let links = prop::collection::vec((0usize..4, 0usize..4), 0..5);
    (lanes, links).prop_map(|(lanes, links)| {
        let mut data = MapData::default();
        for (k, (points, widths)) in lanes.into_iter().enumerate() {
            let mut made = lane(&k.to_string(), &points);
            made.left_samples.extend(widths);
            data.lanes.push(made);
        }
        for (from, to) in links {
            if from.max(to) < data.lanes.len() {
                connect(&mut data, &from.to_string(), &to.to_string());
            }
        }
        data
    })
}

fn route(parts: &[(usize, f64, f64)]) -> RoutingResponse {
    let segment = |(lane, start_s, end_s): &(usize, f64, f64)| routing::LaneSegment {
        lane: lane.to_string(),
        start_s: *start_s,
        end_s: *end_s,
    };
    let waypoint = |(lane, start_s, _): &(usize, f64, f64)| routing::LaneWaypoint {
        lane: Some(lane.to_string()),
        s: Some(*start_s),
        ..routing::LaneWaypoint::default()
    };
    let passage = routing::Passage {
        segments: parts.iter().map(segment).collect(),
        can_exit: false,
        change_lane_type: ChangeLaneType::Left,
    };
    let road = routing::RoadSegment {
        id: String::new(),
        passages: vec![passage.clone(), passage],
    };
    RoutingResponse {
        roads: vec![road],
        waypoints: parts.iter().map(waypoint).collect(),
    }
}

fn ask_map(map: &HdMap, at: Vec2, s: f64) {
    map.nearest_lane(at);
    map.nearest_lane_with_heading(at, s, s, 1.0);
    map.roads_within(at, s);
    for kind in ObjectKind::ALL {
        map.objects_within(kind, at, s);
    }
    for lane in map.lanes() {
        black_box((
            lane.heading_at(s),
            lane.curvature_at(s),
            lane.width_at(s),
            lane.contains(at),
        ));
        black_box((lane.boundary_type_at(Side::Left, s), lane.point_at(s)));
    }
}

fn ask_line(line: &Path, at: Vec2, s: f64, t: f64) {
    black_box((
        line.project_between(at, s, t),
        line.nearest(at),
        line.chord_point(at),
        line.heading_along(at),
    ));
    black_box((
        line.lane_width_at(s),
        line.road_width_at(s),
        line.speed_limit_at(s),
        line.road_kind_at(s),
    ));
    black_box((
        line.nearest_point(s),
        line.locate_lane(s),
        line.lane_segments_between(s, t),
        line.boundary_types_at(s),
    ));
    let _ = line.segment(s, t, t);
    for kind in Neighbour::ALL {
        line.neighbour_at(kind, s);
    }
    let body = ConvexPolygon::rectangle(Pose::new(at.x, at.y, t), 2.0, 2.0, 1.0);
    black_box((
        line.has_overlap(&body),
        line.is_blocked_by(&body, s),
        line.driving_width(&line.sl_box(&body)),
    ));
}

fn ask_segments(map: &HdMap, lanes: &[LaneSegment], at: Vec2, s: f64, t: f64) {
    let mut segments = RouteSegments::from(lanes.to_vec());
    segments.project(map, at);
    segments.can_drive_from(map, &LaneWaypoint::on(LaneId(0), s));
    let other = RouteSegments::from(vec![LaneSegment::new(LaneId(0), s, t)]);
    segments.stitch(&other);
    segments.is_connected(&other);
    segments.shrink(s, t, t);
}

proptest! {
    #[test]
    fn every_question_has_an_answer(
        data in map_data(),
        parts in prop::collection::vec((0usize..4, number(), number()), 0..4),
        places in prop::collection::vec((number(), number(), number(), number()), 1..4),
        apollo in any::<bool>(),
    ) {
        let Ok(map) = HdMap::new(data).map(Arc::new) else { return Ok(()) };
        let known = parts.iter().filter(|(lane, ..)| *lane < map.lanes().len());
        let lanes: Vec<LaneSegment> = known
            .map(|(lane, from, to)| LaneSegment::new(map.find(&lane.to_string()).unwrap(), *from, *to))
            .collect();
        let quirks = if apollo { PathQuirks::apollo() } else { PathQuirks::default() };
        let line = Path::along(&map, &lanes, quirks);
        let quirks = if apollo { LaneFollowQuirks::apollo() } else { LaneFollowQuirks::default() };
        let mut follow = LaneFollowMap::new(Arc::clone(&map), LaneFollowConfig { quirks, ..LaneFollowConfig::default() });
        let _ = follow.update_route(route(&parts));
        for (x, y, s, t) in places {
            let at = Vec2::new(x, y);
            ask_map(&map, at, s);
            ask_segments(&map, &lanes, at, s, t);
            if let Ok(line) = &line {
                ask_line(line, at, s, t);
            }
            let _ = follow.route_segments_within(&VehicleState { position: at, heading: t, speed: s }, s, t);
            let _ = follow.route_segments(&VehicleState { position: at, heading: 0.1, speed: 3.0 });
            follow.extend(&RouteSegments::from(lanes.clone()), s, t);
        }
    }
}
