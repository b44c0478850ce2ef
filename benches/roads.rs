//! A road to measure on, the obstacles beside it, and a line that knows its stations by heart.

use corridor_decider::frame::ObstacleId;
use corridor_decider::geometry::{Vec2, angle};
use corridor_decider::reference_line::{LinePoint, LineQuery, LineSample, ReferenceLine, SlPoint};
use corridor_decider::road::{BoundaryType, LaneId, Neighbour};
use corridor_decider::tasks::path_bounds::{ObstacleSl, Station};

/// Distance between cross-sections, m: that of the importers.
const SPACING: f64 = 0.5;

/// Width of each of the three lanes, m.
const LANE_WIDTH: f64 = 3.5;

/// Bends both ways, the tightest of 80 m radius, every 250 m.
fn curvature(s: f64) -> f64 {
    angle::sin_cos(s / 250.0 * std::f64::consts::TAU).0 / 80.0
}

/// The middle one of three lanes of a winding one-way road.
pub(crate) fn winding_road(length: f64) -> ReferenceLine {
    let mut at = LinePoint {
        x: 0.0,
        y: 0.0,
        theta: 0.0,
        kappa: 0.0,
    };
    let mut samples = Vec::new();
    let mut s = 0.0;
    while s <= length {
        at.kappa = curvature(s);
        samples.push(cross_section(s, at));
        let middle = at.theta + at.kappa * SPACING / 2.0;
        let (sin, cos) = angle::sin_cos(middle);
        at.x += cos * SPACING;
        at.y += sin * SPACING;
        at.theta = angle::wrap(at.theta + curvature(s + SPACING / 2.0) * SPACING);
        s += SPACING;
    }
    ReferenceLine::from(samples)
}

fn cross_section(s: f64, point: LinePoint) -> LineSample {
    let half = LANE_WIDTH / 2.0;
    LineSample {
        s,
        point,
        lane: LaneId(0),
        offset: 0.0,
        lane_width: (half, half),
        road_width: (half + LANE_WIDTH, half + LANE_WIDTH),
        marks: (BoundaryType::DottedWhite, BoundaryType::DottedWhite),
        neighbours: [Some(LANE_WIDTH), None, Some(LANE_WIDTH), None],
        in_junction: false,
        speed_limit: Some(14.0),
    }
}

/// Parked cars that reach into the middle lane from both sides and cones in the lanes beside it, spread evenly
/// over a hundred metres: with fifty of them, several are abreast everywhere. Every lane can be passed.
#[allow(dead_code, reason = "not every bench has obstacles")]
pub(crate) fn obstacles(count: u32, first_s: f64) -> Vec<ObstacleSl> {
    let obstacle = |k: u32| {
        let s = first_s + 100.0 * (f64::from(k) + 0.5) / f64::from(count);
        let (length, start_l, end_l) = match k % 4 {
            0 => (4.5, -3.4, -1.6),
            1 => (0.4, 3.3, 3.7),
            2 => (4.5, 1.6, 3.4),
            _ => (0.4, -3.7, -3.3),
        };
        ObstacleSl {
            id: ObstacleId(k),
            start_s: s - length / 2.0,
            end_s: s + length / 2.0,
            start_l,
            end_l,
            speed: 0.0,
            is_static: true,
            is_virtual: false,
            is_ignored: false,
        }
    };
    (0..count).map(obstacle).collect()
}

/// A line whose stations were looked up before: what is left of a call is the decider alone.
#[allow(dead_code, reason = "not every bench leaves the look-ups out")]
pub(crate) struct Surveyed {
    pub(crate) line: ReferenceLine,
    pub(crate) stations: Vec<Station>,
}

impl LineQuery for Surveyed {
    fn sample(&self, _from: f64, _step: f64, _end: f64, stations: &mut Vec<Station>) {
        stations.extend_from_slice(&self.stations);
    }

    fn length(&self) -> f64 {
        self.line.length()
    }

    fn lane_width(&self, s: f64) -> Option<(f64, f64)> {
        self.line.lane_width(s)
    }

    fn road_width(&self, s: f64) -> Option<(f64, f64)> {
        self.line.road_width(s)
    }

    fn offset_to_map(&self, s: f64) -> Option<f64> {
        self.line.offset_to_map(s)
    }

    fn boundary_types(&self, s: f64) -> Option<(BoundaryType, BoundaryType)> {
        self.line.boundary_types(s)
    }

    fn neighbour_width(&self, neighbour: Neighbour, s: f64) -> Option<f64> {
        self.line.neighbour_width(neighbour, s)
    }

    fn near_junction(&self, s: f64, radius: f64) -> bool {
        self.line.near_junction(s, radius)
    }

    fn lane_heading(&self, point: Vec2, theta: f64) -> Option<f64> {
        self.line.lane_heading(point, theta)
    }

    fn point(&self, s: f64) -> LinePoint {
        self.line.point(s)
    }

    fn to_frenet(&self, point: Vec2) -> SlPoint {
        self.line.to_frenet(point)
    }
}
