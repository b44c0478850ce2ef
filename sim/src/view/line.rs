//! Reference lines and lanes as the page draws them, in metres from the page's origin.

use super::thin;
use crate::trace::LaneOutline;
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::reference_line::{LineSample, ReferenceLine};
use corridor_decider::road::{BoundaryType, LaneKind};
use serde::Serialize;

/// Distance between the cross-sections that the page gets, m: the sagitta in a bend of 12 m radius is 1 cm.
const SPACING: f64 = 1.0;

/// One reference line: an array per quantity.
#[derive(Serialize)]
pub(super) struct LineData {
    s: Vec<f64>,
    x: Vec<f64>,
    y: Vec<f64>,
    theta: Vec<f64>,
    /// To the left and right edge of the lane.
    lane: [Vec<f64>; 2],
    /// To the left and right edge of the road surface.
    road: [Vec<f64>; 2],
    marks: Vec<MarkData>,
}

/// A stretch of one kind of line on the ground.
#[derive(Serialize)]
struct MarkData {
    kind: BoundaryType,
    /// `x, y, x, y, …`
    at: Vec<f64>,
}

/// One lane.
#[derive(Serialize)]
pub(super) struct LaneData {
    name: String,
    kind: LaneKind,
    left: Vec<f64>,
    right: Vec<f64>,
}

/// `x, y, x, y, …` relative to `origin`.
pub(super) fn flat(points: impl IntoIterator<Item = Vec2>, origin: Vec2) -> Vec<f64> {
    points
        .into_iter()
        .flat_map(|p| [thin::milli(p.x - origin.x), thin::milli(p.y - origin.y)])
        .collect()
}

impl LaneData {
    pub(super) fn new(lane: &LaneOutline, origin: Vec2) -> Self {
        let edge = |points: &[Vec2]| {
            let kept = thin::keep(points, |_| false);
            flat(
                points.iter().zip(kept).filter(|(_, kept)| *kept).map(|(p, _)| *p),
                origin,
            )
        };
        Self {
            name: lane.name.clone(),
            kind: lane.kind,
            left: edge(&lane.left),
            right: edge(&lane.right),
        }
    }
}

impl LineData {
    pub(super) fn new(line: &ReferenceLine, origin: Vec2) -> Self {
        let samples = spaced(line.samples());
        let column =
            |value: &dyn Fn(&LineSample) -> f64| samples.iter().map(|p| thin::milli(value(p))).collect();
        Self {
            s: column(&|p| p.s),
            x: column(&|p| p.point.x - origin.x),
            y: column(&|p| p.point.y - origin.y),
            theta: samples
                .iter()
                .map(|p| (p.point.theta * 1e5).round() / 1e5)
                .collect(),
            lane: [column(&|p| p.lane_width.0), column(&|p| p.lane_width.1)],
            road: [column(&|p| p.road_width.0), column(&|p| p.road_width.1)],
            marks: marks(line.samples(), origin),
        }
    }
}

/// The samples at least [`SPACING`] apart, with the first and the last.
fn spaced(samples: &[LineSample]) -> Vec<&LineSample> {
    let mut chosen: Vec<&LineSample> = Vec::new();
    for (k, sample) in samples.iter().enumerate() {
        let far = chosen.last().is_none_or(|last| sample.s - last.s >= SPACING);
        if far || k + 1 == samples.len() {
            chosen.push(sample);
        }
    }
    chosen
}

/// The lines painted on both edges of the lane that is followed.
fn marks(samples: &[LineSample], origin: Vec2) -> Vec<MarkData> {
    let side = |kind: fn(&LineSample) -> BoundaryType, offset: fn(&LineSample) -> f64| {
        let runs = samples.chunk_by(move |a, b| kind(a) == kind(b));
        // A run reaches to the first sample of the next one, so that no gap shows between them.
        runs.scan(0, move |start, run| {
            let end = (*start + run.len() + 1).min(samples.len());
            let points: Vec<Vec2> = samples[*start..end]
                .iter()
                .map(|p| beside(p, offset(p)))
                .collect();
            *start += run.len();
            let kept = thin::keep(&points, |_| false);
            let points = points
                .into_iter()
                .zip(kept)
                .filter(|(_, kept)| *kept)
                .map(|(p, _)| p);
            Some(MarkData {
                kind: kind(&run[0]),
                at: flat(points, origin),
            })
        })
    };
    let left = side(|p| p.marks.0, |p| p.lane_width.0);
    let right = side(|p| p.marks.1, |p| -p.lane_width.1);
    left.chain(right).collect()
}

/// The point `l` metres left of a sample.
fn beside(sample: &LineSample, l: f64) -> Vec2 {
    let (sin, cos) = angle::sin_cos(sample.point.theta);
    Vec2::new(sample.point.x - l * sin, sample.point.y + l * cos)
}
