//! From metres of a map to whole centimetres on paper: outlines with few points, and arrows along lanes.

use crate::view::thin;
use corridor_decider::geometry::Vec2;
use corridor_decider::road::{Lane, LanePoint};
use std::fmt::Write as _;

/// Most that a line may move when points are left out, m: less than a painted line is wide.
const TOLERANCE: f64 = 0.03;

/// Length of an arrow, m, in a lane that is wide enough.
const ARROW: f64 = 2.4;

/// Part of a lane's width that an arrow is long at most.
const OF_WIDTH: f64 = 0.7;

/// Distance between the arrows of a lane, m.
const BETWEEN_ARROWS: f64 = 20.0;

/// Shortest arrow that is drawn, m: lanes that open or close have none where they are narrow.
const SHORTEST_ARROW: f64 = 0.5;

/// Share of the map's size that is left empty around it.
const MARGIN: f64 = 0.02;

/// Height of the legend as a share of the map's size.
const LEGEND: f64 = 0.05;

/// The sheet that a map is drawn on.
pub(super) struct Paper {
    low: Vec2,
    high: Vec2,
    /// Length of the map's diagonal, m, or of the least one to draw.
    size: f64,
}

impl Paper {
    pub(super) fn new(low: Vec2, high: Vec2, size: f64) -> Self {
        Self { low, high, size }
    }

    /// The corner that the drawing is measured from, in the map's frame.
    pub(super) fn low(&self) -> Vec2 {
        self.low
    }

    /// What lengths are in proportion to, cm.
    pub(super) fn size(&self) -> f64 {
        self.size * 100.0
    }

    /// The lower edge of the map on paper, cm.
    pub(super) fn bottom(&self) -> f64 {
        (self.high.y - self.low.y) * 100.0
    }

    /// The first tag and the ground, with room for a legend of this length, cm.
    pub(super) fn opening(&self, name: &str, legend_width: f64) -> String {
        let margin = self.size() * MARGIN;
        let width = ((self.high.x - self.low.x) * 100.0).max(legend_width);
        let (width, height) = (
            width + 2.0 * margin,
            self.bottom() + self.size() * LEGEND + 2.0 * margin,
        );
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{x:.0} {x:.0} {width:.0} {height:.0}\">\n\
             <title>{}</title>\n<rect x=\"{x:.0}\" y=\"{x:.0}\" width=\"{width:.0}\" height=\"{height:.0}\" \
             fill=\"#f3f4f1\"/>\n",
            super::legend::escaped(name),
            x = -margin,
        )
    }

    /// A place of the map on paper, cm to the right and down.
    fn place(&self, point: Vec2) -> (i64, i64) {
        #[expect(clippy::cast_possible_truncation, reason = "no map is as large")]
        let cm = |metres: f64| (metres * 100.0).round() as i64;
        (cm(point.x - self.low.x), cm(self.high.y - point.y))
    }

    /// The places of a line that are needed to draw it.
    pub(super) fn thinned(&self, line: &[Vec2]) -> Vec<(i64, i64)> {
        let kept = thin::keep_within(line, TOLERANCE, |_| false);
        let kept = line.iter().zip(kept).filter(|(_, kept)| *kept);
        kept.map(|(point, _)| self.place(*point)).collect()
    }
}

/// A line as path data: the first place, then steps.
pub(super) fn data(places: &[(i64, i64)]) -> String {
    let Some((first, rest)) = places.split_first() else {
        return String::new();
    };
    let mut data = format!("M{} {}l", first.0, first.1);
    let mut last = *first;
    for place in rest {
        let step = (place.0 - last.0, place.1 - last.1);
        if step != (0, 0) {
            let _ = write!(data, "{} {} ", step.0, step.1);
        }
        last = *place;
    }
    // A line of one place goes nowhere, but is a line.
    if data.ends_with('l') {
        data + "0 0"
    } else {
        data.trim_end().to_owned()
    }
}

/// Arrow heads along the middle of a lane, in driving direction.
pub(super) fn arrows(lane: &Lane, paper: &Paper) -> String {
    let length = lane.length();
    let count = (length / BETWEEN_ARROWS).ceil().max(1.0);
    let mut data = String::new();
    let mut k = 0.5;
    while k < count {
        data += &arrow(&lane.at(length * k / count), length, paper);
        k += 1.0;
    }
    data
}

fn arrow(at: &LanePoint, lane_length: f64, paper: &Paper) -> String {
    let length = ARROW.min(OF_WIDTH * (at.left + at.right)).min(lane_length / 2.0);
    if length < SHORTEST_ARROW {
        return String::new();
    }
    // The middle of the surface, which need not be the centre line.
    let middle = at.offset((at.left - at.right) / 2.0);
    let left = at.offset(1.0) - at.offset(0.0);
    let ahead = Vec2::new(left.y, -left.x);
    let corners = [
        middle + ahead * (length / 2.0),
        middle - ahead * (length / 2.0) + left * (length / 4.0),
        middle - ahead * (length / 4.0),
        middle - ahead * (length / 2.0) - left * (length / 4.0),
    ];
    data(&corners.map(|corner| paper.place(corner))) + "z"
}
