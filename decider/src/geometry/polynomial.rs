//! Polynomials of degree five or less through boundary conditions.
//!
//! Notation of Werling et al., "Optimal Trajectory Generation for Dynamic Street Scenarios in a Frenet Frame" (2010):
//! value, first and second derivative at a start and at an end. The parameter starts at 0; it may be a time or a length.
//! Beyond `[0, length]` a polynomial goes on as it is.

/// A polynomial with the length of the interval that it was made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polynomial {
    coefficients: [f64; 6],
    length: f64,
}

impl Polynomial {
    /// The polynomial with these coefficients by ascending power, over `length`.
    pub const fn new(coefficients: [f64; 6], length: f64) -> Self {
        Self { coefficients, length }
    }

    /// A value that stays.
    pub const fn constant(value: f64, length: f64) -> Self {
        Self::new([value, 0.0, 0.0, 0.0, 0.0, 0.0], length)
    }

    /// The cubic from `start` (value, first and second derivative) to the value `end`; `None` without a length.
    pub fn cubic([x0, v0, a0]: [f64; 3], end: f64, length: f64) -> Option<Self> {
        let p = positive(length)?;
        let c3 = (end - x0 - v0 * p - a0 * p * p / 2.0) / (p * p * p);
        Some(Self::new([x0, v0, a0 / 2.0, c3, 0.0, 0.0], length))
    }

    /// The cubic of constant third derivative `jerk` from `start`; `None` without a length.
    pub fn constant_jerk([x0, v0, a0]: [f64; 3], jerk: f64, length: f64) -> Option<Self> {
        positive(length)?;
        Some(Self::new([x0, v0, a0 / 2.0, jerk / 6.0, 0.0, 0.0], length))
    }

    /// The quartic from `start` to first and second derivative `end`, the end value being free; `None` without a
    /// length.
    pub fn quartic([x0, v0, a0]: [f64; 3], [v1, a1]: [f64; 2], length: f64) -> Option<Self> {
        let p = positive(length)?;
        let b0 = v1 - a0 * p - v0;
        let b1 = a1 - a0;
        let c3 = (3.0 * b0 - b1 * p) / (3.0 * p * p);
        let c4 = (b1 * p - 2.0 * b0) / (4.0 * p * p * p);
        Some(Self::new([x0, v0, a0 / 2.0, c3, c4, 0.0], length))
    }

    /// The quartic from `start` to value and first derivative `end`; `None` without a length.
    pub fn quartic_to_slope([x0, v0, a0]: [f64; 3], [x1, v1]: [f64; 2], length: f64) -> Option<Self> {
        let p = positive(length)?;
        // What the start leaves of value and slope, each divided by its power of p.
        let value = (x1 - x0 - v0 * p - a0 * p * p / 2.0) / (p * p * p);
        let slope = (v1 - v0 - a0 * p) / (p * p);
        let coefficients = [
            x0,
            v0,
            a0 / 2.0,
            4.0 * value - slope,
            (slope - 3.0 * value) / p,
            0.0,
        ];
        Some(Self::new(coefficients, length))
    }

    /// The quartic from value and slope `start` to value, first and second derivative `end`; `None` without a length.
    pub fn quartic_from_slope([x0, v0]: [f64; 2], [x1, v1, a1]: [f64; 3], length: f64) -> Option<Self> {
        let p = positive(length)?;
        let value = (x1 - x0 - v0 * p) / (p * p);
        let slope = (v1 - v0) / p;
        let c2 = 6.0 * value - 3.0 * slope + a1 / 2.0;
        let c3 = (5.0 * slope - 8.0 * value - a1) / p;
        let c4 = (3.0 * value - 2.0 * slope + a1 / 2.0) / (p * p);
        Some(Self::new([x0, v0, c2, c3, c4, 0.0], length))
    }

    /// The quintic from `start` to `end`, each value, first and second derivative; `None` without a length.
    pub fn quintic([x0, v0, a0]: [f64; 3], [x1, v1, a1]: [f64; 3], length: f64) -> Option<Self> {
        let p = positive(length)?;
        let c0 = (x1 - x0 - v0 * p - a0 * p * p / 2.0) / (p * p * p);
        let c1 = (v1 - v0 - a0 * p) / (p * p);
        let c2 = (a1 - a0) / p;
        let coefficients = [
            x0,
            v0,
            a0 / 2.0,
            f64::midpoint(20.0 * c0 - 8.0 * c1, c2),
            (-15.0 * c0 + 7.0 * c1 - c2) / p,
            (6.0 * c0 - 3.0 * c1 + c2 / 2.0) / (p * p),
        ];
        Some(Self::new(coefficients, length))
    }

    /// The first derivative as a polynomial.
    #[must_use]
    pub fn derived(&self) -> Self {
        let [_, c1, c2, c3, c4, c5] = self.coefficients;
        Self::new([c1, 2.0 * c2, 3.0 * c3, 4.0 * c4, 5.0 * c5, 0.0], self.length)
    }

    /// The polynomial of degree five or less whose derivative this is, from `value` at 0. A fifth power is lost.
    #[must_use]
    pub fn integrated(&self, value: f64) -> Self {
        let [c0, c1, c2, c3, c4, _] = self.coefficients;
        Self::new([value, c0, c1 / 2.0, c2 / 3.0, c3 / 4.0, c4 / 5.0], self.length)
    }

    /// Coefficients by ascending power.
    pub fn coefficients(&self) -> &[f64; 6] {
        &self.coefficients
    }

    /// Length of the interval that it was made for.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Value and first three derivatives at `p`.
    pub fn at(&self, p: f64) -> [f64; 4] {
        let [c0, c1, c2, c3, c4, c5] = self.coefficients;
        [
            c0 + p * (c1 + p * (c2 + p * (c3 + p * (c4 + p * c5)))),
            c1 + p * (2.0 * c2 + p * (3.0 * c3 + p * (4.0 * c4 + p * 5.0 * c5))),
            2.0 * c2 + p * (6.0 * c3 + p * (12.0 * c4 + p * 20.0 * c5)),
            6.0 * c3 + p * (24.0 * c4 + p * 60.0 * c5),
        ]
    }

    /// The derivative of any order at `p`; order 0 is the value.
    pub fn derivative(&self, order: usize, p: f64) -> f64 {
        let derived = (0..order.min(6)).fold(*self, |polynomial, _| polynomial.derived());
        derived.at(p)[0]
    }
}

/// A length that one can divide by.
fn positive(length: f64) -> Option<f64> {
    (length > 0.0 && length.is_finite()).then_some(length)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(polynomial: Option<Polynomial>, wanted: [f64; 6], tolerance: f64) {
        let polynomial = polynomial.unwrap();
        for (c, e) in polynomial.coefficients().iter().zip(wanted) {
            assert!((c - e).abs() < tolerance, "{c} is not {e}");
        }
    }

    /// Worked numbers of the lattice planner's specification.
    #[test]
    fn agrees_with_the_worked_numbers() {
        let cruise = Polynomial::quartic([50.0, 10.0, 0.5], [15.0, 0.0], 4.0);
        near(cruise, [50.0, 10.0, 0.25, 0.229_166_666_7, -0.03125, 0.0], 1e-9);
        let follow = Polynomial::quintic([50.0, 10.0, 0.5], [90.0, 8.0, 0.0], 5.0);
        near(follow, [50.0, 10.0, 0.25, -0.63, 0.158, -0.0116], 1e-12);
        assert!((follow.unwrap().at(0.0)[3] + 3.78).abs() < 1e-12);
    }

    #[test]
    fn every_kind_meets_its_ends_and_derivatives_are_slopes() {
        let (start, p) = ([0.3, -1.2, 0.7], 2.5);
        let kinds = [
            (Polynomial::cubic(start, 4.0, p), [Some(4.0), None, None]),
            (
                Polynomial::quartic(start, [2.0, -0.5], p),
                [None, Some(2.0), Some(-0.5)],
            ),
            (
                Polynomial::quartic_to_slope(start, [4.0, 2.0], p),
                [Some(4.0), Some(2.0), None],
            ),
            (
                Polynomial::quartic_from_slope([0.3, -1.2], [4.0, 2.0, -0.5], p),
                [Some(4.0), Some(2.0), Some(-0.5)],
            ),
            (
                Polynomial::quintic(start, [4.0, 2.0, -0.5], p),
                [Some(4.0), Some(2.0), Some(-0.5)],
            ),
        ];
        for (polynomial, end) in kinds {
            let polynomial = polynomial.unwrap();
            let (first, last) = (polynomial.at(0.0), polynomial.at(p));
            assert!((first[0] - 0.3).abs() < 1e-12 && (first[1] + 1.2).abs() < 1e-12);
            for (value, wanted) in last.iter().zip(end) {
                assert!(
                    wanted.is_none_or(|wanted| (value - wanted).abs() < 1e-12),
                    "{polynomial:?}"
                );
            }
            for order in 0..5 {
                let step = 1e-5;
                let slope = (polynomial.derivative(order, 1.0 + step)
                    - polynomial.derivative(order, 1.0 - step))
                    / (2.0 * step);
                assert!((slope - polynomial.derivative(order + 1, 1.0)).abs() < 1e-6 * slope.abs().max(1.0));
            }
            let again = polynomial.derived().integrated(polynomial.at(0.0)[0]);
            near(Some(again), *polynomial.coefficients(), 1e-12);
        }
        assert!(Polynomial::quintic(start, start, 0.0).is_none());
    }
}
