//! The zone in which a change of lane may not start yet (`GetLaneChangeForbiddenZone`).

use super::bound::{BoundPoint, EdgeCause};
use super::input::{ChangeLane, Input};
use super::stations::Station;
use crate::reference_line::{LineQuery, SlPoint};

/// How far around the ego the zone leaves room, m.
const EGO_SLACK: f64 = 0.1;

/// Station up to which the ego keeps out of the target lane; `None` where the change may start at once.
pub(super) fn zone_end<L: LineQuery + ?Sized>(
    line: &L,
    input: &Input,
    state: &mut ChangeLane,
) -> Option<f64> {
    if state.is_clear {
        state.start = None;
        return None;
    }
    let end = if let Some(start) = state.start {
        line.to_frenet(start).s
    } else {
        let s = input.ego.s + input.config.lane_change_prepare_length;
        state.start = Some(line.to_cartesian(SlPoint { s, l: 0.0 }));
        s
    };
    (end >= input.ego.s).then_some(end)
}

/// Keeps the ego out of the target lane up to the station `end`.
pub(super) fn keep_out(bound: &mut [BoundPoint], stations: &[Station], input: &Input, end: f64) {
    let half_width = input.vehicle.half_width();
    let ego_l = input.ego.l;
    for (point, station) in bound
        .iter_mut()
        .zip(stations)
        .take_while(|(point, _)| point.s <= end)
    {
        let (left, right) = match station.lane {
            // The original goes through the lane's frame and back.
            Some((left, right)) => (
                (left + station.offset) - station.offset,
                (right - station.offset) + station.offset,
            ),
            None if input.config.quirks.zone_without_lane => (-station.offset, station.offset),
            None => continue,
        };
        let right_limit = if ego_l > left {
            left + half_width
        } else {
            point.l_min
        };
        let left_limit = if ego_l < -right {
            -right - half_width
        } else {
            point.l_max
        };
        place(
            &mut point.l_min,
            &mut point.right,
            right_limit.min(ego_l - EGO_SLACK),
            ego_l > left,
        );
        place(
            &mut point.l_max,
            &mut point.left,
            left_limit.max(ego_l + EGO_SLACK),
            ego_l < -right,
        );
    }
}

/// Replaces a limit and notes the zone as its cause where it ruled.
fn place(l: &mut f64, cause: &mut EdgeCause, value: f64, is_zone: bool) {
    if is_zone {
        *cause = EdgeCause::LaneChangeZone;
    } else if (value - *l).abs() > 0.0 {
        *cause = EdgeCause::Ego;
    }
    *l = value;
}
