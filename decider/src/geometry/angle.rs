//! Angles in radians, counter-clockwise, normalised to `(-π, π]`.

use super::Vec2;
use std::f64::consts::PI;

/// Largest turn for which series of the sine and the cosine are exact to the last digit, rad.
const SMALL_TURN: f64 = 0.125;

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

/// A vector turned to the left.
#[inline]
pub(crate) fn turned(v: Vec2, by: f64) -> Vec2 {
    let (sin, cos) = if by.abs() <= SMALL_TURN {
        let q = by * by;
        (
            by * (1.0 + q * (-1.0 / 6.0 + q * (1.0 / 120.0 + q * (-1.0 / 5040.0 + q / 362_880.0)))),
            1.0 + q * (-0.5 + q * (1.0 / 24.0 + q * (-1.0 / 720.0 + q * (1.0 / 40_320.0 - q / 3_628_800.0)))),
        )
    } else {
        sin_cos(by)
    };
    Vec2::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos)
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

    #[test]
    fn turning_a_vector_is_exact_up_to_rounding() {
        for k in -300..=300 {
            let by = f64::from(k) * 0.01;
            let (sin, cos) = sin_cos(by);
            let v = turned(Vec2::new(0.6, -0.8), by);
            let exact = Vec2::new(0.6 * cos + 0.8 * sin, 0.6 * sin - 0.8 * cos);
            assert!((v - exact).norm() < 3e-16, "{by}: {v} {exact}");
        }
    }
}
