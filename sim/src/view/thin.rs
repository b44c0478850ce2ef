//! Fewer points and fewer digits, with no difference that could be seen.

use corridor_decider::geometry::Vec2;

/// Most that a drawn line may move when points are left out, m: half a pixel where a car fills the view.
pub(super) const TOLERANCE: f64 = 0.004;

/// Offsets beyond this are drawn as this, m: no road is as wide.
const FAR: f64 = 99.0;

/// To the millimetre. What is none becomes `null` in JSON.
pub(super) fn milli(value: f64) -> f64 {
    round(value, 1e3)
}

/// To the centimetre, or to two decimals of whatever unit.
pub(super) fn centi(value: f64) -> f64 {
    round(value, 1e2)
}

/// A lateral offset, kept within what can be drawn.
pub(super) fn offset(l: f64) -> f64 {
    milli(l.clamp(-FAR, FAR))
}

fn round(value: f64, steps: f64) -> f64 {
    // The sum turns a negative zero into a plain one.
    (value * steps).round() / steps + 0.0
}

/// Places of the points that must stay so that no point is further than [`TOLERANCE`] from the line through the
/// remaining ones (Douglas and Peucker 1973). Those of `forced` stay, so do the first and the last.
pub(super) fn keep(points: &[Vec2], forced: impl Fn(usize) -> bool) -> Vec<bool> {
    keep_within(points, TOLERANCE, forced)
}

/// As [`keep`], with another tolerance, m.
pub(crate) fn keep_within(points: &[Vec2], tolerance: f64, forced: impl Fn(usize) -> bool) -> Vec<bool> {
    let mut kept: Vec<bool> = (0..points.len())
        .map(|k| k == 0 || k + 1 == points.len() || forced(k))
        .collect();
    let anchors: Vec<usize> = (0..points.len()).filter(|k| kept[*k]).collect();
    let mut open: Vec<(usize, usize)> = anchors.windows(2).map(|pair| (pair[0], pair[1])).collect();
    while let Some((from, to)) = open.pop() {
        let distance = |k: usize| from_chord(points[from], points[to], points[k]);
        let far = |k: usize| distance(k).is_nan() || distance(k) > tolerance;
        let worst = (from + 1..to)
            .filter(|k| far(*k))
            .max_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        if let Some(k) = worst {
            kept[k] = true;
            open.extend([(from, k), (k, to)]);
        }
    }
    kept
}

/// Distance of `point` from the segment `a`–`b`.
pub(super) fn from_chord(a: Vec2, b: Vec2, point: Vec2) -> f64 {
    let along = b - a;
    let length_squared = along.norm_squared();
    let t = if length_squared > 0.0 {
        ((point - a).dot(&along) / length_squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (point - a - along * t).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_stay_and_straights_go() {
        let step: Vec<Vec2> = (0..100)
            .map(|k| Vec2::new(f64::from(k), if (40..60).contains(&k) { 1.0 } else { 0.0 }))
            .collect();
        let kept: Vec<usize> = (0..100).filter(|k| keep(&step, |_| false)[*k]).collect();
        assert_eq!(kept, [0, 39, 40, 59, 60, 99]);
        let kept = keep(&step, |k| k == 7);
        assert!(kept[7] && !kept[8]);
        assert!(keep(&[], |_| false).is_empty());
    }

    #[test]
    fn what_is_left_out_lies_on_what_is_kept() {
        let arc: Vec<Vec2> = (0..500)
            .map(|k| f64::from(k) * 0.01)
            .map(|t| Vec2::new(20.0 * libm::cos(t), 20.0 * libm::sin(t)))
            .collect();
        let kept = keep(&arc, |_| false);
        let corners: Vec<usize> = (0..500).filter(|k| kept[*k]).collect();
        assert!(corners.len() < 260, "{} points kept", corners.len());
        for pair in corners.windows(2) {
            for k in pair[0]..pair[1] {
                assert!(from_chord(arc[pair[0]], arc[pair[1]], arc[k]) <= TOLERANCE);
            }
        }
    }

    #[test]
    fn numbers_that_are_none_do_not_hang_it() {
        let mut points = vec![Vec2::new(0.0, 0.0); 5];
        points[2].y = f64::NAN;
        assert!(keep(&points, |_| false)[2]);
        assert_eq!(milli(-0.0001).to_string(), "0");
        assert!((offset(f64::MAX) - FAR).abs() < 1e-9);
    }
}
