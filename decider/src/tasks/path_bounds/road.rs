//! Limits from the edges of the road (`GetBoundaryFromRoads`).

use super::bound::{BoundPoint, EdgeCause};
use super::edges::{Limit, tighten};
use super::input::Input;
use super::stations::Station;

/// Width of the ego's lane when the map does not tell, m.
const DEFAULT_LANE_WIDTH: f64 = 5.0;

/// Narrows `bound` to the road surface; ends it where the car does not fit. Frame: the reference line.
pub(super) fn limit(bound: &mut Vec<BoundPoint>, stations: &[Station], input: &Input) {
    let half_width = input.vehicle.half_width();
    let lane_width = stations[0]
        .lane
        .map_or(DEFAULT_LANE_WIDTH, |(left, right)| left + right);
    let (mut past_left, mut past_right) = (lane_width / 2.0, lane_width / 2.0);
    for (i, station) in stations.iter().enumerate() {
        if let Some((left, right)) = narrowest(stations, i, input).or(station.road) {
            (past_left, past_right) = (left + station.offset, right - station.offset);
        }
        let edge = |l| Limit {
            l,
            cause: EdgeCause::RoadEdge,
        };
        if !tighten(
            &mut bound[i],
            edge(-past_right + half_width),
            edge(past_left - half_width),
        ) {
            bound.truncate(i);
            break;
        }
    }
    // Carried-on edges are in the frame of the lane's centre line; bounds are in that of the line.
    for (point, station) in bound.iter_mut().zip(stations) {
        point.l_min -= station.offset;
        point.l_max -= station.offset;
    }
}

/// The road's (left, right) width where it is narrowest under the body, when the rear axle is at station `i`.
/// The original looks at the rear axle alone; the front of its car stands out where the road narrows.
fn narrowest(stations: &[Station], i: usize, input: &Input) -> Option<(f64, f64)> {
    if input.config.quirks.road_edge_at_axle {
        return None;
    }
    let s = stations[i].s;
    let (rear, front) = (
        s - input.vehicle.back_edge_to_center,
        s + input.vehicle.front_edge_to_center,
    );
    let behind = stations[..i].iter().rev().take_while(|station| station.s >= rear);
    let ahead = stations[i..].iter().take_while(|station| station.s <= front);
    let widths = behind.chain(ahead).filter_map(|station| station.road);
    widths.reduce(|(left, right), (l, r)| (left.min(l), right.min(r)))
}
