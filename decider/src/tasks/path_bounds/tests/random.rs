//! Random roads and obstacles.

use super::setup::{PLAIN, Section, Setup, forward_lane, parked};
use crate::road::Side;
use crate::tasks::path_bounds::{Borrow, EgoFrenet, ObstacleSl};
use proptest::prelude::*;

/// Parked obstacles from beside the ego to beyond the horizon, on the road and beside it.
pub(super) fn obstacles(from: f64, count: usize) -> impl Strategy<Value = Vec<ObstacleSl>> {
    let one = (from..170.0_f64, 0.2..20.0_f64, -6.0..6.0_f64, 0.1..3.0_f64);
    prop::collection::vec(one, 0..=count).prop_map(|all| {
        let numbered = (1..).zip(all);
        numbered
            .map(|(id, (s, length, l, width))| {
                parked(id, (s, s + length), (l - width / 2.0, l + width / 2.0))
            })
            .collect()
    })
}

/// Sections of lanes 2.6 to 9 m wide, their edges at most half a metre apart from one to the next, each with
/// neighbours or without.
pub(super) fn sections() -> impl Strategy<Value = Vec<Section>> {
    let width = 1.3..4.5_f64;
    let change = (-0.5..0.5_f64, -0.5..0.5_f64, 10.0..40.0_f64);
    (
        (width.clone(), width),
        prop::collection::vec(change, 0..4),
        prop::option::of(2.0..4.0_f64),
        -0.5..0.5_f64,
    )
        .prop_map(|(lane, changes, neighbour, offset)| {
            let first = Section {
                lane: Some(lane),
                offset: Some(offset),
                neighbours: neighbour.map_or([None; 4], |width| forward_lane(Side::Left, width)),
                ..PLAIN
            };
            let mut all = vec![first];
            for (left, right, length) in changes {
                let last = all[all.len() - 1];
                let (l, r) = last.lane.unwrap();
                all.push(Section {
                    from: last.from.max(50.0) + length,
                    lane: Some(((l + left).max(1.2), (r + right).max(1.2))),
                    ..last
                });
            }
            all
        })
}

/// A standing or driving ego somewhere in its lane, on such a road, without obstacles.
pub(super) fn setups() -> impl Strategy<Value = Setup> {
    (sections(), -1.2..1.2_f64, -0.5..0.5_f64, 0.0..15.0_f64).prop_map(|(sections, l, l_dot, s_dot)| {
        Setup::fixed().with(|setup| {
            setup.road.sections = sections;
            setup.ego = EgoFrenet {
                s: 50.0,
                s_dot,
                l,
                l_dot,
            };
            setup.borrow = vec![Borrow::Left];
        })
    })
}
