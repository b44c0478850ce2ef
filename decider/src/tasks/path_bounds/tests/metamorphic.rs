//! Relations between calls that hold without knowing any answer.

use super::random;
use super::setup::{Section, Setup, parked};
use crate::frame::ObstacleId;
use crate::road::Side;
use crate::tasks::path_bounds::{Borrow, BoundPoint, Label, ObstacleSl, PathBounds};
use proptest::prelude::*;

/// What a bound keeps from every obstacle whatever the ego does: half the car's width and 0.1 m.
const HARD: f64 = 1.055 + 0.1;

fn mirrored_section(section: &Section) -> Section {
    let swap = |pair: (f64, f64)| (pair.1, pair.0);
    let [lf, lr, rf, rr] = section.neighbours;
    Section {
        lane: section.lane.map(swap),
        road: section.road.map(swap),
        offset: section.offset.map(|offset| -offset),
        marks: section.marks.map(|(left, right)| (right, left)),
        neighbours: [rf, rr, lf, lr],
        ..*section
    }
}

fn mirrored_obstacle(obstacle: &ObstacleSl) -> ObstacleSl {
    ObstacleSl {
        start_l: -obstacle.end_l,
        end_l: -obstacle.start_l,
        ..*obstacle
    }
}

fn other_side(borrow: Borrow) -> Borrow {
    match borrow {
        Borrow::None => Borrow::None,
        Borrow::Left => Borrow::Right,
        Borrow::Right => Borrow::Left,
    }
}

/// The same call in a mirror. Only what treats both sides alike is mirrored: not a pull-over.
fn mirrored(setup: &Setup) -> Setup {
    let mut other = setup.clone();
    other.road.sections = setup.road.sections.iter().map(mirrored_section).collect();
    other.obstacles = setup.obstacles.iter().map(mirrored_obstacle).collect();
    other.ego.l = -setup.ego.l;
    other.ego.l_dot = -setup.ego.l_dot;
    other.borrow = setup.borrow.iter().map(|borrow| other_side(*borrow)).collect();
    for (_, side) in &mut other.memory.passed {
        *side = side.opposite();
    }
    other
}

fn mirrored_point(point: &BoundPoint) -> BoundPoint {
    BoundPoint {
        s: point.s,
        l_min: -point.l_max,
        l_max: -point.l_min,
        right: point.left,
        left: point.right,
    }
}

/// Whether some obstacle forbids the same to both sides of a bound's ego, so that a side is a matter of taste.
fn is_tie(setup: &Setup) -> bool {
    setup
        .obstacles
        .iter()
        .any(|obstacle| (f64::midpoint(obstacle.start_l, obstacle.end_l) - setup.ego.l).abs() < 1e-6)
}

fn limits(points: &[BoundPoint]) -> Vec<(f64, f64)> {
    points.iter().map(|point| (point.l_min, point.l_max)).collect()
}

/// On which side the bound of `label` passes obstacle `id`.
fn side(answer: &PathBounds, label: Label, id: ObstacleId) -> Option<Side> {
    let place = answer.bounds.iter().position(|bound| bound.label == label)?;
    answer.passed[place]
        .iter()
        .find(|(other, _)| *other == id)
        .map(|(_, side)| *side)
}

proptest! {
    /// Defect A7: in a mirror every bound is mirrored, causes, blocker and sides included.
    #[test]
    fn a_mirrored_road_has_mirrored_bounds(
        setup in random::setups(),
        obstacles in random::obstacles(44.0, 6),
        before in prop::collection::vec(any::<bool>(), 6),
    ) {
        let mut setup = setup;
        setup.obstacles = obstacles;
        setup.memory.passed = (1..)
            .zip(before)
            .map(|(id, left)| (ObstacleId(id), if left { Side::Left } else { Side::Right }))
            .collect();
        prop_assume!(!is_tie(&setup));
        let mut other = mirrored(&setup);
        let (here, there) = (setup.decide().unwrap(), other.decide().unwrap());
        prop_assert_eq!(here.bounds.len(), there.bounds.len());
        for (a, b) in here.bounds.iter().zip(&there.bounds) {
            let mirrored: Vec<_> = b.points.iter().map(mirrored_point).collect();
            prop_assert_eq!(&a.points, &mirrored, "{}", a.label);
            prop_assert_eq!(a.blocked_by, b.blocked_by);
        }
        for (a, b) in here.passed.iter().zip(&there.passed) {
            let mut mirrored: Vec<_> = b.iter().map(|(id, side)| (*id, side.opposite())).collect();
            let mut here = a.clone();
            here.sort_unstable();
            mirrored.sort_unstable();
            prop_assert_eq!(here, mirrored);
        }
    }

    /// Defect A10: the order in which obstacles are told does not matter.
    #[test]
    fn the_order_of_obstacles_does_not_matter(
        setup in random::setups(),
        (given, shuffled) in random::obstacles(44.0, 8)
            .prop_flat_map(|all| (Just(all.clone()), Just(all).prop_shuffle())),
        twins in any::<bool>(),
    ) {
        let (mut a, mut b) = (setup.clone(), setup);
        (a.obstacles, b.obstacles) = (given, shuffled);
        if twins {
            // Equal in everything but the name: at one end here, at the other there.
            let twin = ObstacleSl { id: ObstacleId(77), ..*a.obstacles.first().unwrap_or(&parked(1, (70.0, 72.0), (0.0, 1.0))) };
            a.obstacles.push(twin);
            b.obstacles.insert(0, twin);
        }
        prop_assert_eq!(a.decide(), b.decide());
    }

    /// Whoever is behind, beyond the horizon, moving, virtual or ignored changes nothing.
    #[test]
    fn what_is_out_of_scope_changes_nothing(
        setup in random::setups(),
        obstacles in random::obstacles(44.0, 5),
        extra in (0.0..5.0_f64, -5.0..5.0_f64, 0.1..3.0_f64, 0..5),
    ) {
        let mut without = setup;
        without.obstacles = obstacles;
        let mut with = without.clone();
        let (far, l, width, why) = extra;
        let on_the_road = parked(50, (70.0, 72.0), (l - width, l + width));
        with.obstacles.push(match why {
            0 => parked(50, (152.6 + far, 160.0), (l - width, l + width)),
            1 => parked(50, (20.0, 47.9 - far), (l - width, l + width)),
            2 => ObstacleSl { speed: 0.51, ..on_the_road },
            3 => ObstacleSl { is_virtual: true, ..on_the_road },
            _ => ObstacleSl { is_ignored: true, ..on_the_road },
        });
        prop_assert_eq!(without.decide(), with.decide());
    }

    /// One more parked car takes room and gives none. Exactly: no bound leads farther than before; each keeps to
    /// room that was free before; and where it passes the others on the sides as before, it lies inside the bound
    /// of before. (On other sides it may well lie elsewhere: it goes where room is left.) How far a limit beside
    /// the ego gives way depends on that obstacle and the ego alone. The fallback is left out where nothing of it
    /// remained: then it is given whole, to brake in.
    #[test]
    fn a_parked_car_more_never_gives_room(
        setup in random::setups(),
        obstacles in random::obstacles(44.0, 6),
        extra in (44.0..140.0_f64, -5.0..5.0_f64, 0.1..1.5_f64),
    ) {
        let mut before = setup;
        let mut road = before.clone();
        before.obstacles = obstacles;
        let (s, l, half) = extra;
        let mut after = before.clone().parked(50, (s, s + 5.0), (l - half, l + half));
        let (road, old, new) = (road.decide().unwrap(), before.decide().unwrap(), after.decide().unwrap());
        for bound in new.bounds.iter().filter(|bound| bound.label != Label::Fallback) {
            let label = bound.label;
            let find = |answer: &PathBounds| answer.bounds.iter().find(|other| other.label == label).cloned();
            let (Some(open), Some(wide)) = (find(&road), find(&old)) else {
                return Err(TestCaseError::fail(format!("`{label}` appeared")));
            };
            prop_assert!(bound.points.len() <= wide.points.len());
            for (k, point) in bound.points.iter().enumerate() {
                prop_assert!(point.l_min >= open.points[k].l_min && point.l_max <= open.points[k].l_max);
                for obstacle in &before.obstacles {
                    let beside = obstacle.start_s - 3.0 < point.s && point.s <= obstacle.end_s + 2.0;
                    let clear = point.l_min >= obstacle.end_l + HARD - 1e-9
                        || point.l_max <= obstacle.start_l - HARD + 1e-9;
                    prop_assert!(!beside || clear, "{point:?} runs into {obstacle:?}");
                }
            }
            let sides_kept = (before.obstacles.iter())
                .filter_map(|it| Some((side(&new, label, it.id)?, side(&old, label, it.id)?)))
                .all(|(new, old)| new == old);
            if sides_kept {
                for (new, old) in limits(&bound.points).iter().zip(limits(&wide.points)) {
                    prop_assert!(new.0 >= old.0 && new.1 <= old.1, "{new:?} exceeds {old:?}");
                }
            }
        }
    }
}
