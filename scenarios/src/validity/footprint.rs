//! The ground that a body covers, as a box in the frame of the route's line.

use corridor_decider::geometry::{ConvexPolygon, Vec2, angle};
use corridor_decider::reference_line::{LineQuery, ReferenceLine, SlPoint};

/// Newton steps from a station nearby: each squares the error, and it starts below a truck's length.
const STEPS: usize = 4;

/// Stations and offsets that a body covers, m. In a bend the box holds the corners only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FrenetBox {
    pub(crate) s: (f64, f64),
    pub(crate) l: (f64, f64),
}

impl FrenetBox {
    /// The box around `body`, which lies near station `s`.
    pub(crate) fn of(line: &ReferenceLine, body: &ConvexPolygon, s: f64) -> Self {
        let mut ground = Self {
            s: (f64::MAX, f64::MIN),
            l: (f64::MAX, f64::MIN),
        };
        for corner in body.vertices() {
            let at = project_near(line, *corner, s);
            ground.s = (ground.s.0.min(at.s), ground.s.1.max(at.s));
            ground.l = (ground.l.0.min(at.l), ground.l.1.max(at.l));
        }
        ground
    }

    /// Whether it shares stations with `[from, to]`.
    pub(crate) fn meets_stations(&self, from: f64, to: f64) -> bool {
        self.s.0 < to && self.s.1 > from
    }

    /// Whether it shares offsets with `[right, left]`.
    pub(crate) fn meets_offsets(&self, right: f64, left: f64) -> bool {
        self.l.0 < left && self.l.1 > right
    }

    /// The box moved along and across the line.
    pub(crate) fn moved(&self, ds: f64, dl: f64) -> Self {
        Self {
            s: (self.s.0 + ds, self.s.1 + ds),
            l: (self.l.0 + dl, self.l.1 + dl),
        }
    }
}

/// Frenet coordinates of a point near station `s`, where the line bends gently. Beyond the line's ends the
/// end tangent goes on.
pub(crate) fn project_near(line: &ReferenceLine, point: Vec2, s: f64) -> SlPoint {
    let mut s = s.clamp(0.0, line.length());
    let mut at = SlPoint { s, l: 0.0 };
    for _ in 0..STEPS {
        let foot = line.point(s);
        let (sin, cos) = angle::sin_cos(foot.theta);
        let d = Vec2::new(point.x - foot.x, point.y - foot.y);
        let along = cos * d.x + sin * d.y;
        let l = cos * d.y - sin * d.x;
        at = SlPoint { s: s + along, l };
        s = (s + along / (1.0 - foot.kappa * l).max(0.1)).clamp(0.0, line.length());
    }
    at
}
