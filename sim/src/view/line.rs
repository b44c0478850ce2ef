//! Reference lines as the page draws them, in metres from the page's origin.

use super::thin;
use corridor_decider::geometry::Vec2;
use corridor_decider::reference_line::{LineSample, ReferenceLine};
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
}

/// `x, y, x, y, …` relative to `origin`.
pub(super) fn flat(points: impl IntoIterator<Item = Vec2>, origin: Vec2) -> Vec<f64> {
    points
        .into_iter()
        .flat_map(|p| [thin::milli(p.x - origin.x), thin::milli(p.y - origin.y)])
        .collect()
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
