//! Every edge of every bound names its cause, and the right one.

use super::setup::{LEFT_FORWARD, OWN, Setup, forward_lane};
use crate::frame::ObstacleId;
use crate::road::Side;
use crate::tasks::path_bounds::{Borrow, BoundPoint, EdgeCause, Label, LaneType, PathBound};

/// Causes of the (right, left) limit at station `s`.
fn causes(bound: &PathBound, s: f64) -> (EdgeCause, EdgeCause) {
    let point = bound.points.iter().find(|point| point.s == s).unwrap();
    (point.right, point.left)
}

fn is_obstacle(id: u32) -> EdgeCause {
    EdgeCause::Obstacle(ObstacleId(id))
}

#[test]
fn lane_lines_and_obstacles() {
    let bound = Setup::fixed()
        .with(|setup| setup.road.sections[0].lane = Some((3.5, 3.5)))
        .parked(4, (70.0, 72.0), (1.0, 3.0))
        .parked(5, (80.0, 82.0), (-3.0, -1.5))
        .parked(6, (90.0, 92.0), (2.9, 4.0))
        .parked(7, (90.0, 92.0), (-9.0, -8.0))
        .bound(OWN);
    let lane = (EdgeCause::LaneLine, EdgeCause::LaneLine);
    assert_eq!(causes(&bound, 60.0), lane);
    assert_eq!(causes(&bound, 72.0), (EdgeCause::LaneLine, is_obstacle(4)));
    assert_eq!(causes(&bound, 81.0), (is_obstacle(5), EdgeCause::LaneLine));
    // The one off the road narrows nothing and is no cause.
    assert_eq!(causes(&bound, 91.0), (EdgeCause::LaneLine, is_obstacle(6)));
    assert_eq!(causes(&bound, 100.0), lane);
}

#[test]
fn the_far_line_of_a_borrowed_lane() {
    for (borrow, side) in [(Borrow::Left, Side::Left), (Borrow::Right, Side::Right)] {
        let mut setup = Setup::fixed().with(|setup| {
            setup.borrow = vec![borrow];
            setup.road.sections[0].neighbours = forward_lane(side, 3.0);
        });
        let lane = LaneType::Forward;
        let bound = setup.bound(Label::Regular { borrow, lane });
        let (right, left) = causes(&bound, 80.0);
        let (far, near) = if side == Side::Left {
            (left, right)
        } else {
            (right, left)
        };
        assert_eq!((far, near), (EdgeCause::BorrowedLane, EdgeCause::LaneLine));
    }
}

#[test]
fn where_the_neighbour_ends_the_own_line_rules_again() {
    let mut setup = Setup::fixed().with(|setup| {
        setup.borrow = vec![Borrow::Left];
        setup.road.sections[0].neighbours = forward_lane(Side::Left, 3.0);
        setup.road.sections.push(super::setup::Section {
            from: 90.0,
            ..super::setup::PLAIN
        });
    });
    let bound = setup.bound(LEFT_FORWARD);
    assert_eq!(causes(&bound, 89.5).1, EdgeCause::BorrowedLane);
    assert_eq!(causes(&bound, 90.0).1, EdgeCause::LaneLine);
}

#[test]
fn the_ego_holds_a_bound_open_on_its_side_only() {
    for (l, on_left) in [(1.4, true), (-1.4, false)] {
        let mut setup = Setup::fixed().with(|setup| setup.ego.l = l);
        for label in [Label::Fallback, OWN] {
            let bound = setup.bound(label);
            let (right, left) = causes(&bound, 50.0);
            let (ego, other) = if on_left { (left, right) } else { (right, left) };
            assert_eq!((ego, other), (EdgeCause::Ego, EdgeCause::LaneLine));
            assert_eq!(
                causes(&bound, 65.0),
                (EdgeCause::LaneLine, EdgeCause::LaneLine),
                "faded"
            );
            let first = bound.points[0];
            assert!(
                first.l_min <= l && l <= first.l_max,
                "{first:?} does not hold {l}"
            );
        }
    }
}

#[test]
fn the_road_edge_the_lane_and_the_target_of_a_pull_over() {
    let mut setup = Setup::fixed().pulling_over(Some(120.0));
    let bound = setup.bound(Label::PullOver);
    assert_eq!(causes(&bound, 60.0), (EdgeCause::RoadEdge, EdgeCause::LaneLine));
    let frozen = (EdgeCause::PullOverTarget, EdgeCause::PullOverTarget);
    let last = bound.points.last().unwrap();
    assert_eq!((last.right, last.left), frozen);
    let freezes = |point: &&BoundPoint| point.right == EdgeCause::PullOverTarget;
    assert_eq!(bound.points.iter().filter(freezes).count(), 20);

    // A road narrower than its lane rules on both sides; an ego left of the lane line may come back.
    let mut setup = setup.with(|setup| setup.road.sections[0].road = Some((1.6, 3.0)));
    assert_eq!(
        causes(&setup.bound(Label::PullOver), 60.0),
        (EdgeCause::RoadEdge, EdgeCause::RoadEdge)
    );
    let mut setup = Setup::fixed()
        .pulling_over(Some(120.0))
        .with(|setup| setup.ego.l = 1.0);
    let bound = setup.bound(Label::PullOver);
    assert_eq!(causes(&bound, 60.0), (EdgeCause::RoadEdge, EdgeCause::Ego));
}

#[test]
fn the_zone_before_a_change_of_lane() {
    // From the right into the lane of the line: kept right of it for 60 m.
    let mut setup = Setup::fixed().with(|setup| {
        setup.is_change_lane = true;
        setup.ego.l = -3.5;
    });
    let bound = setup.bound(Label::LaneChange);
    let (right, left) = causes(&bound, 50.0);
    assert_eq!((right, left), (EdgeCause::Ego, EdgeCause::LaneChangeZone));
    assert_eq!(bound.points[0].l_max, -1.75 - 1.055);
    assert_eq!(causes(&bound, 110.0).1, EdgeCause::LaneChangeZone);
    assert_eq!(causes(&bound, 110.5).1, EdgeCause::LaneLine);
}

/// Where the zone ends the ego is still where it was: from there the bound leads into the target lane without a jump.
#[test]
fn the_zone_before_a_change_of_lane_lets_out_into_the_target_lane() {
    for (ego_l, s_dot) in [
        (-3.5, 0.0),
        (-3.5, 8.0),
        (-2.0, 8.0),
        (-1.2, 8.0),
        (1.5, 8.0),
        (3.4, 2.0),
    ] {
        let mut setup = Setup::fixed().with(|setup| {
            setup.is_change_lane = true;
            setup.ego.l = ego_l;
            setup.ego.s_dot = s_dot;
        });
        let bound = setup.bound(Label::LaneChange);
        for point in bound.points.iter().take_while(|point| point.s <= 110.0) {
            assert!(
                point.l_min <= ego_l && ego_l <= point.l_max,
                "the ego at {ego_l} is outside {point:?}"
            );
        }
        for pair in bound.points.windows(2) {
            assert!(
                pair[0].l_min <= pair[1].l_max && pair[1].l_min <= pair[0].l_max,
                "{pair:?}"
            );
        }
        let last = bound.points.last().unwrap();
        assert_eq!((last.l_min, last.l_max), (-0.695, 0.695), "and ends in it");
    }
}

/// Nothing is left unbounded, and no cause is named that is not there.
#[test]
fn no_edge_is_unbounded() {
    let mut setup = Setup::fixed()
        .pulling_over(Some(120.0))
        .with(|setup| setup.borrow = vec![Borrow::Left, Borrow::Right]);
    for _ in 0..2 {
        for bound in setup.decide().unwrap().bounds {
            let open = |point: &BoundPoint| [point.right, point.left].contains(&EdgeCause::Unbounded);
            assert!(!bound.points.iter().any(open), "{}", bound.label);
        }
        setup.memory.pull_over.is_requested = false;
    }
}
