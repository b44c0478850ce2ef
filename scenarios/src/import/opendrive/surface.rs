//! The road surface seen from each lane of a cross-section: how far wheels may go to both sides.

use super::record::Section;
use corridor_decider::road::LaneKind;

/// Border strips narrower than this between two lanes belong to the surface, m.
const STEP_OVER: f64 = 1.0;

/// A lane narrower than this is not there, m.
const CLOSED: f64 = 1e-3;

/// The left and right edge, as lateral positions, of the surface that each lane is part of. A lane that is no road
/// surface has its own edges.
///
/// `kinds` are the lanes' uses and `edges` their edges, both from left to right.
pub(super) fn surface(section: &Section, kinds: &[LaneKind], edges: &[[f64; 3]]) -> Vec<(f64, f64)> {
    let own = |lane: usize| (edges[lane][0], edges[lane + 1][0]);
    let mut surface: Vec<(f64, f64)> = (0..kinds.len()).map(own).collect();
    let mut group: Vec<usize> = Vec::new();
    for lane in 0..kinds.len() {
        let (left, right) = own(lane);
        if !kinds[lane].is_road_surface() || left - right < CLOSED {
            continue;
        }
        if let Some(&last) = group.last()
            && !is_one_surface(section, kinds, edges, last, lane)
        {
            share(&mut surface, &group);
            group.clear();
        }
        group.push(lane);
    }
    share(&mut surface, &group);
    surface
}

/// Gives all lanes of a contiguous surface its outermost edges.
fn share(surface: &mut [(f64, f64)], group: &[usize]) {
    if let (Some(&first), Some(&last)) = (group.first(), group.last()) {
        let edges = (surface[first].0, surface[last].1);
        for &lane in group {
            surface[lane] = edges;
        }
    }
}

/// Whether nothing but what wheels may cross lies between two surface lanes.
fn is_one_surface(
    section: &Section,
    kinds: &[LaneKind],
    edges: &[[f64; 3]],
    left: usize,
    right: usize,
) -> bool {
    let gap = edges[left + 1][0] - edges[right][0];
    if gap < CLOSED {
        return true;
    }
    let same_side = (section.lanes[left].id > 0) == (section.lanes[right].id > 0);
    let open = |lane: &usize| edges[*lane][0] - edges[*lane + 1][0] >= CLOSED;
    let borders = (left + 1..right)
        .filter(open)
        .all(|lane| kinds[lane] == LaneKind::Border);
    same_side && borders && gap < STEP_OVER
}
