//! A uniform grid over the lanes: which stretches of which lanes are near a point.

use super::lane::{Lane, LaneId, LanePoint};
use crate::geometry::{ConvexPolygon, Vec2, cross};
use std::collections::BTreeMap;

/// Edge length of a grid cell, m: about two lane widths, so that a query touches few cells and a cell
/// holds few stretches.
const CELL: f64 = 8.0;

/// How far off the road a point may be before the distance is only a lower bound, m.
const SEARCH_LIMIT: f64 = 4.0 * CELL;

/// One stretch between two neighbouring cross-sections of a lane.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    lane: u32,
    point: u32,
}

/// Grid cells and the stretches whose bounding boxes touch them.
#[derive(Clone, Debug)]
pub(super) struct LaneIndex {
    cells: BTreeMap<(i32, i32), Vec<Stretch>>,
}

impl LaneIndex {
    pub(super) fn new(lanes: &[Lane]) -> Self {
        let mut cells: BTreeMap<(i32, i32), Vec<Stretch>> = BTreeMap::new();
        for (lane, content) in (0u32..).zip(lanes) {
            if !content.kind.is_road_surface() {
                continue;
            }
            for (point, pair) in (0u32..).zip(content.points.windows(2)) {
                let corners = corners(&pair[0], &pair[1]);
                let (low, high) = corners.iter().fold((corners[0], corners[0]), |(low, high), c| {
                    (low.inf(c), high.sup(c))
                });
                for cell in cells_between(low, high) {
                    cells.entry(cell).or_default().push(Stretch { lane, point });
                }
            }
        }
        Self { cells }
    }

    /// Distance from `point` to the union of all road surfaces, at most [`SEARCH_LIMIT`].
    pub(super) fn distance_off_road(&self, lanes: &[Lane], point: Vec2) -> f64 {
        let mut best = SEARCH_LIMIT;
        let mut radius = 0.0;
        // Widen ring by ring: nearly every query ends in the first, on the road.
        while radius < SEARCH_LIMIT && best > radius {
            radius = if radius == 0.0 { 0.5 } else { radius * 4.0 };
            for stretch in self.near(point, radius) {
                let points = &lanes[stretch.lane as usize].points;
                let (a, b) = (
                    &points[stretch.point as usize],
                    &points[stretch.point as usize + 1],
                );
                let distance = distance_to_quad(&corners(a, b), point);
                if distance <= 0.0 {
                    return 0.0;
                }
                best = best.min(distance);
            }
        }
        best
    }

    /// The lane whose centre line is nearest to `point`, among drivable ones that `agrees` accepts.
    pub(super) fn nearest_lane(
        &self,
        lanes: &[Lane],
        point: Vec2,
        radius: f64,
        agrees: impl Fn(&LanePoint) -> bool,
    ) -> Option<(LaneId, f64, f64)> {
        let mut best: Option<(f64, LaneId, f64, f64)> = None;
        for stretch in self.near(point, radius) {
            let lane = &lanes[stretch.lane as usize];
            let (a, b) = (
                &lane.points[stretch.point as usize],
                &lane.points[stretch.point as usize + 1],
            );
            if !lane.kind.is_drivable() || !agrees(a) {
                continue;
            }
            let (t, l) = project(a, b, point);
            let foot = Vec2::new(a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t);
            let distance = (point - foot).norm();
            let id = LaneId(stretch.lane);
            let closer = best.is_none_or(|(d, other, ..)| distance < d || (distance <= d && id < other));
            if distance <= radius && closer {
                best = Some((distance, id, a.s + (b.s - a.s) * t, l));
            }
        }
        best.map(|(_, id, s, l)| (id, s, l))
    }

    fn near(&self, point: Vec2, radius: f64) -> impl Iterator<Item = Stretch> + '_ {
        let reach = Vec2::repeat(radius);
        cells_between(point - reach, point + reach)
            .filter_map(|cell| self.cells.get(&cell))
            .flatten()
            .copied()
    }
}

/// Corners of the surface between two cross-sections, counter-clockwise.
fn corners(a: &LanePoint, b: &LanePoint) -> [Vec2; 4] {
    [
        a.offset(-a.right),
        b.offset(-b.right),
        b.offset(b.left),
        a.offset(a.left),
    ]
}

fn cells_between(low: Vec2, high: Vec2) -> impl Iterator<Item = (i32, i32)> {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "saturates; maps are far smaller than 2^31 cells"
    )]
    let cell = |v: f64| (v / CELL).floor() as i32;
    let (x0, x1, y0, y1) = (cell(low.x), cell(high.x), cell(low.y), cell(high.y));
    (x0..=x1).flat_map(move |x| (y0..=y1).map(move |y| (x, y)))
}

/// Foot of `point` on the chord `a`–`b` as a fraction in `[0, 1]`, and its offset to the left.
fn project(a: &LanePoint, b: &LanePoint, point: Vec2) -> (f64, f64) {
    let along = Vec2::new(b.x - a.x, b.y - a.y);
    let from = Vec2::new(point.x - a.x, point.y - a.y);
    let length_squared = along.norm_squared();
    if length_squared <= 0.0 {
        return (0.0, from.norm());
    }
    let t = (from.dot(&along) / length_squared).clamp(0.0, 1.0);
    (t, cross(along, from) / length_squared.sqrt())
}

/// Distance from `point` to a quadrilateral, 0 inside. A degenerate one counts as its hull or nothing.
fn distance_to_quad(corners: &[Vec2; 4], point: Vec2) -> f64 {
    ConvexPolygon::hull(corners).map_or(f64::MAX, |quad| quad.distance_to_point(point))
}
