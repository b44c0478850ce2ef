//! What is assumed where the map says nothing, and exact numbers of constants that nothing else pins.

use super::setup::{OWN, PLAIN, Section, Setup, assert_limits};
use crate::reference_line::LineQuery;
use crate::tasks::path_bounds::{EdgeCause, EgoFrenet, Label};

fn hole(from: f64) -> Section {
    Section {
        from,
        lane: None,
        road: None,
        offset: None,
        ..PLAIN
    }
}

/// A lane of 5 m around its centre line.
#[test]
fn without_a_lane_width_the_lane_is_five_metres_wide() {
    let mut setup = Setup::fixed().with(|setup| setup.road.sections = vec![hole(f64::NEG_INFINITY)]);
    assert_limits(&setup.bound(OWN), 50.0, 149.5, (-1.445, 1.445));
}

/// In a hole farther on the last widths are carried on, in the frame of the lane's centre line.
#[test]
fn a_hole_carries_the_lane_on() {
    let mut setup = Setup::fixed().with(|setup| {
        setup.road.sections = vec![
            Section {
                lane: Some((1.5, 2.0)),
                offset: Some(0.25),
                ..PLAIN
            },
            hole(80.0),
        ];
    });
    let bound = setup.bound(OWN);
    assert_limits(&bound, 50.0, 79.5, (-2.0 + 1.055, 1.5 - 1.055));
    assert_limits(&bound, 80.0, 149.5, (-1.75 + 1.055, 1.75 - 1.055));
}

/// The road's edges are carried on likewise; before anything is known the road is as wide as the ego's lane.
#[test]
fn a_hole_carries_the_road_on() {
    let pulling_over = |sections: Vec<Section>| {
        let mut setup = Setup::fixed()
            .with(|setup| setup.road.sections = sections)
            .pulling_over(Some(120.0));
        setup.config.quirks.unchecked_road_width = true;
        setup.config.quirks.road_edge_at_axle = true;
        setup.bound(Label::PullOver)
    };
    let known = Section {
        road: Some((1.6, 3.0)),
        offset: Some(0.25),
        ..PLAIN
    };
    let bound = pulling_over(vec![known, hole(80.0)]);
    assert_limits(&bound, 50.0, 79.5, (-3.0 + 1.055, 1.6 - 1.055));
    assert_limits(&bound, 80.0, 110.0, (-2.75 + 1.055, 1.85 - 1.055));
    assert!(bound.points.iter().all(|point| point.left != EdgeCause::LaneLine));

    let bound = pulling_over(vec![hole(f64::NEG_INFINITY)]);
    assert_limits(&bound, 50.0, 110.0, (-1.445, 1.445));
}

/// Without a lane width a pull-over takes 3 m to the left.
#[test]
fn without_a_lane_a_pull_over_stays_within_three_metres() {
    let no_lane = Section { lane: None, ..PLAIN };
    let mut setup = Setup::fixed()
        .with(|setup| setup.road.sections = vec![no_lane])
        .pulling_over(Some(120.0));
    assert_limits(&setup.bound(Label::PullOver), 50.0, 110.0, (-1.945, 3.0 - 1.055));
}

/// A place counts as inside only where the station before it holds it, too.
#[test]
fn a_place_at_the_edge_of_an_obstacle_is_given_up() {
    let mut setup = Setup::fixed().pulling_over(Some(120.0));
    setup.bound(Label::PullOver);
    // Inside the bound right behind an obstacle's end, outside right before it.
    setup.obstacles = vec![super::setup::parked(1, (90.0, 98.0), (-3.0, -1.5))];
    let mut place = setup.memory.pull_over.place.unwrap();
    place.position = crate::geometry::Vec2::new(100.2, -1.6);
    setup.memory.pull_over.place = Some(place);
    setup.bound(Label::PullOver);
    let kept = setup
        .road
        .to_frenet(setup.memory.pull_over.place.unwrap().position);
    assert!((kept.s - 118.0).abs() < 1e-9, "{kept:?}");
}

/// An emergency search begins at the station of its target itself: 53.89 m and one turning diameter.
#[test]
fn an_emergency_search_begins_at_its_target() {
    let mut setup = Setup::fixed().pulling_over(None);
    setup.vehicle.front_edge_to_center = 4.0;
    setup.vehicle.min_turn_radius = 8.0;
    setup.config.pull_over_approach_lon_distance_adjust_factor = 1.0;
    setup.bound(Label::PullOver);
    let place = setup
        .road
        .to_frenet(setup.memory.pull_over.place.unwrap().position);
    // Target 50 + 4 + 16; the place lies one station into the window of 2.4 m.
    assert!((place.s - 70.5).abs() < 1e-9, "{place:?}");
}

/// The zone before a change of lane: from the left and from the right, up to its end and not behind it.
#[test]
fn the_zone_keeps_half_a_car_out_of_the_target_lane() {
    let changing = |l: f64| {
        Setup::fixed().with(|setup| {
            setup.is_change_lane = true;
            setup.ego.l = l;
            setup.config.quirks.endless_ego_extension = true;
        })
    };
    let bound = changing(3.5).bound(Label::LaneChange);
    assert_limits(&bound, 50.0, 110.0, (1.75 + 1.055, 3.6));
    assert_limits(&bound, 110.5, 149.5, (-0.695, 3.6));
    let bound = changing(-3.5).bound(Label::LaneChange);
    assert_limits(&bound, 50.0, 110.0, (-3.6, -1.75 - 1.055));
    // Straddling the line it keeps its place, 0.1 m to each side.
    let bound = changing(2.0).bound(Label::LaneChange);
    assert_limits(&bound, 50.0, 110.0, (1.9, 2.1));
    // Where the zone began is remembered, forgotten once the lane is clear, and over once it is passed.
    let mut setup = changing(3.5);
    setup.bound(Label::LaneChange);
    assert_eq!(setup.memory.change_lane.start.map(|at| at.x), Some(110.0));
    setup.ego.s = 80.0;
    assert_limits(&setup.bound(Label::LaneChange), 80.0, 110.0, (1.75 + 1.055, 3.6));
    setup.ego.s = 111.0;
    assert_limits(&setup.bound(Label::LaneChange), 111.0, 149.0, (-0.695, 3.6));
    setup.memory.change_lane.is_clear = true;
    setup.bound(Label::LaneChange);
    assert_eq!(setup.memory.change_lane.start, None);
}

/// The horizon: 100 m, or 8 s at cruise speed, or the line's end; and no station at the end itself.
#[test]
fn the_horizon_is_a_time_or_a_distance() {
    let last = |cruise: f64, length: f64| {
        let mut setup = Setup::fixed().with(|setup| setup.cruise_speed = cruise);
        setup.road.length = length;
        setup.bound(OWN).points.last().unwrap().s
    };
    assert_eq!(last(0.0, 500.0), 149.5);
    assert_eq!(last(-3.0, 500.0), 149.5);
    assert_eq!(last(8.0, 500.0), 149.5);
    assert_eq!(last(20.0, 500.0), 209.5);
    assert_eq!(last(20.0, 100.0), 99.5);
}

/// Static up to half a metre per second, beside the ego up to two metres behind it: both limits included.
#[test]
fn the_limits_of_scope_are_included() {
    let narrowed = |speed: f64, end_s: f64| {
        let mut setup = Setup::fixed().parked(1, (40.0, end_s), (1.2, 3.0));
        setup.obstacles[0].speed = speed;
        setup.bound(OWN).points[0].l_max < 0.6
    };
    assert!(narrowed(0.5, 48.0) && !narrowed(0.5 + 1e-9, 48.0));
    assert!(!narrowed(0.5, 48.0 - 1e-9));
}

/// The lateral speed counts in the direction of the heading, whatever the line's curvature.
#[test]
fn the_ego_moves_along_its_heading() {
    let line = crate::reference_line::testing::line(60.0, |_| 0.05);
    let at = line.point(30.0);
    let place = line.to_cartesian(crate::reference_line::SlPoint { s: 30.0, l: 4.0 });
    let pose = crate::geometry::Pose::new(place.x, place.y, at.theta + 0.1);
    let ego = EgoFrenet::at(&line, pose, 10.0);
    let (sin, cos) = crate::geometry::angle::sin_cos(0.1);
    assert!((ego.s - 30.0).abs() < 1e-9 && (ego.l - 4.0).abs() < 1e-9);
    assert!((ego.l_dot - 10.0 * sin).abs() < 1e-9, "{ego:?}");
    // Four metres inside a bend of 20 m radius the station runs faster than the car: 20 / 16.
    assert!((ego.s_dot - 10.0 * cos / 0.8).abs() < 1e-6, "{ego:?}");
}

/// An ego that touches a widened obstacle on both sides still gets a fallback to brake in.
#[test]
fn the_fallback_is_never_taken_away() {
    let mut setup = Setup::fixed().parked(1, (51.0, 55.0), (-6.0, 6.0));
    let bound = setup.bound(Label::Fallback);
    assert_eq!(bound.points.len(), 200);
    assert!(bound.blocked_by.is_some());
}

/// Only with the smarter lane change have change-lane lines a bound of their own kind.
#[test]
fn flags_choose_the_kind_of_bounds() {
    let mut setup = Setup::fixed().with(|setup| {
        setup.is_change_lane = true;
        setup.config.enable_smarter_lane_change = false;
    });
    setup.bound(OWN);
    setup.config.enable_smarter_lane_change = true;
    setup.bound(Label::LaneChange);
}
