//! Where an obstacle of a file is: from "30 m ahead, half a metre from the kerb" to a pose.

use crate::route::Road;
use crate::schema::obstacle::{Common, Datum, LaneChoice};
use crate::validity::Rejection;
use corridor_decider::frame::ObstacleKind;
use corridor_decider::geometry::{ConvexPolygon, Pose, angle};
use corridor_decider::reference_line::{LineQuery, LineSample, SlPoint};
use corridor_decider::road::{Neighbour, Side};
use std::f64::consts::PI;

use super::sampler::Table;

/// A place beside the route's line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    /// Station along the route's line, m.
    pub(crate) s: f64,
    /// Lateral offset from it, m.
    pub(crate) l: f64,
    /// Heading relative to it, rad.
    pub(crate) heading: f64,
}

impl Spot {
    /// The pose there.
    pub(crate) fn pose(self, road: &Road) -> Pose {
        let at = road.line.to_cartesian(SlPoint { s: self.s, l: self.l });
        Pose::new(
            at.x,
            at.y,
            angle::wrap(road.line.point(self.s).theta + self.heading),
        )
    }
}

/// Length and width of a class, m.
fn usual_size(kind: ObstacleKind) -> (f64, f64) {
    match kind {
        ObstacleKind::Car => (4.6, 1.85),
        ObstacleKind::Truck => (10.0, 2.5),
        ObstacleKind::Bicycle => (1.8, 0.6),
        ObstacleKind::Pedestrian => (0.6, 0.6),
        ObstacleKind::Cone => (0.4, 0.4),
        ObstacleKind::Other => (1.0, 1.0),
    }
}

/// The outline of an obstacle around its centre.
pub(crate) fn shape(common: &Common<'_>, kind: ObstacleKind, numbers: &Table<'_>) -> ConvexPolygon {
    if let Some(outline) = common.polygon {
        return outline.0.clone();
    }
    let (length, width) = usual_size(kind);
    let length = numbers.number_or("length", common.length, length);
    let width = numbers.number_or("width", common.width, width);
    ConvexPolygon::rectangle(Pose::new(0.0, 0.0, 0.0), length / 2.0, length / 2.0, width / 2.0)
}

/// How far `shape`, turned by `heading`, reaches from its centre: `(lowest, highest)` along the line and across it.
pub(crate) fn extent(shape: &ConvexPolygon, heading: f64) -> [(f64, f64); 2] {
    let turned = shape.at(Pose::new(0.0, 0.0, heading));
    [0, 1].map(|axis| {
        let along = turned.vertices().iter().map(|v| v[axis]);
        along.fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), high.max(v)))
    })
}

/// The right and left edge of a lane beside the route at one station, m from the line.
pub(super) fn lane_edges(sample: &LineSample, lane: LaneChoice) -> Option<(f64, f64)> {
    let (left, right) = sample.lane_width;
    let width = |side, reverse| sample.neighbours[Neighbour { side, reverse }.index()];
    match lane {
        LaneChoice::Own => Some((-right, left)),
        LaneChoice::Left => width(Side::Left, false).map(|w| (left, left + w)),
        LaneChoice::Oncoming => width(Side::Left, true).map(|w| (left, left + w)),
        LaneChoice::Right => width(Side::Right, false).map(|w| (-right - w, -right)),
    }
}

/// Where the file puts an obstacle: `s` along the line, the rest from its own keys.
///
/// # Errors
/// [`Rejection`] where the line or the lane is not there.
pub(crate) fn spot(
    road: &Road,
    name: &str,
    common: &Common<'_>,
    shape: &ConvexPolygon,
    s: f64,
    heading: f64,
    numbers: &Table<'_>,
) -> Result<Spot, Rejection> {
    let off_map = || Rejection::OffMap {
        obstacle: name.to_owned(),
        s,
    };
    let (road_left, road_right) = road.line.road_width(s).ok_or_else(off_map)?;
    let sample = road.line.sample_at(s);
    let (right, left) = lane_edges(sample, common.lane).ok_or_else(|| Rejection::NoLane {
        obstacle: name.to_owned(),
        lane: common.lane,
        s,
    })?;
    let heading = match common.lane {
        LaneChoice::Oncoming => angle::wrap(heading + PI),
        _ => heading,
    };
    let [_, (lowest, highest)] = extent(shape, heading);
    let value = numbers.number_or("l", common.l, 0.0);
    let l = match common.from {
        Datum::Centre => f64::midpoint(right, left) + value,
        Datum::RightEdge => value - road_right - lowest,
        Datum::LeftEdge => road_left - value - highest,
        Datum::RightLaneLine => right + value - highest,
        Datum::LeftLaneLine => left - value - lowest,
    };
    Ok(Spot { s, l, heading })
}
