//! The reference runs of the specification, and what must hold of any profile.

use super::*;
use crate::st_graph::{SpeedLimit, StObstacle, StPair};
use proptest::prelude::*;

fn graph(path_length: f64, init_v: f64, obstacles: Vec<StObstacle>) -> StGraphData {
    StGraphData {
        obstacles,
        init_v,
        init_a: 0.0,
        speed_limit: SpeedLimit::new(vec![(0.0, 15.0), (path_length, 15.0)]).unwrap(),
        cruise_speed: 11.18,
        path_length,
        total_time: 7.0,
    }
}

fn obstacle(pairs: &[(f64, f64, f64)]) -> StObstacle {
    let pairs = pairs.iter().map(|p| StPair::new(p.0, p.1, p.2)).collect();
    StObstacle {
        boundary: StBoundary::new(pairs).unwrap(),
        repels: true,
    }
}

fn run(graph: &StGraphData) -> Result<Found, SpeedHeuristicError> {
    search(&SpeedHeuristicConfig::default(), &VehicleParams::default(), graph)
}

fn check(graph: &StGraphData, places: &[f64], total: f64) {
    let found = run(graph).unwrap();
    let got: Vec<f64> = found.speed.points.iter().map(|point| point.s).collect();
    assert_eq!(got.len(), places.len(), "{got:?}");
    assert!(
        got.iter()
            .zip(places)
            .all(|(got, wanted)| (got - wanted).abs() < 1e-6),
        "{got:?}"
    );
    let cost = found.nodes[found.nodes.len() - 1].total;
    assert!((cost - total).abs() < 1e-3, "{cost}");
}

#[test]
fn a_free_road_is_driven_at_cruise_speed() {
    let places = [0.0, 11.0, 22.0, 33.0, 44.0, 55.0, 66.0, 77.0];
    check(&graph(100.0, 10.0, vec![]), &places, 70_469.942);
    let places = [0.0, 1.0, 3.9, 8.7, 15.0, 22.0, 30.0, 39.0];
    check(&graph(100.0, 0.0, vec![]), &places, 494_660.904);
}

#[test]
fn one_stops_at_a_distance_from_what_stands() {
    let wall = obstacle(&[(0.0, 50.0, 55.0), (7.0, 50.0, 55.0)]);
    let places = [0.0, 11.0, 21.0, 27.0, 29.0, 29.0, 30.0, 31.0];
    check(&graph(100.0, 10.0, vec![wall]), &places, 584_217.607);
}

#[test]
fn a_short_path_is_left_at_its_end() {
    check(
        &graph(40.0, 10.0, vec![]),
        &[0.0, 11.0, 22.0, 32.0, 40.0],
        66_044.253,
    );
    check(&graph(8.0, 5.0, vec![]), &[0.0, 4.9, 8.0], 158_583.212);
}

#[test]
fn the_grid_has_the_rows_of_the_original() {
    let rows = |length| {
        Grid::new(&SpeedHeuristicConfig::default(), length, 7.0)
            .unwrap()
            .rows
            .len()
    };
    assert_eq!([rows(100.0), rows(40.0), rows(8.0), rows(0.0)], [191, 131, 81, 1]);
    for (length, time) in [
        (f64::NAN, 7.0),
        (f64::INFINITY, 7.0),
        (-1.0, 7.0),
        (100.0, f64::NAN),
        (1e9, 7.0),
    ] {
        let grid = Grid::new(&SpeedHeuristicConfig::default(), length, time);
        assert_eq!(grid, Err(SpeedHeuristicError::NoGrid), "{length} m, {time} s");
    }
}

#[test]
fn accelerations_cost_what_the_specification_says() {
    let config = SpeedHeuristicConfig::default();
    let costs = Costs::new(&config, &[], 0.2);
    for (a, cost) in [(1.0, 1.27563), (-2.0, 4.54876), (-4.0, 24.03956)] {
        assert!((costs.acceleration(a) - cost).abs() < 1e-5, "{a}");
    }
    assert!(costs.acceleration(10.0).is_infinite() && costs.jerk(-21.0).is_infinite());
}

#[test]
fn a_car_in_an_obstacle_stays_where_it_is() {
    let found = run(&graph(
        100.0,
        3.0,
        vec![obstacle(&[(0.0, 0.0, 5.0), (7.0, 0.0, 5.0)])],
    ))
    .unwrap();
    assert_eq!(found.speed.points.len(), 8);
    assert!(
        found
            .speed
            .points
            .iter()
            .all(|point| point.s.abs() < 1e-12 && point.v.abs() < 1e-12)
    );
}

#[test]
fn a_wall_that_is_too_near_is_no_profile_but_an_error() {
    let wall = obstacle(&[(0.0, 10.0, 15.0), (7.0, 10.0, 15.0)]);
    assert_eq!(
        run(&graph(100.0, 15.0, vec![wall])),
        Err(SpeedHeuristicError::NoProfile)
    );
}

/// A car that crosses or drives along, some seconds long.
fn cars() -> impl Strategy<Value = StObstacle> {
    (0.0..6.0, 0.5..5.0, 8.0..80.0, 1.0..12.0, -6.0..12.0).prop_map(|(t, lasts, s, length, v)| {
        obstacle(&[
            (t, s, s + length),
            (t + lasts, s + v * lasts, s + v * lasts + length),
        ])
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_profile_touches_nothing_and_keeps_the_limits(
        cars in prop::collection::vec(cars(), 0..6), v in 0.0..15.0, length in 5.0..120.0,
    ) {
        let graph = graph(length, v, cars);
        let Ok(found) = run(&graph) else { return Ok(()) };
        let points = &found.speed.points;
        let mut v_now = v;
        for (pair, node) in points.windows(2).zip(&found.nodes[1..]) {
            let a = 2.0 * (pair[1].s - pair[0].s - v_now);
            prop_assert!((-4.0 - 1e-9..=2.0 + 1e-9).contains(&a));
            v_now = node.v;
            for obstacle in &graph.obstacles {
                let ends = [StPoint::new(pair[0].t, pair[0].s), StPoint::new(pair[1].t, pair[1].s)];
                prop_assert!(!obstacle.boundary.meets_segment(ends[0], ends[1]));
            }
        }
        prop_assert!(found.nodes.windows(2).all(|pair| pair[1].total >= pair[0].total));
    }

    /// In which order obstacles are listed decides nothing. Sums of costs may differ in their last bits.
    #[test]
    fn the_order_of_obstacles_does_not_matter(cars in prop::collection::vec(cars(), 2..6), v in 0.0..15.0) {
        let forward = graph(100.0, v, cars);
        let mut backward = forward.clone();
        backward.obstacles.reverse();
        let total = |graph| run(graph).map(|found| found.nodes.last().map_or(0.0, |node| node.total));
        match (total(&forward), total(&backward)) {
            (Ok(a), Ok(b)) => prop_assert!((a - b).abs() <= 1e-9 * a.max(1.0), "{a} and {b}"),
            (a, b) => prop_assert_eq!(a, b),
        }
    }
}
