//! Headings where lanes meet: one for all that meet, so that no line along them has a kink.

use super::curve::Knots;
use super::topology::Topology;
use corridor_decider::geometry::angle;
use std::f64::consts::FRAC_PI_4;

/// Lanes that differ by more than this do not share a heading, rad.
const MOST_TURN: f64 = FRAC_PI_4;

/// The headings to impose on the start and the end of every lane.
///
/// Of all ends that meet, the one where the lane turns least knows best: a straight road, rather than the first
/// chord of the bend that begins there.
pub(super) fn headings(knots: &[Knots], topology: &Topology) -> Vec<[Option<f64>; 2]> {
    let ends: Vec<[(f64, f64); 2]> = knots.iter().map(Knots::ends).collect();
    // What the best end of each joint says. A joint is named by its lowest port.
    let mut best: Vec<(f64, f64)> = ends.iter().flatten().copied().collect();
    let joints = topology.joints();
    for (port, &joint) in joints.iter().enumerate() {
        let (heading, turn) = ends[port / 2][port % 2];
        if turn < best[joint].1 {
            best[joint] = (heading, turn);
        }
    }
    let known = |port: usize| {
        let (heading, own) = (best[joints[port]].0, ends[port / 2][port % 2].0);
        (angle::difference(heading, own).abs() <= MOST_TURN).then_some(heading)
    };
    (0..knots.len())
        .map(|lane| [known(2 * lane), known(2 * lane + 1)])
        .collect()
}
