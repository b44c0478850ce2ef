//! What lies on the lanes: areas, signs, lights, and the overlaps that say so.

use super::super::fault::{Fault, Inside};
use super::super::messages;
use super::super::messages::{
    ClearArea, LaneOverlapInfo, ObjectOverlapInfo, Outline, Sign, Signal, SpeedBump,
};
use super::curve::{curves, polygon};
use super::{name, names, optional_number};
use corridor_decider::hd_map::{Area, Overlap, OverlapKind, OverlapObject, StopLines};

/// A junction, a crosswalk or a parking space.
pub(in super::super) fn outline(message: Outline) -> Result<Area, Fault> {
    Ok(Area {
        id: name(message.id)?,
        polygon: polygon(message.polygon.as_ref(), "polygon")?,
        overlaps: names(message.overlap_id, "overlap_id")?,
    })
}

/// An area to keep free.
pub(in super::super) fn clear_area(message: ClearArea) -> Result<Area, Fault> {
    Ok(Area {
        id: name(message.id)?,
        polygon: polygon(message.polygon.as_ref(), "polygon")?,
        overlaps: names(message.overlap_id, "overlap_id")?,
    })
}

/// A traffic light.
pub(in super::super) fn signal(message: Signal) -> Result<StopLines, Fault> {
    Ok(StopLines {
        id: name(message.id)?,
        lines: curves(&message.stop_line, "stop_line")?,
        boundary: polygon(message.boundary.as_ref(), "boundary")?,
        overlaps: names(message.overlap_id, "overlap_id")?,
    })
}

/// A stop sign or a yield sign.
pub(in super::super) fn sign(message: Sign) -> Result<StopLines, Fault> {
    Ok(StopLines {
        id: name(message.id)?,
        lines: curves(&message.stop_line, "stop_line")?,
        boundary: Vec::new(),
        overlaps: names(message.overlap_id, "overlap_id")?,
    })
}

/// A speed bump.
pub(in super::super) fn speed_bump(message: SpeedBump) -> Result<StopLines, Fault> {
    Ok(StopLines {
        id: name(message.id)?,
        lines: curves(&message.position, "position")?,
        boundary: Vec::new(),
        overlaps: names(message.overlap_id, "overlap_id")?,
    })
}

/// Things that lie on each other.
pub(in super::super) fn overlap(message: messages::Overlap) -> Result<Overlap, Fault> {
    let each = |(nth, message)| object(message).inside_nth("object", nth);
    Ok(Overlap {
        id: name(message.id)?,
        objects: message
            .object
            .into_iter()
            .enumerate()
            .map(each)
            .collect::<Result<_, _>>()?,
    })
}

fn object(message: ObjectOverlapInfo) -> Result<OverlapObject, Fault> {
    let lane = message.lane_overlap_info.as_ref().map(lane_kind).transpose();
    let kinds = [
        (message.signal_overlap_info, OverlapKind::Signal),
        (message.stop_sign_overlap_info, OverlapKind::StopSign),
        (message.crosswalk_overlap_info, OverlapKind::Crosswalk),
        (message.junction_overlap_info, OverlapKind::Junction),
        (message.yield_sign_overlap_info, OverlapKind::YieldSign),
        (message.clear_area_overlap_info, OverlapKind::ClearArea),
        (message.speed_bump_overlap_info, OverlapKind::SpeedBump),
        (message.parking_space_overlap_info, OverlapKind::ParkingSpace),
        (message.pnc_junction_overlap_info, OverlapKind::PncJunction),
        (message.rsu_overlap_info, OverlapKind::Other),
        (message.area_overlap_info, OverlapKind::Other),
        (message.barrier_gate_overlap_info, OverlapKind::Other),
    ];
    let other = kinds
        .into_iter()
        .find(|(info, _)| info.is_some())
        .map(|(_, kind)| kind);
    Ok(OverlapObject {
        id: name(message.id)?,
        kind: lane.inside("lane_overlap_info")?.or(other),
    })
}

fn lane_kind(info: &LaneOverlapInfo) -> Result<OverlapKind, Fault> {
    Ok(OverlapKind::Lane {
        start_s: optional_number(info.start_s, "start_s")?.unwrap_or(0.0),
        end_s: optional_number(info.end_s, "end_s")?.unwrap_or(0.0),
        is_merge: info.is_merge.unwrap_or(false),
    })
}
