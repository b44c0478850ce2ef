//! The clothoid: curvature linear in arc length, `kappa = start + rate * s`.
//!
//! Positions are Fresnel integrals, taken by Gauss–Legendre quadrature over panels that turn by at most
//! [`PANEL_TURN`]; the error is then of the order of the rounding.

use super::quadrature::integrate;
use super::{CurvePoint, ShapeError};

/// Largest change of heading over one panel, rad: the eight-node rule errs by less than 1e-16 of the panel.
const PANEL_TURN: f64 = 0.5;

/// Largest change of heading over one spiral, rad: 160 rounds, far more than any ramp. It bounds the table.
const MAX_TURN: f64 = 1000.0;

/// A clothoid that starts at the origin along `+x`.
#[derive(Clone, Debug)]
pub(crate) struct Spiral {
    start: f64,
    rate: f64,
    panel: f64,
    /// Positions at the starts of the panels.
    knots: Vec<[f64; 2]>,
}

impl Spiral {
    /// A spiral of `length > 0` between two curvatures, 1/m.
    pub(crate) fn new(start: f64, end: f64, length: f64) -> Result<Self, ShapeError> {
        let turn = start.abs().max(end.abs()) * length;
        if turn.is_nan() || turn > MAX_TURN {
            return Err(ShapeError::Turn {
                turn,
                limit: MAX_TURN,
            });
        }
        let panels = (turn / PANEL_TURN).ceil().max(1.0);
        let mut spiral = Self {
            start,
            rate: (end - start) / length,
            panel: length / panels,
            knots: vec![[0.0; 2]],
        };
        for k in 1..panels_as_count(panels) {
            let [x, y] = spiral.position(k as f64 * spiral.panel);
            spiral.knots.push([x, y]);
        }
        Ok(spiral)
    }

    fn heading(&self, s: f64) -> f64 {
        s * (self.start + 0.5 * self.rate * s)
    }

    fn position(&self, s: f64) -> [f64; 2] {
        let k = panels_as_count((s / self.panel).floor().max(0.0)).min(self.knots.len() - 1);
        let [dx, dy] = integrate(k as f64 * self.panel, s, |s| {
            let (sin, cos) = libm::sincos(self.heading(s));
            [cos, sin]
        });
        [self.knots[k][0] + dx, self.knots[k][1] + dy]
    }

    /// The point at arc length `s`.
    pub(super) fn at(&self, s: f64) -> CurvePoint {
        let [x, y] = self.position(s);
        CurvePoint {
            x,
            y,
            theta: self.heading(s),
            kappa: self.start + self.rate * s,
            dkappa: self.rate,
            stretch: 1.0,
        }
    }
}

fn panels_as_count(panels: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "not negative, and at most MAX_TURN / PANEL_TURN"
    )]
    let count = panels as usize;
    count
}
