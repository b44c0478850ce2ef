//! The choice of gaps against an oracle that tries every assignment of sides to obstacles.
//!
//! With a side for each obstacle the corridor is what the lane and the obstacles beside a station leave. It leads
//! as far as it is not empty and each station's interval touches the one before.

use super::random;
use super::setup::{OWN, Setup, parked};
use crate::frame::ObstacleId;
use crate::road::Side;
use crate::tasks::path_bounds::{BoundPoint, ObstacleSl, PathBound};
use proptest::prelude::*;

/// What one obstacle forbids to the rear axle: stations after `from` up to `to`, between `right` and `left`.
#[derive(Clone, Copy, Debug)]
struct Zone {
    id: ObstacleId,
    start_s: f64,
    from: f64,
    to: f64,
    right: f64,
    left: f64,
    /// The only side that is left to an ego beside it.
    only: Option<Side>,
}

impl Zone {
    fn rules(&self, s: f64) -> bool {
        self.from < s && s <= self.to
    }
}

/// Widening and lengthening as configured: 0.4 m aside, 3 m before, 2 m behind. Beside the ego the widening gives
/// way down to 0.1 m, so that it keeps 2 cm from the ego.
fn zone(obstacle: &ObstacleSl, ego: (f64, f64)) -> Zone {
    let (from, to) = (obstacle.start_s - 3.0, obstacle.end_s + 2.0);
    let beside = from < ego.0 && ego.0 <= to;
    let widening = |room: f64| {
        if beside {
            (room - 1.055 - 0.02).clamp(0.1, 0.4)
        } else {
            0.4
        }
    };
    let only = if ego.1 >= obstacle.end_l {
        Some(Side::Left)
    } else if ego.1 <= obstacle.start_l {
        Some(Side::Right)
    } else {
        None
    };
    Zone {
        id: obstacle.id,
        start_s: obstacle.start_s,
        from,
        to,
        right: obstacle.start_l - 1.055 - widening(obstacle.start_l - ego.1),
        left: obstacle.end_l + 1.055 + widening(ego.1 - obstacle.end_l),
        only: only.filter(|_| beside),
    }
}

/// The corridor with one side per zone, as far as it leads.
fn corridor(lane: &[BoundPoint], zones: &[Zone], sides: u32) -> Vec<(f64, f64)> {
    let mut all: Vec<(f64, f64)> = Vec::new();
    for point in lane {
        let (mut right, mut left) = (point.l_min, point.l_max);
        for (k, zone) in zones.iter().enumerate().filter(|(_, zone)| zone.rules(point.s)) {
            let side = if sides & (1 << k) == 0 {
                Side::Left
            } else {
                Side::Right
            };
            if all.is_empty() && zone.only.is_some_and(|only| only != side) {
                return all;
            }
            match side {
                Side::Left => right = right.max(zone.left),
                Side::Right => left = left.min(zone.right),
            }
        }
        let touches = all.last().is_none_or(|last| last.0 <= left && right <= last.1);
        if right > left || !touches {
            return all;
        }
        all.push((right, left));
    }
    all
}

/// The blocker by definition: of the obstacles that rule at the first station nobody reaches and stand in an
/// interval by which some corridor reaches the one before, the nearest in `s`, then the least id.
fn blocker(corridors: &[Vec<(f64, f64)>], reach: usize, s: f64, zones: &[Zone]) -> Option<ObstacleId> {
    let ends = |corridor: &&Vec<(f64, f64)>| corridor.len() == reach;
    let stands_in = |zone: &&Zone| {
        let mut last = (corridors.iter().filter(ends)).filter_map(|corridor| corridor.last());
        zone.rules(s) && last.any(|(right, left)| zone.right < *left && *right < zone.left)
    };
    let nearest = |a: &&Zone, b: &&Zone| a.start_s.total_cmp(&b.start_s).then(a.id.cmp(&b.id));
    zones.iter().filter(stands_in).min_by(nearest).map(|zone| zone.id)
}

fn check(setup: &mut Setup, obstacles: &[ObstacleSl]) -> Result<(), TestCaseError> {
    setup.obstacles.clear();
    let lane = setup.bound(OWN).points;
    setup.obstacles = obstacles.to_vec();
    let answer = setup.decide().unwrap();
    let bound: Option<PathBound> = answer.bounds.into_iter().find(|bound| bound.label == OWN);

    let ego = (setup.ego.s, setup.ego.l);
    let zones: Vec<Zone> = obstacles.iter().map(|obstacle| zone(obstacle, ego)).collect();
    let corridors: Vec<_> = (0..1_u32 << zones.len())
        .map(|sides| corridor(&lane, &zones, sides))
        .collect();
    let reach = corridors.iter().map(Vec::len).max().unwrap();
    let Some(bound) = bound else {
        prop_assert_eq!(reach, 0, "no bound, but a corridor");
        return Ok(());
    };
    prop_assert_eq!(bound.points.len(), reach);
    let is_bound = |corridor: &&Vec<(f64, f64)>| {
        corridor.len() == reach
            && (corridor.iter().zip(&bound.points)).all(|((right, left), point)| {
                (point.l_min - right).abs() < 1e-12 && (point.l_max - left).abs() < 1e-12
            })
    };
    prop_assert!(
        corridors.iter().any(|corridor| is_bound(&corridor)),
        "no assignment of sides has this bound"
    );
    if reach == lane.len() {
        prop_assert_eq!(bound.blocked_by, None);
    } else if let Some(id) = blocker(&corridors, reach, lane[reach].s, &zones) {
        prop_assert_eq!(bound.blocked_by, Some(id));
    } else {
        prop_assert!(
            bound
                .blocked_by
                .is_none_or(|id| zones.iter().any(|zone| zone.id == id))
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn blocked_only_where_no_assignment_leads_on(
        setup in random::setups(),
        obstacles in random::obstacles(54.0, 8),
    ) {
        check(&mut setup.clone(), &obstacles)?;
    }

    /// Many obstacles in a short stretch: most draws are labyrinths, many are blocked.
    #[test]
    fn labyrinths_are_solved(
        width in 3.0..7.0_f64,
        draws in prop::collection::vec((60.0..85.0_f64, 0.2..6.0_f64, -7.0..7.0_f64, 0.1..1.5_f64), 4..=8),
    ) {
        let obstacles: Vec<_> = (1..).zip(&draws)
            .map(|(id, (s, length, l, w))| parked(id, (*s, s + length), (l - w, l + w)))
            .collect();
        let mut setup = Setup::fixed().with(|setup| setup.road.sections[0].lane = Some((width, width)));
        check(&mut setup, &obstacles)?;
    }

    /// An ego beside an obstacle has chosen its side.
    #[test]
    fn an_ego_does_not_jump_across_what_it_is_beside(
        setup in random::setups(),
        beside in (44.0..52.9_f64, 0.2..10.0_f64, -5.0..5.0_f64, 0.1..2.0_f64),
        obstacles in random::obstacles(54.0, 5),
    ) {
        let (s, length, l, width) = beside;
        let mut all = vec![parked(99, (s, s + length), (l - width / 2.0, l + width / 2.0))];
        all.extend(obstacles);
        check(&mut setup.clone(), &all)?;
    }
}

/// An obstacle far beside the road is not to blame for what closes the lane at the ego.
#[test]
fn the_blocker_at_the_ego_stands_in_the_lane() {
    let setup = Setup::fixed()
        .parked(1, (48.0, 52.0), (8.0, 9.0))
        .parked(2, (52.0, 54.0), (-3.0, 3.0));
    let answer = setup.clone().decide().unwrap();
    assert_eq!(answer.bounds.len(), 1, "only the fallback is left");
    assert_eq!(answer.bounds[0].blocked_by, Some(ObstacleId(2)));
}

/// The lane itself narrows beside an obstacle: that one closes it, not the one off the road.
#[test]
fn the_blocker_where_the_lane_narrows() {
    let mut setup = Setup::fixed()
        .parked(1, (60.0, 100.0), (0.5, 1.75))
        .parked(2, (60.0, 100.0), (-9.0, -8.0))
        .with(|setup| {
            setup.road.sections[0].lane = Some((1.75, 2.5));
            setup.road.sections.push(super::setup::Section {
                from: 80.0,
                lane: Some((1.75, 1.75)),
                ..super::setup::PLAIN
            });
        });
    let bound = setup.bound(OWN);
    assert_eq!((bound.end_s(), bound.blocked_by), (79.5, Some(ObstacleId(1))));
}

/// A gap as wide as the car and its buffers leads through, one narrower by a rounding does not.
#[test]
fn a_gap_of_no_width_is_a_gap() {
    let passing = |l: f64| {
        Setup::fixed()
            .with(|setup| {
                setup.vehicle.width = 2.0;
                setup.config.obstacle_lat_buffer = 0.5;
                setup.road.sections[0].lane = Some((2.0, 2.0));
            })
            .parked(1, (80.0, 84.0), (l, 3.0))
            .bound(OWN)
    };
    let bound = passing(0.5);
    assert_eq!(bound.blocked_by, None);
    super::setup::assert_limits(&bound, 77.5, 86.0, (-1.0, -1.0));
    assert_eq!(passing(0.5 - 1e-12).end_s(), 77.0);
}

/// Of two ways of about the same effort, the one nearer to the line.
#[test]
fn the_way_nearer_to_the_line_is_preferred() {
    let bound = Setup::fixed()
        .with(|setup| {
            setup.road.sections[0].lane = Some((6.0, 6.0));
            setup.ego.l = 2.0;
        })
        .parked(1, (80.0, 82.0), (1.855, 1.945))
        .bound(OWN);
    super::setup::assert_limits(&bound, 77.5, 84.0, (-4.945, 0.4));
}

/// A wide gap is preferred to one that the car just fits into, though that lies on the line.
#[test]
fn a_wide_gap_is_preferred_to_a_narrow_one() {
    let between = |left: f64| {
        Setup::fixed()
            .with(|setup| {
                setup.road.sections[0].lane = Some((6.0, 6.0));
                setup.ego.l = -1.5;
            })
            .parked(1, (130.0, 170.0), (-1.55, -1.45))
            .parked(2, (130.0, 170.0), (left, 4.5))
            .bound(OWN)
    };
    super::setup::assert_limits(&between(1.9), 127.5, 149.5, (0.005, 0.445));
    super::setup::assert_limits(&between(1.47), 127.5, 149.5, (-4.945, -3.005));
}
