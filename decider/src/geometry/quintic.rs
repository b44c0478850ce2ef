//! Quintic polynomials between two states that hold their end.

use super::Polynomial;

/// A quintic [`Polynomial`] in a parameter that starts at 0; beyond its end the end value is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quintic(Polynomial);

impl Quintic {
    /// The quintic from `start` to `end`, each (value, first, second derivative), over `length > 0`.
    pub fn between(start: [f64; 3], end: [f64; 3], length: f64) -> Self {
        let held = Polynomial::constant(end[0], length);
        Self(Polynomial::quintic(start, end, length).unwrap_or(held))
    }

    /// Value and first three derivatives at `p`; beyond the end the end value is held.
    pub fn evaluate(&self, p: f64) -> [f64; 4] {
        let length = self.0.length();
        let at = self.0.at(p.clamp(0.0, length.max(0.0)));
        if p >= length { [at[0], 0.0, 0.0, 0.0] } else { at }
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
        for (c, e) in curve.0.coefficients().iter().zip(expected) {
            assert!((c - e).abs() < 1e-15, "{c} is not {e}");
        }
        let [l, dl, ..] = curve.evaluate(10.0);
        assert!((l - 0.00625).abs() < 1e-15 && (dl + 0.0925).abs() < 1e-15);
    }
}
