//! The analytic world in which the path-bounds vectors were made: a curve of known curvature with tables.

use corridor_decider::geometry::Vec2;
use corridor_decider::geometry::angle::sin_cos;
use corridor_decider::reference_line::{LinePoint, LineQuery, SlPoint};
use corridor_decider::road::{BoundaryType, Neighbour, Side};
use serde::Deserialize;

/// A straight line, an arc or a clothoid.
#[derive(Deserialize)]
pub(crate) struct Curve {
    x0: f64,
    y0: f64,
    heading0: f64,
    kappa0: f64,
    dkappa: f64,
    length: f64,
}

/// Values at knots, with holes.
#[derive(Deserialize)]
pub(crate) struct Table {
    knots: Vec<Vec<f64>>,
    #[serde(default)]
    missing: Vec<[f64; 2]>,
}

/// Intervals with a value each.
type Intervals<T> = Vec<(f64, f64, T)>;

#[derive(Deserialize)]
pub(crate) struct Neighbors {
    left_forward: Intervals<f64>,
    left_reverse: Intervals<f64>,
    right_forward: Intervals<f64>,
    right_reverse: Intervals<f64>,
}

#[derive(Deserialize)]
pub(crate) struct NearestLane {
    found: bool,
    heading_offset: f64,
}

/// The stub world of one case.
#[derive(Deserialize)]
pub(crate) struct StubWorld {
    ref_line: Curve,
    lane_width: Table,
    road_width: Table,
    offset_to_map: Table,
    no_waypoint: Vec<[f64; 2]>,
    left_boundary_type: Intervals<BoundaryType>,
    right_boundary_type: Intervals<BoundaryType>,
    neighbors: Neighbors,
    junctions: Vec<[f64; 2]>,
    nearest_lane: NearestLane,
}

impl Table {
    /// The values at `s`, or nothing in a hole.
    fn at(&self, s: f64) -> Option<Vec<f64>> {
        if self.knots.is_empty() || self.missing.iter().any(|[a, b]| *a <= s && s <= *b) {
            return None;
        }
        let after = self
            .knots
            .iter()
            .rposition(|knot| knot[0] <= s)
            .map_or(0, |k| k + 1);
        if after == 0 || after == self.knots.len() {
            return Some(self.knots[after.saturating_sub(1)][1..].to_vec());
        }
        let (a, b) = (&self.knots[after - 1], &self.knots[after]);
        let r = (s - a[0]) / (b[0] - a[0]);
        Some(
            a[1..]
                .iter()
                .zip(&b[1..])
                .map(|(x, y)| x * (1.0 - r) + y * r)
                .collect(),
        )
    }

    fn widths(&self, s: f64, length: f64) -> Option<(f64, f64)> {
        let inside = s >= 0.0 && s <= length;
        self.at(s).filter(|_| inside).map(|widths| (widths[0], widths[1]))
    }
}

fn first_in<T: Copy>(intervals: &Intervals<T>, s: f64) -> Option<T> {
    intervals
        .iter()
        .find(|(a, b, _)| *a <= s && s < *b)
        .map(|(.., value)| *value)
}

impl Curve {
    fn heading(&self, s: f64) -> f64 {
        self.heading0 + self.kappa0 * s + self.dkappa * s * s / 2.0
    }

    fn position(&self, s: f64) -> Vec2 {
        let start = Vec2::new(self.x0, self.y0);
        let (sin0, cos0) = sin_cos(self.heading0);
        if self.dkappa != 0.0 {
            return start + self.integrated(s);
        }
        if self.kappa0 != 0.0 {
            let (sin, cos) = sin_cos(self.heading(s));
            return start + Vec2::new(sin - sin0, cos0 - cos) / self.kappa0;
        }
        start + Vec2::new(cos0, sin0) * s
    }

    /// Five-point Gauss–Legendre quadrature on pieces of about a metre.
    fn integrated(&self, s: f64) -> Vec2 {
        const NODES: [(f64, f64); 5] = [
            (0.0, 0.568_888_888_888_888_9),
            (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (0.906_179_845_938_664, 0.236_926_885_056_189_08),
            (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
        ];
        let pieces = s.abs().ceil().max(1.0);
        let half = s / pieces / 2.0;
        let mut sum = Vec2::zeros();
        let mut k = 0.0;
        while k < pieces {
            let middle = (2.0 * k + 1.0) * half;
            for (node, weight) in NODES {
                let (sin, cos) = sin_cos(self.heading(middle + half * node));
                sum += Vec2::new(cos, sin) * (weight * half);
            }
            k += 1.0;
        }
        sum
    }

    /// Station of the foot of the perpendicular, by a coarse search and Newton's method.
    fn project(&self, point: Vec2) -> f64 {
        let distance = |s: f64| (point - self.position(s)).norm_squared();
        let steps = self.length.ceil().max(1.0);
        let mut s = 0.0;
        let mut k = 0.0;
        while k <= steps {
            let candidate = self.length * k / steps;
            if distance(candidate) < distance(s) {
                s = candidate;
            }
            k += 1.0;
        }
        for _ in 0..30 {
            let (sin, cos) = sin_cos(self.heading(s));
            let d = point - self.position(s);
            let along = cos * d.x + sin * d.y;
            let kappa = self.kappa0 + self.dkappa * s;
            let stretch = 1.0 - kappa * (cos * d.y - sin * d.x);
            s = (s + along / stretch).clamp(0.0, self.length);
        }
        s
    }
}

impl LineQuery for StubWorld {
    fn length(&self) -> f64 {
        self.ref_line.length
    }

    fn lane_width(&self, s: f64) -> Option<(f64, f64)> {
        self.lane_width.widths(s, self.ref_line.length)
    }

    fn road_width(&self, s: f64) -> Option<(f64, f64)> {
        self.road_width.widths(s, self.ref_line.length)
    }

    fn offset_to_map(&self, s: f64) -> Option<f64> {
        self.offset_to_map.at(s).map(|values| values[0])
    }

    fn boundary_types(&self, s: f64) -> Option<(BoundaryType, BoundaryType)> {
        if self.no_waypoint.iter().any(|[a, b]| *a <= s && s <= *b) {
            return None;
        }
        let kind = |intervals| first_in(intervals, s).unwrap_or(BoundaryType::Unknown);
        Some((kind(&self.left_boundary_type), kind(&self.right_boundary_type)))
    }

    fn neighbour_width(&self, neighbour: Neighbour, s: f64) -> Option<f64> {
        let lanes = &self.neighbors;
        let intervals = match (neighbour.side, neighbour.reverse) {
            (Side::Left, false) => &lanes.left_forward,
            (Side::Left, true) => &lanes.left_reverse,
            (Side::Right, false) => &lanes.right_forward,
            (Side::Right, true) => &lanes.right_reverse,
        };
        first_in(intervals, s)
    }

    fn near_junction(&self, s: f64, radius: f64) -> bool {
        self.junctions
            .iter()
            .any(|[a, b]| a - radius <= s && s <= b + radius)
    }

    fn lane_heading(&self, point: Vec2, _theta: f64) -> Option<f64> {
        let s = self.to_frenet(point).s;
        self.nearest_lane
            .found
            .then(|| self.ref_line.heading(s) + self.nearest_lane.heading_offset)
    }

    fn point(&self, s: f64) -> LinePoint {
        let s = s.clamp(0.0, self.ref_line.length);
        let at = self.ref_line.position(s);
        let kappa = self.ref_line.kappa0 + self.ref_line.dkappa * s;
        LinePoint {
            x: at.x,
            y: at.y,
            theta: self.ref_line.heading(s),
            kappa,
        }
    }

    fn to_frenet(&self, point: Vec2) -> SlPoint {
        let s = self.ref_line.project(point);
        let (sin, cos) = sin_cos(self.ref_line.heading(s));
        let d = point - self.ref_line.position(s);
        let beyond = if s <= 0.0 || s >= self.ref_line.length {
            cos * d.x + sin * d.y
        } else {
            0.0
        };
        SlPoint {
            s: s + beyond,
            l: cos * d.y - sin * d.x,
        }
    }
}
