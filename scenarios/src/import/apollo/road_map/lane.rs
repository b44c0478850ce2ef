//! One lane: cross-sections along its curve, and what is painted on its edges.

use super::budget::Budget;
use super::curve::{Curve, CurvePoint};
use super::warnings::Warnings;
use super::widths::{Widths, linear};
use crate::import::ImportError;
use corridor_decider::geometry::angle;
use corridor_decider::hd_map::{BoundaryData, Direction, LaneData};
use corridor_decider::road::{BoundaryType, Lane, LaneKind, LanePoint, Mark, Side};

/// Largest distance of cross-sections, m.
const SPACING: f64 = 0.5;

/// Largest turn between cross-sections, rad.
const TURN: f64 = 0.05;

/// Cross-sections are not closer than this, m, however sharp a bend is.
const LEAST_SPACING: f64 = 0.05;

/// A lane with its cross-sections, not yet linked to others. Its road edges are those of the file's road samples, or
/// its own where there are none.
pub(super) fn lane(
    data: &LaneData,
    kind: LaneKind,
    curve: &Curve,
    budget: &mut Budget,
    warnings: &mut Warnings,
) -> Result<Lane, ImportError> {
    if data.direction == Direction::Backward {
        let what = "a lane that is driven against its points is taken as it is drawn";
        warnings.add(what, || format!("lane `{}`", data.id));
    }
    let widths = Widths::new(data, warnings);
    let mut points = Vec::new();
    // Stations of the file count to the length that it names.
    let drawn = curve.drawn_length();
    let named = if data.length > 0.0 { data.length } else { drawn };
    for (mut at, step) in places(data, curve, budget)? {
        at.station *= named / drawn;
        let point = cross_section(data, &at, &widths);
        budget.stretch(point.left + point.right + step, &data.id)?;
        budget.comparisons(widths.comparisons(), &data.id)?;
        points.push(point);
    }
    measure(&mut points);
    let scale = points[points.len() - 1].s / named;
    Ok(Lane {
        name: data.id.clone(),
        kind,
        road: String::new(),
        junction: None,
        points,
        left_marks: marks(&data.left_boundary, scale),
        right_marks: marks(&data.right_boundary, scale),
        neighbours: [None; 4],
        predecessors: Vec::new(),
        successors: Vec::new(),
    })
}

/// The lane at a place; its station is filled in later.
fn cross_section(data: &LaneData, at: &CurvePoint, widths: &Widths<'_>) -> LanePoint {
    let [left, right] = [Side::Left, Side::Right].map(|side| widths.to_edge(side, at));
    let to_road = |samples: &[(f64, f64)]| linear(samples, at.station).unwrap_or(0.0);
    LanePoint {
        s: 0.0,
        x: at.position.x,
        y: at.position.y,
        theta: at.theta,
        kappa: at.kappa,
        left,
        right,
        road_left: to_road(&data.left_road_samples).max(left),
        road_right: to_road(&data.right_road_samples).max(right),
        // Bike lanes have a limit of 0, which is none.
        speed_limit: data
            .speed_limit
            .filter(|limit| *limit > 0.0)
            .unwrap_or(f64::INFINITY),
    }
}

/// Places along a curve, each with the distance from the one before.
fn places(
    data: &LaneData,
    curve: &Curve,
    budget: &mut Budget,
) -> Result<Vec<(CurvePoint, f64)>, ImportError> {
    let mut places = vec![(curve.pieces[0].at(0.0), 0.0)];
    for piece in &curve.pieces {
        let step = (TURN / piece.sharpest).clamp(LEAST_SPACING, SPACING);
        let count = (piece.length / step).ceil().max(1.0);
        // Before they take any memory.
        budget.cross_sections(count, &data.id)?;
        let mut k = 1.0;
        while k <= count {
            places.push((piece.at(k / count), piece.length / count));
            k += 1.0;
        }
    }
    Ok(places)
}

/// Fills in the stations by arc length.
fn measure(points: &mut [LanePoint]) {
    for k in 1..points.len() {
        let (before, at) = (points[k - 1], points[k]);
        let chord = libm::hypot(at.x - before.x, at.y - before.y);
        let turn = angle::difference(at.theta, before.theta);
        points[k].s = before.s + chord * (1.0 + turn * turn / 24.0);
    }
}

/// The lines on an edge. Its stations are those of the file; `scale` makes them the lane's.
fn marks(boundary: &BoundaryData, scale: f64) -> Vec<Mark> {
    let mark = |(s, lines): &(f64, Vec<BoundaryType>)| Mark {
        s: s * scale,
        // Nothing is painted on a virtual edge.
        kind: match lines.first() {
            Some(line) if !boundary.is_virtual => *line,
            _ => BoundaryType::Unknown,
        },
    };
    boundary.types.iter().map(mark).collect()
}
