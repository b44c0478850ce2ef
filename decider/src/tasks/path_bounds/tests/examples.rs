//! The worked numbers A to H of the original's behaviour, and what the mended default gives for each.

use super::setup::{LEFT_FORWARD, OWN, Setup, assert_limits, forward_lane};
use crate::frame::ObstacleId;
use crate::reference_line::LineQuery;
use crate::road::Side;
use crate::tasks::path_bounds::{Borrow, Label};

/// Limits of a car in the middle of its lane of 3.5 m.
const LANE: (f64, f64) = (-0.695, 0.695);

#[test]
fn a_the_fallback_holds_the_ego_and_its_drift() {
    for (l_dot, l_max) in [(0.0, 1.5), (0.5, 1.5 + 0.25 / 3.0), (-0.5, 1.5)] {
        let off_center = |setup: &mut Setup| (setup.ego.l, setup.ego.l_dot) = (1.0, l_dot);
        let bound = Setup::apollo().with(off_center).bound(Label::Fallback);
        assert_eq!(bound.points.len(), 200);
        assert_limits(&bound, 50.0, 149.5, (-0.695, l_max));

        // Mended: held for 5 m, back in the lane 10 m later.
        let bound = Setup::fixed().with(off_center).bound(Label::Fallback);
        assert_eq!(bound.points.len(), 200);
        assert_limits(&bound, 50.0, 55.0, (-0.695, l_max));
        assert_limits(&bound, 60.0, 60.0, (-0.695, f64::midpoint(l_max, 0.695)));
        assert_limits(&bound, 65.0, 149.5, LANE);
    }
}

#[test]
fn b_an_obstacle_on_the_left_leaves_the_right() {
    for setup in [Setup::apollo(), Setup::fixed()] {
        let bound = setup.parked(1, (60.0, 64.0), (0.9, 2.0)).bound(OWN);
        assert_limits(&bound, 50.0, 57.0, LANE);
        assert_limits(&bound, 57.5, 66.0, (-0.695, -0.555));
        assert_limits(&bound, 66.5, 149.5, LANE);
        assert_eq!(bound.blocked_by, None);
    }
}

#[test]
fn c_an_obstacle_in_the_middle_blocks() {
    let bound = Setup::apollo().parked(7, (60.0, 64.0), (-0.6, 1.2)).bound(OWN);
    assert_eq!(bound.blocked_by, Some(ObstacleId(7)));
    assert_eq!((bound.points.len(), bound.padding), (35, 20));
    assert_eq!(bound.points[34].s, 67.0);
    assert_eq!(bound.end_s(), 57.0);
    assert_limits(&bound, 50.0, 67.0, LANE);

    let bound = Setup::fixed().parked(7, (60.0, 64.0), (-0.6, 1.2)).bound(OWN);
    assert_eq!(bound.blocked_by, Some(ObstacleId(7)));
    assert_eq!((bound.points.len(), bound.padding), (15, 0));
    assert_eq!(bound.points[14].s, 57.0);
}

#[test]
fn d_the_lane_to_the_left_leads_around() {
    for setup in [Setup::apollo(), Setup::fixed()] {
        let mut setup = setup.parked(7, (60.0, 64.0), (-0.6, 1.2)).with(|setup| {
            setup.borrow = vec![Borrow::Left];
            setup.road.sections[0].neighbours = forward_lane(Side::Left, 3.5);
        });
        let bound = setup.bound(LEFT_FORWARD);
        assert_limits(&bound, 50.0, 57.0, (-0.695, 4.195));
        assert_limits(&bound, 57.5, 66.0, (2.655, 4.195));
        assert_limits(&bound, 66.5, 149.5, (-0.695, 4.195));
        assert_eq!(bound.blocked_by, None);
    }
}

#[test]
fn e_two_obstacles_are_both_passed_on_the_right() {
    for setup in [Setup::apollo(), Setup::fixed()] {
        let bound = setup
            .with(|setup| setup.road.sections[0].lane = Some((3.5, 3.5)))
            .parked(1, (70.0, 72.0), (1.0, 3.0))
            .parked(2, (80.0, 82.0), (-0.2, 0.6))
            .bound(OWN);
        assert_limits(&bound, 50.0, 67.0, (-2.445, 2.445));
        assert_limits(&bound, 67.5, 74.0, (-2.445, -0.455));
        assert_limits(&bound, 74.5, 77.0, (-2.445, 2.445));
        assert_limits(&bound, 77.5, 84.0, (-2.445, -1.655));
        assert_limits(&bound, 84.5, 149.5, (-2.445, 2.445));
    }
}

#[test]
fn f_the_station_of_the_ego_is_constrained_too() {
    let beside = |setup: Setup| {
        setup
            .with(|setup| setup.road.sections[0].lane = Some((3.5, 3.5)))
            .parked(1, (48.0, 50.2), (1.5, 3.0))
            .bound(OWN)
    };
    let bound = beside(Setup::apollo());
    assert_limits(&bound, 50.0, 50.0, (-2.445, 2.445));
    assert_limits(&bound, 50.5, 52.0, (-2.445, 0.045));
    assert_limits(&bound, 52.5, 149.5, (-2.445, 2.445));

    let bound = beside(Setup::fixed());
    assert_limits(&bound, 50.0, 52.0, (-2.445, 0.045));
    assert_limits(&bound, 52.5, 149.5, (-2.445, 2.445));
}

#[test]
fn g_pulls_over_before_the_destination() {
    for (setup, l_max) in [(Setup::apollo(), 1.75), (Setup::fixed(), 0.695)] {
        let mut setup = setup
            .with(|setup| setup.road.sections[0].road = Some((3.0, 3.0)))
            .pulling_over(Some(130.0));
        let bound = setup.bound(Label::PullOver);
        assert_eq!(bound.points.len(), 177);
        assert_limits(&bound, 50.0, 138.0, (-1.945, l_max));
        let place = setup.memory.pull_over.place.unwrap();
        let at = setup.road.to_frenet(place.position);
        assert!(
            (at.s - 128.0).abs() < 1e-9 && (at.l + 1.68125).abs() < 1e-9,
            "{at:?}"
        );
        assert_eq!((place.length_front, place.length_back), (3.0, 2.0));
        assert_eq!((place.width_left, place.width_right), (1.055, 1.055));
    }
}

#[test]
fn h_pulls_over_at_once_in_an_emergency() {
    for setup in [Setup::apollo(), Setup::fixed()] {
        let mut setup = setup.pulling_over(None);
        let bound = setup.bound(Label::PullOver);
        let place = setup.memory.pull_over.place.unwrap();
        let at = setup.road.to_frenet(place.position);
        assert!(
            (at.s - 71.0).abs() < 1e-9 && (at.l + 1.68125).abs() < 1e-9,
            "{at:?}"
        );
        assert_eq!(bound.points.len(), 42 + 20 + 1);
    }
}
