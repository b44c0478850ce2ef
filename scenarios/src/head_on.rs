//! Lanes whose traffic meets head-on: both end at one place, and neither goes on.
//!
//! Files have such lanes where somebody drew the bounds of a lane the other way round. Nothing is repaired: which of the two is
//! wrong cannot be told; but no route leads on there, and whoever looks for one should learn why.

use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::road::{Lane, RoadMap};

/// Ends within this distance are one place, m: half of what a line bridges between lanes.
const ONE_PLACE: f64 = 0.25;

/// Least angle between two lanes that meet head-on, rad: 150°.
const OPPOSED: f64 = 2.6;

/// How many pairs are named.
const NAMED: usize = 6;

/// The warning about all such pairs of a map, if there are any.
pub(crate) fn warning(map: &RoadMap) -> Option<String> {
    let mut ends: Vec<(Vec2, f64, &Lane)> = map.lanes().iter().filter_map(dead_end).collect();
    // By x, so that each end has only few to be compared with.
    ends.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.2.name.cmp(&b.2.name)));
    let mut pairs = Vec::new();
    let mut count = 0;
    for (k, (place, theta, lane)) in ends.iter().enumerate() {
        let near = ends[k + 1..]
            .iter()
            .take_while(|end| end.0.x - place.x <= ONE_PLACE);
        let meets = |end: &&(Vec2, f64, &Lane)| {
            (end.0 - place).norm() <= ONE_PLACE && angle::difference(end.1, *theta).abs() >= OPPOSED
        };
        for (.., other) in near.filter(meets) {
            count += 1;
            if pairs.len() < NAMED {
                pairs.push(format!("`{}` and `{}`", lane.name, other.name));
            }
        }
    }
    let more = if count > NAMED { " and others" } else { "" };
    (count > 0).then(|| {
        let pairs = pairs.join(", ");
        format!("{count} pairs of lanes meet head-on, so that no route leads on: {pairs}{more}")
    })
}

/// Where a drivable lane ends and its direction there, if nothing follows on it.
fn dead_end(lane: &Lane) -> Option<(Vec2, f64, &Lane)> {
    let last = lane.points.last()?;
    let ends = lane.kind.is_drivable() && lane.successors.is_empty();
    ends.then(|| (last.offset(0.0), last.theta, lane))
}
