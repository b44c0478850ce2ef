//! Lanes.

use super::super::fault::{Fault, Inside};
use super::super::messages::{Lane, LaneBoundary, LaneSample};
use super::curve::curve;
use super::{choice, name, names, number, optional_name, optional_number};
use corridor_decider::geometry::Vec2;
use corridor_decider::hd_map::{BoundaryData, Direction, HdLaneKind, LaneData, Turn};
use corridor_decider::road::BoundaryType;

const KINDS: [(i32, HdLaneKind); 7] = [
    (1, HdLaneKind::None),
    (2, HdLaneKind::CityDriving),
    (3, HdLaneKind::Biking),
    (4, HdLaneKind::Sidewalk),
    (5, HdLaneKind::Parking),
    (6, HdLaneKind::Shoulder),
    (7, HdLaneKind::Shared),
];
const TURNS: [(i32, Turn); 4] = [
    (1, Turn::NoTurn),
    (2, Turn::LeftTurn),
    (3, Turn::RightTurn),
    (4, Turn::UTurn),
];
const DIRECTIONS: [(i32, Direction); 3] = [
    (1, Direction::Forward),
    (2, Direction::Backward),
    (3, Direction::Bidirection),
];
const LINES: [(i32, BoundaryType); 7] = [
    (0, BoundaryType::Unknown),
    (1, BoundaryType::DottedYellow),
    (2, BoundaryType::DottedWhite),
    (3, BoundaryType::SolidYellow),
    (4, BoundaryType::SolidWhite),
    (5, BoundaryType::DoubleYellow),
    (6, BoundaryType::Curb),
];

/// How far a lane's named length may be off that of its points, m and as a share. Real files are off by 0.13 m.
const LENGTH_TOLERANCE: (f64, f64) = (1.0, 0.05);

/// A lane that can be drawn: with a name, at least two points, and the length it says it has.
pub(in super::super) fn lane(lane: Lane) -> Result<LaneData, Fault> {
    let points = curve(lane.central_curve.as_ref()).inside("central_curve")?;
    if points.len() < 2 {
        let problem = format!("has {} points", points.len());
        return Err(Fault::new(problem, "at least 2")).inside("central_curve");
    }
    Ok(LaneData {
        id: name(lane.id)?,
        length: length(lane.length, &points).inside("length")?,
        points,
        speed_limit: optional_number(lane.speed_limit, "speed_limit")?,
        kind: choice(lane.r#type, &KINDS).inside("type")?,
        turn: choice(lane.turn, &TURNS).inside("turn")?,
        direction: choice(lane.direction, &DIRECTIONS).inside("direction")?,
        left_boundary: boundary(lane.left_boundary).inside("left_boundary")?,
        right_boundary: boundary(lane.right_boundary).inside("right_boundary")?,
        overlaps: names(lane.overlap_id, "overlap_id")?,
        predecessors: names(lane.predecessor_id, "predecessor_id")?,
        successors: names(lane.successor_id, "successor_id")?,
        // In the order of `Neighbour::ALL`.
        neighbours: [
            names(
                lane.left_neighbor_forward_lane_id,
                "left_neighbor_forward_lane_id",
            )?,
            names(
                lane.left_neighbor_reverse_lane_id,
                "left_neighbor_reverse_lane_id",
            )?,
            names(
                lane.right_neighbor_forward_lane_id,
                "right_neighbor_forward_lane_id",
            )?,
            names(
                lane.right_neighbor_reverse_lane_id,
                "right_neighbor_reverse_lane_id",
            )?,
        ],
        junction: optional_name(lane.junction_id),
        left_samples: samples(&lane.left_sample, "left_sample")?,
        right_samples: samples(&lane.right_sample, "right_sample")?,
        left_road_samples: samples(&lane.left_road_sample, "left_road_sample")?,
        right_road_samples: samples(&lane.right_road_sample, "right_road_sample")?,
    })
}

/// The length that a lane names, held against its points; theirs when it names none.
fn length(named: Option<f64>, points: &[Vec2]) -> Result<f64, Fault> {
    let drawn: f64 = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
    let Some(named) = named else {
        return Ok(drawn);
    };
    let (metres, share) = LENGTH_TOLERANCE;
    if (named - drawn).abs() <= metres + share * drawn {
        return Ok(named);
    }
    Err(Fault::new(
        format!("is {named}, but the points of `central_curve` are {drawn:.2} m long"),
        "the length of the points; files of an older schema are not read",
    ))
}

/// An edge; nothing known of it where there is none.
fn boundary(message: Option<LaneBoundary>) -> Result<BoundaryData, Fault> {
    let Some(message) = message else {
        return Ok(BoundaryData::default());
    };
    let mut types = Vec::with_capacity(message.boundary_type.len());
    for (nth, record) in message.boundary_type.iter().enumerate() {
        let s = optional_number(record.s, "s").inside_nth("boundary_type", nth)?;
        let lines = record.types.iter().enumerate();
        let lines: Result<Vec<_>, Fault> = lines
            .map(|(k, line)| {
                let line = choice(Some(*line), &LINES).inside_nth("types", k);
                line.inside_nth("boundary_type", nth)
            })
            .collect();
        types.push((s.unwrap_or(0.0), lines?));
    }
    types.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(BoundaryData {
        points: curve(message.curve.as_ref()).inside("curve")?,
        is_virtual: message.r#virtual.unwrap_or(false),
        types,
    })
}

/// Half widths by ascending station.
fn samples(messages: &[LaneSample], field: &'static str) -> Result<Vec<(f64, f64)>, Fault> {
    let sample = |message: &LaneSample| {
        let (s, width) = (number(message.s, "s")?, number(message.width, "width")?);
        if width < 0.0 {
            return Err(Fault::new(format!("is {width}"), "a width of 0 or more")).inside("width");
        }
        Ok((s, width))
    };
    let each = |(nth, message)| sample(message).inside_nth(field, nth);
    let mut samples: Vec<_> = messages.iter().enumerate().map(each).collect::<Result<_, _>>()?;
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(samples)
}
