//! Successors and neighbours, known on both sides and checked against the geometry.

use super::Source;
use super::centre::Strip;
use super::joints::{Links, bend};
use corridor_decider::road::Neighbour;
use std::collections::BTreeSet;

/// Centre lines that are linked meet within this, m.
const JOIN_DISTANCE: f64 = 0.5;

/// Lanes that turn by more into each other are no way on, rad: a taper may start at an angle, and coarse
/// lanes of a junction turn at once.
const JOIN_TURN: f64 = std::f64::consts::FRAC_PI_2;

/// The links that either side names, between strips that meet.
pub(super) fn links(strips: &[Option<Strip>], source: &mut Source<'_, '_>) -> Links {
    let mut named: BTreeSet<(usize, usize)> = BTreeSet::new();
    for (number, lanelet) in source.lanelets.iter().enumerate() {
        named.extend(lanelet.successors.iter().map(|&next| (number, next)));
        named.extend(lanelet.predecessors.iter().map(|&before| (before, number)));
    }
    let mut links = Links {
        predecessors: vec![Vec::new(); strips.len()],
        successors: vec![Vec::new(); strips.len()],
    };
    for (from, to) in named {
        let (Some(Some(a)), Some(Some(b))) = (strips.get(from), strips.get(to)) else {
            continue;
        };
        let gap = (b.centre.first() - a.centre.last()).norm();
        if gap <= JOIN_DISTANCE && bend(strips, from, to) <= JOIN_TURN {
            links.successors[from].push(to);
            links.predecessors[to].push(from);
        } else {
            source.note("linked lanelets that do not meet are not joined", from);
        }
    }
    links.straightest_first(strips)
}

/// The neighbours of all strips such that each knows the other; where the file contradicts itself, who was named first.
pub(super) fn neighbours(strips: &[Option<Strip>], source: &mut Source<'_, '_>) -> Vec<[Option<usize>; 4]> {
    let mut known = vec![[None; 4]; strips.len()];
    let there = |number: usize| strips.get(number).is_some_and(Option::is_some);
    for number in 0..strips.len() {
        for side in Neighbour::ALL {
            let Some(other) = source.lanelets[number].neighbours[side.index()] else {
                continue;
            };
            if !there(number) || !there(other) || other == number {
                continue;
            }
            let (here, back) = (side.index(), seen_back(side).index());
            let free = |slot: Option<usize>, who: usize| slot.is_none_or(|taken| taken == who);
            if free(known[number][here], other) && free(known[other][back], number) {
                known[number][here] = Some(other);
                known[other][back] = Some(number);
            } else {
                source.note(
                    "a lanelet that is beside another one which names a third is not its neighbour",
                    number,
                );
            }
        }
    }
    known
}

/// What a lane is to its neighbour: traffic that comes towards us sees us on the same side.
fn seen_back(neighbour: Neighbour) -> Neighbour {
    let side = if neighbour.reverse {
        neighbour.side
    } else {
        neighbour.side.opposite()
    };
    Neighbour { side, ..neighbour }
}
