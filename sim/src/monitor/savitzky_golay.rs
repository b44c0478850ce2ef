//! Smoothed values and derivatives of equally spaced samples: Savitzky and Golay (1964), second order.
//!
//! A parabola is fitted to each window by least squares and read at the window's middle; near the ends the
//! outermost window's parabola is read off its middle (scipy's `mode="interp"`). A window of even length has its
//! middle between two samples; the value is then half a sample late, as with scipy.

/// The derivative of order `order` (0, 1 or 2) at every sample; `period` between samples in seconds.
///
/// A series shorter than the window is fitted as a whole; fewer than three samples have no parabola: empty.
pub(super) fn derivative(values: &[f64], window: usize, order: u8, period: f64) -> Vec<f64> {
    let window = window.min(values.len());
    if window < 3 {
        return Vec::new();
    }
    let last_start = values.len() - window;
    (0..values.len())
        .map(|k| {
            let start = k.saturating_sub(window / 2).min(last_start);
            let in_the_middle = k >= window / 2 && k - window / 2 <= last_start;
            let middle = (window - 1) as f64 / 2.0;
            let at = if in_the_middle {
                0.0
            } else {
                (k - start) as f64 - middle
            };
            Parabola::fit(&values[start..start + window]).derivative(order, at, period)
        })
        .collect()
}

/// `c0 + c1 x + c2 x²`, `x` in samples from the window's middle.
struct Parabola {
    c: [f64; 3],
}

impl Parabola {
    /// The least-squares fit. Sums of odd powers vanish by symmetry, so `c1` stands alone.
    fn fit(values: &[f64]) -> Self {
        let middle = (values.len() - 1) as f64 / 2.0;
        let (mut x2, mut x4) = (0.0, 0.0);
        let (mut y, mut xy, mut x2y) = (0.0, 0.0, 0.0);
        for (k, value) in values.iter().enumerate() {
            let x = k as f64 - middle;
            x2 += x * x;
            x4 += x * x * x * x;
            y += value;
            xy += x * value;
            x2y += x * x * value;
        }
        let n = values.len() as f64;
        let determinant = n * x4 - x2 * x2;
        let c2 = (n * x2y - x2 * y) / determinant;
        Self {
            c: [(y - c2 * x2) / n, xy / x2, c2],
        }
    }

    fn derivative(&self, order: u8, x: f64, period: f64) -> f64 {
        let [c0, c1, c2] = self.c;
        match order {
            0 => c0 + x * (c1 + x * c2),
            1 => (c1 + 2.0 * x * c2) / period,
            _ => 2.0 * c2 / (period * period),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parabolas_are_differentiated_exactly_to_their_ends() {
        let f = |t: f64| 1.5 - 0.7 * t + 0.3 * t * t;
        let values: Vec<f64> = (0..40).map(|k| f(f64::from(k) * 0.1)).collect();
        for (k, t) in (0..40).map(|k| (k, k as f64 * 0.1)) {
            let d = |order| derivative(&values, 15, order, 0.1)[k];
            assert!((d(0) - f(t)).abs() < 1e-10);
            assert!((d(1) - (-0.7 + 0.6 * t)).abs() < 1e-10);
            assert!((d(2) - 0.6).abs() < 1e-9);
        }
    }

    /// The published smoothing weights for five points: (-3, 12, 17, 12, -3) / 35.
    #[test]
    fn an_impulse_gives_the_published_weights() {
        let mut values = [0.0; 9];
        values[4] = 35.0;
        let smooth = derivative(&values, 5, 0, 1.0);
        for (found, expected) in smooth[2..7].iter().zip([-3.0, 12.0, 17.0, 12.0, -3.0]) {
            assert!((found - expected).abs() < 1e-12);
        }
        assert!(derivative(&values[..2], 5, 0, 1.0).is_empty());
        assert_eq!(derivative(&values[..3], 5, 1, 1.0).len(), 3);
    }
}
