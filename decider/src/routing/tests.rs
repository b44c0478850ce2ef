//! Routes on hand-made roads, and costs against a search that looks at everything.

use super::*;
use crate::geometry::Vec2;
use crate::road::{BoundaryType, Lane, LaneId, LaneKind, LanePoint, Mark, Neighbour};
use proptest::prelude::*;

/// Three lanes of a straight road side by side (0 the left one) in `rows` rows of 100 m, joined one after the other.
/// Lane `row · 3 + column`.
pub(crate) fn motorway(rows: u32) -> Vec<Lane> {
    let mut lanes = Vec::new();
    for row in 0..rows {
        for column in 0_u32..3 {
            let beside = |side: Side| {
                let next = if side == Side::Left {
                    column.checked_sub(1)
                } else {
                    Some(column + 1)
                };
                next.filter(|next| *next < 3).map(|next| LaneId(row * 3 + next))
            };
            let mut neighbours = [None; 4];
            for side in [Side::Left, Side::Right] {
                neighbours[Neighbour { side, reverse: false }.index()] = beside(side);
            }
            lanes.push(Lane {
                name: format!("{row}{}", ["a", "b", "c"][column as usize]),
                kind: LaneKind::Driving,
                road: format!("road {row}"),
                junction: None,
                points: straight(f64::from(row) * 100.0, -3.5 * f64::from(column)),
                left_marks: Vec::new(),
                right_marks: Vec::new(),
                neighbours,
                predecessors: if row > 0 {
                    vec![LaneId(row * 3 - 3 + column)]
                } else {
                    Vec::new()
                },
                successors: if row + 1 < rows {
                    vec![LaneId(row * 3 + 3 + column)]
                } else {
                    Vec::new()
                },
            });
        }
    }
    lanes
}

fn straight(x: f64, y: f64) -> Vec<LanePoint> {
    let point = |k: i32| LanePoint {
        s: f64::from(k) * 10.0,
        x: x + f64::from(k) * 10.0,
        y,
        theta: 0.0,
        kappa: 0.0,
        left: 1.75,
        right: 1.75,
        road_left: 1.75,
        road_right: 1.75,
        speed_limit: f64::INFINITY,
    };
    (0..=10).map(point).collect()
}

fn map(lanes: Vec<Lane>) -> RoadMap {
    RoadMap::new(lanes, Vec::new()).unwrap()
}

fn on(lane: u32, s: f64) -> WayPoint {
    WayPoint::OnLane(Position {
        lane: LaneId(lane),
        s,
    })
}

fn route(map: &RoadMap, way_points: &[WayPoint], black: &BlackList) -> Result<RoutingResponse, RoutingError> {
    LaneGraph::new(map, RoutingConfig::default()).route(map, way_points, black)
}

/// `00a-00b|01a` for a road of two passages, with `>` and `<` for the side to which one leaves.
fn drawn(response: &RoutingResponse) -> String {
    let passage = |passage: &Passage| {
        let lanes: Vec<&str> = passage.segments.iter().map(|s| s.lane.as_str()).collect();
        let sign = match passage.change_lane_type {
            ChangeLaneType::Forward => "",
            ChangeLaneType::Left => "<",
            ChangeLaneType::Right => ">",
        };
        lanes.join("-") + sign
    };
    let road = |road: &RoadSegment| road.passages.iter().map(passage).collect::<Vec<_>>().join("|");
    response.roads.iter().map(road).collect::<Vec<_>>().join(" ")
}

#[test]
fn straight_on_is_a_road_per_lane() {
    let map = map(motorway(3));
    let answer = route(&map, &[on(1, 20.0), on(7, 30.0)], &BlackList::default()).unwrap();
    assert_eq!(drawn(&answer), "0b 1b 2b");
    let ends = |road: usize| {
        let segment = &answer.roads[road].passages[0].segments[0];
        (segment.start_s, segment.end_s)
    };
    assert_eq!(
        [ends(0), ends(1), ends(2)],
        [(20.0, 100.0), (0.0, 100.0), (0.0, 30.0)]
    );
    assert!(
        answer
            .roads
            .iter()
            .all(|road| road.passages[0].can_exit && !road.id.is_empty())
    );
}

#[test]
fn passages_run_side_by_side_as_long_as_they_can_be_changed() {
    let map = map(motorway(3));
    let answer = route(&map, &[on(0, 20.0), on(8, 30.0)], &BlackList::default()).unwrap();
    assert_eq!(drawn(&answer), "0a-1a-2a>|0b-1b-2b>|0c-1c-2c");
    let exits: Vec<bool> = answer.roads[0].passages.iter().map(|p| p.can_exit).collect();
    assert_eq!(exits, [false, false, true]);
    for passage in &answer.roads[0].passages {
        let (first, last) = (&passage.segments[0], &passage.segments[2]);
        assert_eq!((first.start_s, last.end_s), (20.0, 30.0), "{}", first.lane);
    }
}

/// Only the middle row lets one change to the left; before and after it one drives in one lane.
#[test]
fn a_solid_line_is_not_crossed() {
    let mut lanes = motorway(3);
    let solid = vec![Mark {
        s: 0.0,
        kind: BoundaryType::SolidWhite,
    }];
    for lane in [1, 7] {
        lanes[lane].left_marks.clone_from(&solid);
    }
    let map = map(lanes);
    let answer = route(&map, &[on(1, 0.0), on(6, 50.0)], &BlackList::default()).unwrap();
    assert_eq!(drawn(&answer), "0b 1b<|1a 2a");
}

#[test]
fn what_is_closed_is_driven_around() {
    let map = map(motorway(3));
    let black = BlackList {
        lanes: vec![(LaneId(4), 40.0, 60.0)],
        roads: Vec::new(),
    };
    let answer = route(&map, &[on(1, 0.0), on(7, 100.0)], &black).unwrap();
    let touches = |s: &LaneSegment| s.lane == "1b" && s.start_s < 60.0 && s.end_s > 40.0;
    let mut segments = answer
        .roads
        .iter()
        .flat_map(|road| &road.passages)
        .flat_map(|p| &p.segments);
    assert!(!segments.any(touches), "{}", drawn(&answer));
    let roads = BlackList {
        lanes: Vec::new(),
        roads: vec!["road 1".to_owned()],
    };
    let refused = route(&map, &[on(1, 0.0), on(7, 100.0)], &roads).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "no route from way-point 0 to way-point 1: all 3 stretches of lane that can be reached lead elsewhere"
    );
}

#[test]
fn wrong_way_points_are_named() {
    let map = map(motorway(1));
    let message = |way_points: &[WayPoint]| {
        route(&map, way_points, &BlackList::default())
            .unwrap_err()
            .to_string()
    };
    assert!(message(&[on(0, 1.0)]).contains("1 way-points were given"));
    assert!(message(&[on(0, 1.0), on(9, 1.0)]).contains("way-point 1: the map has no lane 9"));
    assert!(
        message(&[on(0, 200.0), on(0, 1.0)]).contains("way-point 0: 200 m is not on lane `0a` of 100.00 m")
    );
    assert!(message(&[on(0, f64::NAN), on(0, 1.0)]).contains("way-point 0"));
    let far = WayPoint::At(Vec2::new(0.0, 99.0));
    assert_eq!(
        message(&[on(0, 1.0), far]),
        "way-point 1 is not within 6 m of a lane that cars drive on"
    );
    assert!(message(&[on(0, 50.0), on(0, 20.0)]).contains("no route from way-point 0 to way-point 1"));
}

#[test]
fn a_point_means_the_lane_under_it_and_way_points_are_passed_in_order() {
    let map = map(motorway(4));
    let way_points = [
        WayPoint::At(Vec2::new(5.0, 0.3)),
        WayPoint::At(Vec2::new(150.0, -7.2)),
        WayPoint::At(Vec2::new(390.0, 1.0)),
    ];
    let answer = route(&map, &way_points, &BlackList::default()).unwrap();
    let passed = &answer.waypoints;
    let lanes: Vec<&str> = passed.iter().filter_map(|w| w.lane.as_deref()).collect();
    assert_eq!(lanes, ["0a", "1c", "3a"]);
    assert!((passed[1].s.unwrap() - 50.0).abs() < 1e-9);
}

/// The cheapest cost of all over metres of lane, a change taking one of them, found by relaxing every edge until nothing changes.
fn cheapest(map: &RoadMap, from: (u32, i32), to: (u32, i32)) -> f64 {
    let graph = LaneGraph::new(map, RoutingConfig::default());
    let count = map.lanes().len();
    let mut costs = vec![[f64::INFINITY; 101]; count];
    costs[from.0 as usize][usize::try_from(from.1).unwrap()] = 0.0;
    loop {
        let before = costs.clone();
        for lane in 0..count {
            let node = graph.node(LaneId(u32::try_from(lane).unwrap())).unwrap();
            for s in 0..=100 {
                let here = costs[lane][s];
                if s < 100 {
                    costs[lane][s + 1] = costs[lane][s + 1].min(here + node.rate);
                    for (to, change) in node.changes.iter().flatten() {
                        let there = &mut costs[to.0 as usize][s + 1];
                        *there = there.min(here + node.rate + change);
                    }
                } else {
                    for next in &node.successors {
                        let there = &mut costs[next.0 as usize][0];
                        *there = there.min(here);
                    }
                }
            }
        }
        if costs == before {
            return costs[to.0 as usize][usize::try_from(to.1).unwrap()];
        }
    }
}

proptest! {
    #[test]
    fn no_cheaper_way_exists(
        from in (0u32..12, 0i32..100),
        to in (0u32..12, 2i32..=100),
        speeds in prop::collection::vec(3.0..40.0f64, 4),
        cut in prop::collection::vec(prop::bool::weighted(0.3), 12),
    ) {
        let mut lanes = motorway(4);
        for (k, (lane, cut)) in lanes.iter_mut().zip(&cut).enumerate() {
            lane.points.iter_mut().for_each(|p| p.speed_limit = speeds[k / 3]);
            if *cut {
                lane.successors.clear();
            }
        }
        let map = map(lanes);
        let graph = LaneGraph::new(&map, RoutingConfig::default());
        let at = |(lane, s): (u32, i32)| Position { lane: LaneId(lane), s: f64::from(s) };
        let cuts = Cuts::new(&map, &graph, &BlackList::default(), at(from), at(to));
        let found = search::search(&graph, &cuts, at(from), at(to)).ok().map(|leg| leg.cost);
        let best = cheapest(&map, from, to);
        prop_assert_eq!(found.is_some(), best.is_finite());
        prop_assert!(found.is_none_or(|found| (found - best).abs() < 1e-6), "{found:?} is not {best}");
    }
}
