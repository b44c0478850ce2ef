//! Boxes beside a line: their extent in its frame, and whether they are on its lane or in its way.
//!
//! Metres; `l` to the left. Source: the original's `modules/planning/reference_line/reference_line.cc`.

use super::lane::HalfWidths;
use super::path::Path;
use super::shape::polygon_to_piece;
use crate::geometry::{ConvexPolygon, Vec2, cross};
use crate::reference_line::SlPoint;

/// How much further than asked a box may be and still block, m: rounding.
const TOUCH: f64 = 1e-10;

/// The extent of something in the frame of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlBox {
    /// First station.
    pub start_s: f64,
    /// Last station.
    pub end_s: f64,
    /// Right edge.
    pub start_l: f64,
    /// Left edge.
    pub end_l: f64,
}

impl SlBox {
    fn around(points: &[SlPoint]) -> Self {
        let least = |value: fn(&SlPoint) -> f64| points.iter().map(value).fold(f64::INFINITY, f64::min);
        let greatest =
            |value: fn(&SlPoint) -> f64| points.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
        Self {
            start_s: least(|p| p.s),
            end_s: greatest(|p| p.s),
            start_l: least(|p| p.l),
            end_l: greatest(|p| p.l),
        }
    }

    fn middle(&self) -> f64 {
        self.start_s.midpoint(self.end_s)
    }
}

impl Path {
    /// The outline of a convex body in the frame of the line: its corners in their order, and between two of them the
    /// middle of the edge where that bulges out.
    pub fn sl_outline(&self, body: &ConvexPolygon) -> Vec<SlPoint> {
        let to_sl = |point: Vec2| {
            let at = self.project(point);
            SlPoint { s: at.s, l: at.l }
        };
        let mut outline = Vec::new();
        for (from, to) in body.edges() {
            let (a, b, middle) = (to_sl(from), to_sl(to), to_sl((from + to) * 0.5));
            outline.push(a);
            let d = |p: SlPoint| Vec2::new(p.s - a.s, p.l - a.l);
            if cross(d(b), d(middle)) < 0.0 {
                outline.push(middle);
            }
        }
        outline
    }

    /// The extent of a convex body in the frame of the line.
    pub fn sl_box(&self, body: &ConvexPolygon) -> SlBox {
        SlBox::around(&self.sl_outline(body))
    }

    /// Whether a place lies on the line's lane, behind its start.
    pub fn is_on_lane(&self, at: SlPoint) -> bool {
        at.s > 0.0
            && self
                .lane_width_at(at.s)
                .is_some_and(|widths| within(at.l, widths))
    }

    /// Whether a place lies on the line's road, behind its start.
    pub fn is_on_road(&self, at: SlPoint) -> bool {
        at.s > 0.0
            && self
                .road_width_at(at.s)
                .is_some_and(|widths| within(at.l, widths))
    }

    /// Whether a box touches the line's lane, judged at the middle of its stations.
    pub fn is_box_on_lane(&self, at: &SlBox) -> bool {
        self.touches(at, self.lane_width_at(at.middle()))
    }

    /// Whether a box touches the line's road, judged at the middle of its stations.
    pub fn is_box_on_road(&self, at: &SlBox) -> bool {
        self.touches(at, self.road_width_at(at.middle()))
    }

    /// Where the map knows no width, the line itself is taken for the lane.
    fn touches(&self, at: &SlBox, widths: Option<HalfWidths>) -> bool {
        let (left, right) = widths.unwrap_or_default();
        self.is_beside(at) && at.start_l <= left && at.end_l >= -right
    }

    fn is_beside(&self, at: &SlBox) -> bool {
        at.end_s >= 0.0 && at.start_s <= self.length()
    }

    /// The wider of the two gaps that a box leaves on the line's lane, m; negative where it blocks both.
    pub fn driving_width(&self, at: &SlBox) -> f64 {
        let (left, right) = self.lane_width_at(at.start_s).unwrap_or_default();
        (left + right).min((left - at.end_l).max(right + at.start_l))
    }

    /// Whether a body comes nearer to the line than `gap`.
    pub fn is_blocked_by(&self, body: &ConvexPolygon, gap: f64) -> bool {
        let pieces = self.line.points().windows(2);
        pieces
            .into_iter()
            .any(|piece| polygon_to_piece(body, piece[0], piece[1]) <= gap + TOUCH)
    }

    /// Whether a body reaches into the line's lane, judged at the middle of its stations.
    pub fn has_overlap(&self, body: &ConvexPolygon) -> bool {
        let at = self.sl_box(body);
        let straddles = at.start_l * at.end_l < 0.0;
        let Some((left, right)) = self.lane_width_at(at.middle()).filter(|_| self.is_beside(&at)) else {
            return false;
        };
        if straddles {
            !self.quirks.straddling_is_clear
        } else if at.start_l > 0.0 {
            at.start_l < left
        } else {
            at.end_l > -right
        }
    }
}

fn within(l: f64, (left, right): HalfWidths) -> bool {
    -right <= l && l <= left
}
