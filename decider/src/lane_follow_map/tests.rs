//! Hand-made routes, and what must hold on them.

use super::*;
use crate::geometry::Vec2;
use crate::hd_map::testing::{adjoin, connect, lane, map, segment, two_lanes};
use crate::hd_map::{HdMap, LaneWaypoint, MapData};
use crate::routing::{self, ChangeLaneType, RoutingResponse};
use std::sync::Arc;

fn passage(lanes: &[(&str, f64, f64)], change: ChangeLaneType) -> routing::Passage {
    let segment = |(lane, start_s, end_s): &(&str, f64, f64)| routing::LaneSegment {
        lane: (*lane).to_owned(),
        start_s: *start_s,
        end_s: *end_s,
    };
    routing::Passage {
        segments: lanes.iter().map(segment).collect(),
        can_exit: change == ChangeLaneType::Forward,
        change_lane_type: change,
    }
}

fn response(roads: Vec<Vec<routing::Passage>>, waypoints: &[(&str, f64)]) -> RoutingResponse {
    let road = |passages| routing::RoadSegment {
        id: String::new(),
        passages,
    };
    let waypoint = |(lane, s): &(&str, f64)| routing::LaneWaypoint {
        lane: Some((*lane).to_owned()),
        s: Some(*s),
        ..routing::LaneWaypoint::default()
    };
    RoutingResponse {
        roads: roads.into_iter().map(road).collect(),
        waypoints: waypoints.iter().map(waypoint).collect(),
    }
}

/// From `right` over to `left` and on.
fn change_to_the_left() -> RoutingResponse {
    let right = passage(&[("right", 0.0, 100.0)], ChangeLaneType::Left);
    let left = passage(&[("left", 0.0, 100.0)], ChangeLaneType::Forward);
    let on = passage(&[("left on", 0.0, 90.0)], ChangeLaneType::Forward);
    response(
        vec![vec![right, left], vec![on]],
        &[("right", 5.0), ("left on", 90.0)],
    )
}

/// Straight along `right`.
fn straight_on() -> RoutingResponse {
    let right = passage(
        &[("right", 0.0, 100.0), ("right on", 0.0, 90.0)],
        ChangeLaneType::Forward,
    );
    response(
        vec![vec![right]],
        &[("right", 5.0), ("right", 50.0), ("right on", 90.0)],
    )
}

fn car(x: f64, y: f64) -> VehicleState {
    VehicleState {
        position: Vec2::new(x, y),
        heading: 0.0,
        speed: 10.0,
    }
}

fn with_quirks(map: &Arc<HdMap>, route: RoutingResponse, quirks: LaneFollowQuirks) -> LaneFollowMap {
    let mut follow = LaneFollowMap::new(
        Arc::clone(map),
        LaneFollowConfig {
            quirks,
            ..LaneFollowConfig::default()
        },
    );
    follow.update_route(route).unwrap();
    follow
}

fn follow(route: RoutingResponse) -> LaneFollowMap {
    with_quirks(&map(two_lanes()), route, LaneFollowQuirks::default())
}

#[test]
fn both_passages_are_as_long_as_asked_and_tell_where_to_change() {
    let mut follow = follow(change_to_the_left());
    let found = follow.route_segments_within(&car(40.0, 0.2), 10.0, 30.0).unwrap();
    let [own, other] = &found[..] else {
        panic!("{found:?}")
    };
    assert!((own.length() - 40.0).abs() < 1e-4 && (other.length() - 40.0).abs() < 1e-4);
    assert!(own.is_on_segment && !other.is_on_segment);
    assert_eq!(
        (own.next_action, own.previous_action),
        (ChangeLaneType::Left, ChangeLaneType::Forward)
    );
    // The car is on the right of the other lane: it gets there by a change to the left.
    assert_eq!(
        (other.next_action, other.previous_action),
        (ChangeLaneType::Forward, ChangeLaneType::Left)
    );
    assert_eq!(
        (own.passage.to_string(), other.passage.to_string()),
        ("0_0".to_owned(), "0_1".to_owned())
    );
    assert_eq!((own.can_exit, other.can_exit), (false, true));
    assert!(
        own.route_end_waypoint.is_none(),
        "the lane ends beyond what was asked for"
    );
}

#[test]
fn a_waypoint_on_the_own_passage_is_passed_before_a_change() {
    let mut follow = follow(change_to_the_left());
    assert_eq!(
        follow.route_segments(&car(2.0, 0.0)).unwrap().len(),
        1,
        "the start is still ahead"
    );
    assert_eq!(follow.route_segments(&car(5.0, 0.0)).unwrap().len(), 2);
}

#[test]
fn a_car_beside_all_lanes_is_told_so() {
    let mut follow = LaneFollowMap::new(map(two_lanes()), LaneFollowConfig::default());
    assert_eq!(follow.update_vehicle(&car(0.0, 0.0)), Err(FollowError::NoRoute));
    follow.update_route(straight_on()).unwrap();
    let off = follow.update_vehicle(&car(-20.0, 0.0)).unwrap_err();
    assert_eq!(
        off.to_string(),
        "the car at (-20.0, 0.0) is beside no lane of the route"
    );
    assert_eq!(
        follow.update_vehicle(&car(f64::NAN, 0.0)),
        Err(FollowError::NotFinite)
    );
    let beyond = follow.update_vehicle(&car(195.0, 0.0)).unwrap_err();
    assert_eq!(
        beyond.to_string(),
        "the route does not use lane `right on` at 95.0 m, where the car is"
    );
    let none = follow
        .route_segments_within(&car(30.0, 0.0), -5.0, 5.0)
        .unwrap_err();
    assert_eq!(
        none,
        FollowError::NoStretch {
            back: -5.0,
            ahead: 5.0
        }
    );
}

#[test]
fn a_wrong_route_is_refused_and_leaves_none() {
    let map = map(two_lanes());
    let mut follow = with_quirks(&map, straight_on(), LaneFollowQuirks::default());
    let mut refuse = |change: fn(&mut RoutingResponse)| {
        let mut route = straight_on();
        change(&mut route);
        let error = follow.update_route(route).unwrap_err();
        assert!(follow.route().is_none() && follow.is_new(&straight_on()));
        error
    };
    assert_eq!(refuse(|route| route.roads.clear()), RouteError::NoRoad);
    assert_eq!(
        refuse(|route| route.waypoints.truncate(1)),
        RouteError::TooFewWaypoints(1)
    );
    assert_eq!(
        refuse(|route| route.waypoints[1].s = None),
        RouteError::UnplacedWaypoint(1)
    );
    let unknown = refuse(|route| route.roads[0].passages[0].segments[1].lane = "gone".to_owned());
    assert_eq!(
        unknown.to_string(),
        "passage 0_0 drives along lane `gone`, which the map does not hold"
    );
    let infinite = refuse(|route| route.roads[0].passages[0].segments[0].end_s = f64::INFINITY);
    assert!(matches!(infinite, RouteError::NotFinite { .. }));
}

#[test]
fn places_are_searched_from_where_the_car_is() {
    let names: Vec<String> = (0..18).map(|k| format!("lane {k}")).collect();
    let lanes = (0..18).map(|k| lane(&names[k], &[(k as f64 * 10.0, 0.0), ((k + 1) as f64 * 10.0, 0.0)]));
    let map = map(MapData {
        lanes: lanes.collect(),
        ..MapData::default()
    });
    let all: Vec<(&str, f64, f64)> = names.iter().map(|name| (name.as_str(), 0.0, 10.0)).collect();
    let road = vec![vec![passage(&all, ChangeLaneType::Forward)]];
    let route = response(road, &[("lane 0", 1.0), ("lane 17", 9.0)]);
    let route = Route::new(&map, route, LaneFollowQuirks::default()).unwrap();
    let at = LaneWaypoint::on(map.find("lane 11").unwrap(), 5.0);
    assert_eq!(route.find_forward(0, &at), Some(11));
    assert_eq!(route.find_forward(12, &at), None);
    assert_eq!(route.find_backward(12, &at), Some(11));
    assert_eq!(route.find_backward(10, &at), None);
    assert_eq!(route.entry_of(Some(12), &at), Some(11));
    assert_eq!(route.entry_of(None, &at), Some(11));
    assert_eq!(
        [None, Some(3), Some(17), Some(99)].map(|entry| route.entry_after(entry)),
        [0, 4, 17, 17]
    );
}

#[test]
fn waypoints_are_passed_and_passed_again() {
    let map = map(two_lanes());
    let drive = |quirks| {
        let mut follow = with_quirks(&map, straight_on(), quirks);
        [4.0, 6.0, 8.0, 49.0, 51.0, 49.5].map(|x| {
            // Small enough steps for a car that drives.
            let last = follow.ego_waypoint().map_or(x, |at| at.s);
            for k in 1..=20 {
                follow
                    .update_vehicle(&car(last + (x - last) * f64::from(k) / 20.0, 0.0))
                    .unwrap();
            }
            (follow.next_waypoint(), follow.stop_for_destination())
        })
    };
    let ahead = [(0, false), (1, false), (1, false), (1, false), (2, true)];
    let (right, wrong) = (
        drive(LaneFollowQuirks::default()),
        drive(LaneFollowQuirks::apollo()),
    );
    assert_eq!(right[..5], ahead);
    assert_eq!(right[5], (1, false), "it rolled back before a waypoint");
    assert_eq!(wrong[..5], ahead);
    assert_eq!(wrong[5], (1, true));
}

#[test]
fn a_car_that_was_moved_starts_anew() {
    let mut follow = follow(straight_on());
    follow.update_vehicle(&car(120.0, 0.0)).unwrap();
    assert_eq!(
        (follow.ego_entry(), follow.next_waypoint(), follow.range()),
        (Some(1), 2, 0..2)
    );
    assert_eq!(follow.future_waypoints(), Some(1));
    follow.update_vehicle(&car(20.0, 0.0)).unwrap();
    assert_eq!((follow.ego_entry(), follow.next_waypoint()), (Some(0), 1));
}

#[test]
fn a_waypoint_off_the_route_hides_no_other() {
    let map = map(two_lanes());
    let mut route = straight_on();
    route.waypoints[1].lane = Some("left".to_owned());
    let found = |quirks| {
        let route = Route::new(&map, route.clone(), quirks).unwrap();
        route.waypoints().iter().map(|at| at.request).collect::<Vec<_>>()
    };
    assert_eq!(found(LaneFollowQuirks::default()), [0, 2]);
    assert_eq!(found(LaneFollowQuirks::apollo()), [0]);
}

#[test]
fn the_route_decides_where_it_comes_from() {
    let map = map(two_lanes());
    let whole = [("before", 0.0, 40.0), ("right", 0.0, 100.0)];
    let route = vec![vec![passage(&whole, ChangeLaneType::Forward)]];
    let route = response(route, &[("before", 5.0), ("right", 50.0)]);
    let first = |quirks| {
        let follow = with_quirks(&map, route.clone(), quirks);
        let given = RouteSegments::from(vec![segment(&map, "right", 0.0, 100.0)]);
        let extended = follow.extend(&given, -10.0, 50.0).unwrap();
        assert!((extended.length() - 60.0).abs() < 1e-9);
        map.lane(extended.segments[0].lane).name()
    };
    assert_eq!(first(LaneFollowQuirks::default()), "before");
    assert_eq!(first(LaneFollowQuirks::apollo()), "aside");
}

#[test]
fn a_loop_is_driven_once() {
    let mut data = MapData {
        lanes: vec![
            lane("there", &[(0.0, 0.0), (30.0, 0.0)]),
            lane("back", &[(30.0, 0.0), (30.0, 20.0), (0.0, 20.0), (0.0, 0.0)]),
        ],
        ..MapData::default()
    };
    connect(&mut data, "there", "back");
    connect(&mut data, "back", "there");
    let map = map(data);
    let there = vec![vec![passage(&[("there", 0.0, 30.0)], ChangeLaneType::Forward)]];
    let follow = with_quirks(
        &map,
        response(there, &[("there", 1.0), ("there", 29.0)]),
        LaneFollowQuirks::default(),
    );
    let given = RouteSegments::from(vec![segment(&map, "there", 0.0, 30.0)]);
    let ahead = follow.extend(&given, 5.0, 1000.0).unwrap();
    assert_eq!(
        ahead.segments,
        [
            segment(&map, "there", 5.0, 30.0),
            segment(&map, "back", 0.0, 70.0)
        ]
    );
    let behind = follow.extend(&given, -1000.0, 10.0).unwrap();
    assert_eq!(
        behind.segments[0],
        segment(&map, "there", 0.0, 30.0),
        "it ends where it would meet itself"
    );
    let ever = follow.extend(&given, f64::NEG_INFINITY, f64::INFINITY).unwrap();
    assert_eq!(ever.segments.len(), 2);
    assert!(follow.extend(&given, 5.0, 5.0).is_none() && follow.extend(&given, f64::NAN, 5.0).is_none());
}

#[test]
fn the_nearest_lane_that_runs_the_cars_way_is_its_own() {
    let mut data = two_lanes();
    data.lanes.push(lane("oncoming", &[(100.0, 1.0), (0.0, 1.0)]));
    adjoin(&mut data, "left", "oncoming");
    let map = map(data);
    let all = [("oncoming", 0.0, 100.0), ("right", 0.0, 100.0)];
    let route = response(
        vec![vec![passage(&all, ChangeLaneType::Forward)]],
        &[("oncoming", 5.0), ("right", 50.0)],
    );
    let follow = with_quirks(&map, route, LaneFollowQuirks::default());
    let name = |heading| {
        let at = follow
            .nearest_waypoint(&VehicleState {
                heading,
                ..car(50.0, 0.9)
            })
            .unwrap();
        map.lane(at.lane).name()
    };
    assert_eq!(name(0.1), "right");
    assert_eq!(name(3.0), "oncoming");
}

#[test]
fn segments_are_cut_and_stitched() {
    let map = map(two_lanes());
    let lanes = |from, to| {
        RouteSegments::from(vec![
            segment(&map, "right", from, 100.0),
            segment(&map, "right on", 0.0, to),
        ])
    };
    let mut cut = lanes(0.0, 80.0);
    assert!(cut.shrink(120.0, 15.0, 30.0));
    assert_eq!(cut.segments, [segment(&map, "right on", 5.0, 50.0)]);
    assert!(!cut.shrink(46.0, 1.0, 1.0), "beyond the end");
    let mut short = RouteSegments::from(vec![segment(&map, "right", 40.0, 90.0)]);
    assert!(short.stitch(&lanes(10.0, 20.0)));
    assert_eq!(short.segments, lanes(10.0, 20.0).segments);
    let left = RouteSegments::from(vec![segment(&map, "left", 0.0, 100.0)]);
    assert!(!short.stitch(&left) && !short.is_connected(&left));
    let at = short.project(&map, Vec2::new(95.0, 1.0)).unwrap();
    assert_eq!((at.s, at.l, at.waypoint.s), (85.0, 1.0, 95.0));
    assert_eq!(
        short.waypoint_at(95.0).unwrap(),
        LaneWaypoint::on(map.find("right on").unwrap(), 5.0)
    );
    let beside = LaneWaypoint::on(map.find("left").unwrap(), 30.0);
    assert!(short.can_drive_from(&map, &beside));
    let aside = LaneWaypoint::on(map.find("aside").unwrap(), 5.0);
    assert!(!short.can_drive_from(&map, &aside));
}
