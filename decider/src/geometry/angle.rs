//! Angles in radians, counter-clockwise, normalised to `(-π, π]`.

use std::f64::consts::PI;

/// The same direction in `(-π, π]`. Not-a-number stays not-a-number.
pub fn wrap(theta: f64) -> f64 {
    if theta > -PI && theta <= PI {
        return theta;
    }
    let turned = theta - 2.0 * PI * (theta / (2.0 * PI)).round();
    // Rounding may leave a last bit outside.
    if turned <= -PI {
        (turned + 2.0 * PI).min(PI)
    } else {
        turned.min(PI)
    }
}

/// The smallest turn from `from` to `to`, in `(-π, π]`.
pub fn difference(to: f64, from: f64) -> f64 {
    wrap(to - from)
}

/// Sine and cosine, the same bits everywhere.
pub fn sin_cos(theta: f64) -> (f64, f64) {
    libm::sincos(theta)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrapping_keeps_the_direction_and_the_half_open_range() {
        for k in -7..=7 {
            for theta in [-3.1, -1.0, 0.0, 0.3, 3.1, PI] {
                let wrapped = wrap(theta + 2.0 * PI * f64::from(k));
                assert!(
                    difference(wrapped, theta).abs() < 1e-12 && wrapped > -PI && wrapped <= PI,
                    "{theta} + {k} turns gave {wrapped}"
                );
            }
        }
        assert!((wrap(-PI) - PI).abs() < 1e-15);
    }
}
