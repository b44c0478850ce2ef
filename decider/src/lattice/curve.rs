//! Motion in one dimension: `s(t)` or `l(s)`, continued beyond its end with the acceleration that it ends with.

use super::grid::{SAMPLES, Series};
use super::piecewise::Piecewise;
use crate::geometry::Polynomial;

/// A curve in one parameter, from 0 on.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    shape: Shape,
    length: f64,
    /// Value, first and second derivative at the end.
    end: [f64; 3],
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    Polynomial(Polynomial),
    Piecewise(Piecewise),
    Deceleration(ConstantDeceleration),
}

impl Shape {
    fn at(&self, p: f64) -> [f64; 4] {
        match self {
            Self::Polynomial(polynomial) => polynomial.at(p),
            Self::Piecewise(piecewise) => piecewise.at(p),
            Self::Deceleration(deceleration) => deceleration.at(p),
        }
    }
}

impl Curve {
    fn new(shape: Shape, length: f64) -> Self {
        let [x, v, a, _] = shape.at(length);
        Self {
            shape,
            length,
            end: [x, v, a],
        }
    }

    /// Length of the parameter's interval.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The value at the end.
    pub fn end(&self) -> f64 {
        self.end[0]
    }

    /// Value and first three derivatives at `p`. From the end on the second derivative stays as it is there.
    pub fn at(&self, p: f64) -> [f64; 4] {
        if p < self.length {
            return self.shape.at(p);
        }
        let [x, v, a] = self.end;
        let beyond = p - self.length;
        [x + v * beyond + 0.5 * a * beyond * beyond, v + a * beyond, a, 0.0]
    }

    /// Value, first and second derivative at the times of the grid, whose parameters are `at`: one loop per shape.
    pub(super) fn sample(&self, at: &Series, into: &mut [Series; 3]) {
        match &self.shape {
            Shape::Polynomial(polynomial) => self.each(at, into, |p| polynomial.at(p)),
            Shape::Piecewise(piecewise) => {
                let mut place = 0;
                self.each(at, into, |p| piecewise.at_next(p, &mut place));
            }
            Shape::Deceleration(deceleration) => self.each(at, into, |p| deceleration.at(p)),
        }
    }

    /// The same as [`Curve::at`], without a branch.
    #[inline]
    fn each(
        &self,
        at: &Series,
        [values, slopes, bends]: &mut [Series; 3],
        mut shape: impl FnMut(f64) -> [f64; 4],
    ) {
        for k in 0..SAMPLES {
            let inside = if at[k] < self.length { at[k] } else { self.length };
            let beyond = at[k] - inside;
            let [x, v, a, _] = shape(inside);
            values[k] = x + v * beyond + 0.5 * a * beyond * beyond;
            slopes[k] = v + a * beyond;
            bends[k] = a;
        }
    }
}

impl From<Polynomial> for Curve {
    fn from(polynomial: Polynomial) -> Self {
        Self::new(Shape::Polynomial(polynomial), polynomial.length())
    }
}

impl From<ConstantDeceleration> for Curve {
    fn from(deceleration: ConstantDeceleration) -> Self {
        Self::new(Shape::Deceleration(deceleration), deceleration.length())
    }
}

impl From<Piecewise> for Curve {
    fn from(piecewise: Piecewise) -> Self {
        let length = piecewise.length();
        Self::new(Shape::Piecewise(piecewise), length)
    }
}

/// Constant braking to standstill, and standing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantDeceleration {
    s: f64,
    v: f64,
    /// Positive.
    braking: f64,
}

impl ConstantDeceleration {
    /// From `s` with speed `v`, of which the size counts, braking with `a`; `None` unless that is negative.
    pub fn new(s: f64, v: f64, a: f64) -> Option<Self> {
        (a < 0.0).then_some(Self {
            s,
            v: v.abs(),
            braking: -a,
        })
    }

    /// When the car stands, s.
    pub fn length(&self) -> f64 {
        self.v / self.braking
    }

    /// Place, speed, acceleration and jerk at a time.
    pub fn at(&self, t: f64) -> [f64; 4] {
        if t >= self.length() {
            return [self.s + self.v * self.v / (2.0 * self.braking), 0.0, 0.0, 0.0];
        }
        let v = self.v - self.braking * t;
        [self.s + (v + self.v) * 0.5 * t, v, -self.braking, 0.0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_of_every_shape_are_what_it_is_there() {
        let polynomial = Polynomial::quintic([0.3, -0.1, 0.02], [0.5, 0.0, 0.01], 20.0).unwrap();
        let pieces = Piecewise::of_jerks([0.3, -0.1, 0.02], &[(0.1, 3.0), (-0.2, 4.0), (0.05, 9.0)]).unwrap();
        let braking = ConstantDeceleration::new(3.0, 8.0, -0.5).unwrap();
        // There and back, and beyond every end.
        let at = std::array::from_fn(|k| (k as f64 * 0.9) % 37.0);
        for curve in [Curve::from(polynomial), pieces.into(), braking.into()] {
            let mut into = [[0.0; SAMPLES]; 3];
            curve.sample(&at, &mut into);
            for (k, p) in at.iter().enumerate() {
                let [x, v, a, _] = curve.at(*p);
                for (got, wanted) in into.iter().map(|series| series[k]).zip([x, v, a]) {
                    assert!((got - wanted).abs() < 1e-12, "{curve:?} at {p}");
                }
            }
        }
    }
}
