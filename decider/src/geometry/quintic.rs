//! Quintic polynomials between two states.

/// A polynomial of degree five in a parameter that starts at 0.
///
/// Coefficients in the notation of Werling et al., "Optimal Trajectory Generation for Dynamic Street
/// Scenarios in a Frenet Frame" (2010): position, first and second derivative given at both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quintic {
    coefficients: [f64; 6],
    length: f64,
}

impl Quintic {
    /// The quintic from `start` to `end`, each (value, first, second derivative), over `length > 0`.
    pub fn between(start: [f64; 3], end: [f64; 3], length: f64) -> Self {
        let [x0, v0, a0] = start;
        let [x1, v1, a1] = end;
        let p = length;
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
        Self { coefficients, length }
    }

    /// Value and first three derivatives at `p`; beyond the end the end value is held.
    pub fn evaluate(&self, p: f64) -> [f64; 4] {
        let held = p >= self.length;
        let p = p.clamp(0.0, self.length);
        let [c0, c1, c2, c3, c4, c5] = self.coefficients;
        let value = c0 + p * (c1 + p * (c2 + p * (c3 + p * (c4 + p * c5))));
        if held {
            return [value, 0.0, 0.0, 0.0];
        }
        [
            value,
            c1 + p * (2.0 * c2 + p * (3.0 * c3 + p * (4.0 * c4 + p * 5.0 * c5))),
            2.0 * c2 + p * (6.0 * c3 + p * (12.0 * c4 + p * 20.0 * c5)),
            6.0 * c3 + p * (24.0 * c4 + p * 60.0 * c5),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Worked numbers of the original lattice planner's lateral curve.
    #[test]
    fn agrees_with_the_worked_numbers() {
        let curve = Quintic::between([0.4, 0.02, -0.001], [-0.5, 0.0, 0.0], 20.0);
        let expected = [0.4, 0.02, -0.0005, -0.00135, 1.00625e-4, -2e-6];
        for (c, e) in curve.coefficients.iter().zip(expected) {
            assert!((c - e).abs() < 1e-15, "{c} is not {e}");
        }
        let [l, dl, ..] = curve.evaluate(10.0);
        assert!((l - 0.00625).abs() < 1e-15 && (dl + 0.0925).abs() < 1e-15);
    }
}
