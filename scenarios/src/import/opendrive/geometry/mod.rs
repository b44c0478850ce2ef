//! The reference line of a road: lines, arcs, spirals and cubics in double precision.
//!
//! Formulas follow ASAM OpenDRIVE, "Geometry" (planView). Station `s` in metres along the road, world metres,
//! headings in radians counter-clockwise from `+x`, curvature positive in left turns.

mod parametric;
mod quadrature;
mod spiral;

pub(super) use parametric::Parametric;
pub(super) use spiral::Spiral;

use corridor_decider::geometry::Pose;

/// Why a piece of reference line cannot exist.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub(super) enum ShapeError {
    /// It winds up without end.
    #[error("turns by {turn:.0} rad, which is more than {limit:.0} rad")]
    Turn {
        /// Its turn, rad.
        turn: f64,
        /// The most that is read, rad.
        limit: f64,
    },
    /// Its coefficients and its length contradict each other.
    #[error("has coefficients that make it {is:.3} m long, but `length` says {says:.3} m")]
    Length {
        /// By its coefficients, m.
        is: f64,
        /// By the file, m.
        says: f64,
    },
}

/// A point of the reference line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CurvePoint {
    pub(super) x: f64,
    pub(super) y: f64,
    /// Heading.
    pub(super) theta: f64,
    /// Curvature.
    pub(super) kappa: f64,
    /// Change of curvature per metre of station.
    pub(super) dkappa: f64,
    /// Arc length per metre of station: 1 but for cubics, where the file's length is an approximation.
    pub(super) stretch: f64,
}

/// The form of a piece, in its own frame: it starts at the origin along `+x`.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// Straight.
    Line,
    /// Of constant curvature.
    Arc {
        /// 1/m.
        curvature: f64,
    },
    /// Of linear curvature.
    Spiral(Spiral),
    /// Of cubic coordinates.
    Parametric(Parametric),
}

/// A piece of reference line.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Station of its start.
    pub(super) s: f64,
    /// Metres of station that it covers.
    pub(super) length: f64,
    /// Where it starts.
    pub(super) start: Pose,
    /// Its form.
    pub(super) shape: Shape,
}

impl Piece {
    /// The point at road station `s`, held at the ends of the piece.
    pub(super) fn at(&self, s: f64) -> CurvePoint {
        let ds = (s - self.s).clamp(0.0, self.length);
        let local = match &self.shape {
            Shape::Line => CurvePoint {
                x: ds,
                y: 0.0,
                theta: 0.0,
                kappa: 0.0,
                dkappa: 0.0,
                stretch: 1.0,
            },
            Shape::Arc { curvature } => arc(*curvature, ds),
            Shape::Spiral(spiral) => spiral.at(ds),
            Shape::Parametric(curve) => curve.at(ds),
        };
        let world = self.start.to_world([local.x, local.y].into());
        CurvePoint {
            x: world.x,
            y: world.y,
            theta: self.start.theta + local.theta,
            ..local
        }
    }

    pub(super) fn end(&self) -> f64 {
        self.s + self.length
    }
}

/// A circle by its chord: accurate down to vanishing curvature, where `sin(k s) / k` is not.
fn arc(kappa: f64, s: f64) -> CurvePoint {
    let half_turn = 0.5 * kappa * s;
    let (sin, cos) = libm::sincos(half_turn);
    // Below 1e-4 the series errs by less than 1e-18.
    let sinc = if half_turn.abs() < 1e-4 {
        1.0 - half_turn * half_turn / 6.0
    } else {
        sin / half_turn
    };
    let chord = s * sinc;
    CurvePoint {
        x: chord * cos,
        y: chord * sin,
        theta: 2.0 * half_turn,
        kappa,
        dkappa: 0.0,
        stretch: 1.0,
    }
}

#[cfg(test)]
mod tests;
