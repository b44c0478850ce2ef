//! Parametric cubics (`paramPoly3`, `poly3`) walked by arc length.
//!
//! A table of cumulative arc length over panels of the parameter, Gauss–Legendre inside a panel, Newton with
//! bisection for the way back.

use super::quadrature::integrate;
use super::{CurvePoint, ShapeError};

/// Fewest and most panels of the table: about one a metre between.
const PANELS: (f64, f64) = (8.0, 512.0);

/// A curve may be this much longer or shorter than the file says before it is refused.
const LENGTH_FACTOR: f64 = 2.0;

/// Speed below which the curve has no tangent, per unit of the parameter.
const STANDSTILL: f64 = 1e-9;

/// `(u(p), v(p))` for `p` from 0 on, both cubic.
#[derive(Clone, Debug)]
pub(crate) struct Parametric {
    u: [f64; 4],
    v: [f64; 4],
    panel: f64,
    /// Arc length from 0 to the start of each panel and to the end of the last one.
    table: Vec<f64>,
    /// Arc length per metre of road station.
    stretch: f64,
}

impl Parametric {
    /// A `paramPoly3` whose parameter runs to `end`, laid over `length` metres of road.
    ///
    /// The road's station and the true arc length are proportional, so that both ends stay where they are.
    pub(crate) fn new(u: [f64; 4], v: [f64; 4], end: f64, length: f64) -> Result<Self, ShapeError> {
        let mut curve = Self::tabulated(u, v, end, length);
        let true_length = curve.table[curve.table.len() - 1];
        let believable = true_length <= length * LENGTH_FACTOR && true_length >= length / LENGTH_FACTOR;
        if !believable {
            return Err(ShapeError::Length {
                is: true_length,
                says: length,
            });
        }
        curve.stretch = true_length / length;
        Ok(curve)
    }

    /// A `poly3`: `v` is a cubic of `u`, and the curve ends where its arc length is `length`.
    pub(crate) fn function(v: [f64; 4], length: f64) -> Result<Self, ShapeError> {
        // Arc length is never less than u, so the curve ends before u = length.
        let curve = Self::tabulated([0.0, 1.0, 0.0, 0.0], v, length, length);
        let longest = curve.table[curve.table.len() - 1];
        if longest.is_finite() {
            return Ok(curve);
        }
        Err(ShapeError::Length {
            is: longest,
            says: length,
        })
    }

    fn tabulated(u: [f64; 4], v: [f64; 4], end: f64, length: f64) -> Self {
        let panels = length.clamp(PANELS.0, PANELS.1).ceil();
        let mut curve = Self {
            u,
            v,
            panel: end / panels,
            table: vec![0.0],
            stretch: 1.0,
        };
        while (curve.table.len() as f64) <= panels {
            let k = curve.table.len() - 1;
            let (from, to) = (k as f64 * curve.panel, (k + 1) as f64 * curve.panel);
            curve.table.push(curve.table[k] + curve.arc(from, to));
        }
        curve
    }

    /// Arc length between two parameters of one panel.
    fn arc(&self, from: f64, to: f64) -> f64 {
        let [length, _] = integrate(from, to, |p| {
            let (du, dv) = (derivatives(self.u, p)[1], derivatives(self.v, p)[1]);
            [(du * du + dv * dv).sqrt(), 0.0]
        });
        length
    }

    /// The parameter at which the arc length is `arc`, to about 1e-12 of a panel.
    fn parameter(&self, arc: f64) -> f64 {
        let last = self.table.len() - 2;
        let k = self
            .table
            .partition_point(|length| *length <= arc)
            .clamp(1, last + 1)
            - 1;
        let start = k as f64 * self.panel;
        let (mut low, mut high) = (start, start + self.panel);
        let wanted = arc - self.table[k];
        let mut p = start + self.panel * (wanted / (self.table[k + 1] - self.table[k])).clamp(0.0, 1.0);
        if p.is_nan() {
            return start;
        }
        // Newton, with the bracket to fall back on where the curve nearly stands still.
        for _ in 0..50 {
            let excess = self.arc(start, p) - wanted;
            if excess > 0.0 {
                high = p;
            } else {
                low = p;
            }
            let (du, dv) = (derivatives(self.u, p)[1], derivatives(self.v, p)[1]);
            let newton = p - excess / (du * du + dv * dv).sqrt();
            let next = if newton >= low && newton <= high {
                newton
            } else {
                0.5 * (low + high)
            };
            if (next - p).abs() <= 1e-12 * self.panel {
                return next;
            }
            p = next;
        }
        p
    }

    /// The point `ds` metres of road behind the start.
    pub(super) fn at(&self, ds: f64) -> CurvePoint {
        let p = self.parameter(ds * self.stretch);
        let [x, du, ddu, dddu] = derivatives(self.u, p);
        let [y, dv, ddv, dddv] = derivatives(self.v, p);
        let speed = (du * du + dv * dv).sqrt();
        let mut point = CurvePoint {
            x,
            y,
            theta: 0.0,
            kappa: 0.0,
            dkappa: 0.0,
            stretch: self.stretch,
        };
        if speed < STANDSTILL {
            // The tangent's limit: the curve sets out along its acceleration.
            point.theta = libm::atan2(ddv, ddu);
            return point;
        }
        point.theta = libm::atan2(dv, du);
        point.kappa = (du * ddv - dv * ddu) / (speed * speed * speed);
        let along = (du * ddu + dv * ddv) / (speed * speed);
        let change = (du * dddv - dv * dddu) / (speed * speed * speed) - 3.0 * point.kappa * along;
        point.dkappa = change / speed * self.stretch;
        point
    }
}

/// A cubic and its three derivatives.
fn derivatives([a, b, c, d]: [f64; 4], p: f64) -> [f64; 4] {
    [
        a + p * (b + p * (c + p * d)),
        b + p * (2.0 * c + p * 3.0 * d),
        2.0 * c + 6.0 * d * p,
        6.0 * d,
    ]
}
