//! A uniform grid over the lanes: which stretches of which lanes are near a point.
//!
//! World frame, metres. The road surface is the union of the convex hulls of the stretches between
//! neighbouring cross-sections; distances to it are exact up to [`SEARCH_LIMIT`] and take no memory.

use super::lane::{Lane, LaneId, LanePoint};
use crate::geometry::{Vec2, cross};
use std::collections::BTreeMap;

/// Edge length of a grid cell, m: about two lane widths, so that a query touches few cells and a cell
/// holds few stretches.
const CELL: f64 = 8.0;

/// How far off the road a point may be before the distance is only a lower bound, m.
const SEARCH_LIMIT: f64 = 4.0 * CELL;

/// Half the side of the first square searched off the road, m: a corner that sticks out a little ends there, in
/// one to four cells.
const FIRST_RADIUS: f64 = 0.5;

/// How much wider each next square is: from 0.5 m to the limit in four steps.
const WIDENING: f64 = 4.0;

/// Twice the area below which three corners span nothing, m²: a lane that starts with width zero.
const NO_AREA: f64 = 1e-9;

/// One stretch between two neighbouring cross-sections of a lane, with its corners.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    lane: u32,
    point: u32,
    /// Right of the first section, right of the second, left of the second, left of the first.
    corners: [Vec2; 4],
    /// Lower left and upper right corner of the box around them.
    low: Vec2,
    high: Vec2,
}

impl Stretch {
    fn new(lane: u32, point: u32, corners: [Vec2; 4]) -> Self {
        let [first, rest @ ..] = &corners;
        Self {
            lane,
            point,
            low: rest.iter().fold(*first, |low, c| low.inf(c)),
            high: rest.iter().fold(*first, |high, c| high.sup(c)),
            corners,
        }
    }

    /// Squared distance from `point` to the box: a lower bound of the distance to the stretch, almost for free.
    fn box_distance_squared(&self, point: Vec2) -> f64 {
        let x = (self.low.x - point.x).max(point.x - self.high.x).max(0.0);
        let y = (self.low.y - point.y).max(point.y - self.high.y).max(0.0);
        x * x + y * y
    }

    fn contains(&self, point: Vec2) -> bool {
        self.box_distance_squared(point) <= 0.0 && distance_to_hull(&self.corners, point) <= 0.0
    }
}

/// Grid cells and the stretches whose bounding boxes touch them.
#[derive(Clone, Debug)]
pub(super) struct LaneIndex {
    stretches: Vec<Stretch>,
    cells: BTreeMap<(i32, i32), Vec<u32>>,
}

impl LaneIndex {
    pub(super) fn new(lanes: &[Lane]) -> Self {
        let mut stretches = Vec::new();
        for (lane, content) in (0u32..).zip(lanes) {
            if !content.kind.is_road_surface() {
                continue;
            }
            for (point, pair) in (0u32..).zip(content.points.windows(2)) {
                stretches.push(Stretch::new(lane, point, corners(&pair[0], &pair[1])));
            }
        }
        let mut cells: BTreeMap<(i32, i32), Vec<u32>> = BTreeMap::new();
        for (place, stretch) in (0u32..).zip(&stretches) {
            for cell in cells_between(stretch.low, stretch.high) {
                cells.entry(cell).or_default().push(place);
            }
        }
        Self { stretches, cells }
    }

    /// Distance from `point` to the union of all road surfaces, at most [`SEARCH_LIMIT`].
    pub(super) fn distance_off_road(&self, point: Vec2) -> f64 {
        if self.near(point, 0.0).any(|stretch| stretch.contains(point)) {
            return 0.0;
        }
        let mut best = SEARCH_LIMIT;
        let mut radius = 0.0;
        // Widen square by square: whatever lies nearer than `radius` has been seen.
        while radius < SEARCH_LIMIT && best > radius {
            radius = if radius == 0.0 {
                FIRST_RADIUS
            } else {
                radius * WIDENING
            };
            for stretch in self.near(point, radius) {
                if stretch.box_distance_squared(point) < best * best {
                    best = best.min(distance_to_hull(&stretch.corners, point));
                }
            }
        }
        best
    }

    /// Every drivable lane whose surface holds `point`, with the driving direction there; by handle.
    pub(super) fn lanes_at(&self, lanes: &[Lane], point: Vec2) -> Vec<(LaneId, f64)> {
        let mut found: Vec<(LaneId, f64)> = Vec::new();
        for stretch in self.near(point, 0.0) {
            let lane = &lanes[stretch.lane as usize];
            let id = LaneId(stretch.lane);
            let new = found.iter().all(|(other, _)| *other != id);
            if new && lane.kind.is_drivable() && stretch.contains(point) {
                found.push((id, lane.points[stretch.point as usize].theta));
            }
        }
        found.sort_unstable_by_key(|(id, _)| *id);
        found
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

    /// Every stretch that comes nearer than `radius`, and some that do not; some more than once.
    fn near(&self, point: Vec2, radius: f64) -> impl Iterator<Item = &Stretch> + '_ {
        let reach = Vec2::repeat(radius);
        cells_between(point - reach, point + reach)
            .filter_map(|cell| self.cells.get(&cell))
            .flatten()
            .map(|place| &self.stretches[*place as usize])
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

/// Distance from `point` to the convex hull of four corners, 0 inside; infinite when they span no area.
///
/// The hull of four points is the union of the four triangles between them. So the order does not matter,
/// nor does it that a wide lane in a tight bend folds its stretches into bow ties.
fn distance_to_hull(corners: &[Vec2; 4], point: Vec2) -> f64 {
    let [a, b, c, d] = *corners;
    [[a, b, c], [a, c, d], [a, b, d], [b, c, d]]
        .into_iter()
        .map(|triangle| distance_to_triangle(triangle, point))
        .fold(f64::INFINITY, f64::min)
}

/// Distance from `point` to a triangle of either orientation, 0 inside; infinite when it has no area.
fn distance_to_triangle([a, b, c]: [Vec2; 3], point: Vec2) -> f64 {
    let turn = cross(b - a, c - a);
    if turn.abs() <= NO_AREA {
        return f64::INFINITY;
    }
    let edges = [(a, b), (b, c), (c, a)];
    let inside = |(p, q): (Vec2, Vec2)| cross(q - p, point - p) * turn >= 0.0;
    if edges.into_iter().all(inside) {
        return 0.0;
    }
    edges
        .into_iter()
        .map(|(p, q)| distance_to_edge(p, q, point))
        .fold(f64::INFINITY, f64::min)
}

/// Distance from `point` to the edge `p`–`q`, which has a length.
fn distance_to_edge(p: Vec2, q: Vec2, point: Vec2) -> f64 {
    let along = q - p;
    let t = ((point - p).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
    (point - p - along * t).norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::ConvexPolygon;
    use crate::road::{LaneKind, RoadMap};
    use proptest::prelude::*;

    /// A lane of constant curvature with a width that swells and shrinks.
    fn arc(name: &str, kind: LaneKind, from: Vec2, theta: f64, kappa: f64, width: f64) -> Lane {
        let mut points = Vec::new();
        let mut at = from;
        for k in 0..120 {
            let s = f64::from(k) * 0.5;
            let heading = theta + kappa * s;
            let swell = 1.0 + 0.3 * libm::sin(s / 3.0);
            points.push(LanePoint {
                s,
                x: at.x,
                y: at.y,
                theta: heading,
                kappa,
                left: width * swell,
                right: width * (2.0 - swell),
                road_left: width,
                road_right: width,
                speed_limit: 13.9,
            });
            at += Vec2::new(libm::cos(heading), libm::sin(heading)) * 0.5;
        }
        Lane {
            name: name.to_owned(),
            kind,
            road: "r".to_owned(),
            junction: None,
            points,
            left_marks: Vec::new(),
            right_marks: Vec::new(),
            neighbours: [None; 4],
            predecessors: Vec::new(),
            successors: Vec::new(),
        }
    }

    /// Hulls of all stretches, asked one by one.
    fn by_brute_force(lanes: &[Lane], point: Vec2) -> f64 {
        lanes
            .iter()
            .filter(|lane| lane.kind.is_road_surface())
            .flat_map(|lane| lane.points.windows(2))
            .filter_map(|pair| ConvexPolygon::hull(&corners(&pair[0], &pair[1])))
            .map(|hull| hull.distance_to_point(point))
            .fold(SEARCH_LIMIT, f64::min)
    }

    proptest! {
        /// Curvatures up to 0.8 with widths up to 4 m fold stretches into bow ties.
        #[test]
        fn the_distance_is_that_of_the_nearest_hull(
            theta in -3.0..3.0f64,
            kappas in [-0.8..0.8f64, -0.05..0.05f64],
            width in 0.0..4.0f64,
            points in prop::collection::vec((-45.0..75.0f64, -60.0..60.0f64), 40),
        ) {
            let lanes = vec![
                arc("a", LaneKind::Driving, Vec2::new(0.0, 0.0), theta, kappas[0], 1.75),
                arc("b", LaneKind::Parking, Vec2::new(9.0, -4.0), theta + 1.0, kappas[1], width),
                arc("c", LaneKind::Sidewalk, Vec2::new(-9.0, 4.0), theta - 1.0, kappas[1], 3.0),
            ];
            let map = RoadMap::new(lanes.clone(), Vec::new()).unwrap();
            for (x, y) in points {
                let point = Vec2::new(x, y);
                let (found, expected) = (map.distance_off_road(point), by_brute_force(&lanes, point));
                prop_assert!((found - expected).abs() < 1e-9, "{found} is not {expected} at {x} {y}");
            }
        }
    }

    #[test]
    fn lanes_at_names_every_drivable_lane_under_a_point_and_its_direction() {
        let lanes = vec![
            arc("east", LaneKind::Driving, Vec2::new(0.0, 0.0), 0.0, 0.0, 1.5),
            arc("north", LaneKind::Driving, Vec2::new(20.0, -20.0), 1.5, 0.0, 1.5),
            arc("bay", LaneKind::Parking, Vec2::new(0.0, -3.0), 0.0, 0.0, 1.5),
        ];
        let map = RoadMap::new(lanes, Vec::new()).unwrap();
        assert_eq!(map.lanes_at(Vec2::new(5.0, 0.0)), [(LaneId(0), 0.0)]);
        assert_eq!(
            map.lanes_at(Vec2::new(21.4, 0.0)),
            [(LaneId(0), 0.0), (LaneId(1), 1.5)]
        );
        assert_eq!(map.lanes_at(Vec2::new(5.0, -4.0)), []);
        assert_eq!(map.lanes_at(Vec2::new(f64::NAN, 0.0)), []);
    }
}
