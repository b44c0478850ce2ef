//! Lines for tests.

use super::{LinePoint, LineSample, ReferenceLine};
use crate::geometry::angle::{sin_cos, wrap};
use crate::road::{BoundaryType, LaneId};

/// A line from the origin along `+x` whose curvature at `s` is `kappa(s)`, sampled every half metre:
/// lanes of 3.5 m, an oncoming lane to the left, half a metre of road beyond the lanes.
pub(crate) fn line(length: f64, kappa: impl Fn(f64) -> f64) -> ReferenceLine {
    const FINE: usize = 64;
    let mut samples = Vec::new();
    let (mut x, mut y, mut theta, mut s) = (0.0, 0.0, 0.0, 0.0);
    while s <= length {
        samples.push(sample(
            s,
            LinePoint {
                x,
                y,
                theta: wrap(theta),
                kappa: kappa(s),
            },
        ));
        let step = 0.5 / FINE as f64;
        for _ in 0..FINE {
            let middle = theta + kappa(s + step / 2.0) * step / 2.0;
            let (sin, cos) = sin_cos(middle);
            (x, y) = (x + cos * step, y + sin * step);
            theta += kappa(s + step / 2.0) * step;
            s += step;
        }
    }
    ReferenceLine::from(samples)
}

/// 260 m with bends of 50 m radius both ways, straight at both ends.
pub(crate) fn s_curve() -> ReferenceLine {
    line(260.0, |s| match s {
        s if (20.0..240.0).contains(&s) => 0.02 * sin_cos((s - 20.0) / 220.0 * std::f64::consts::TAU).0,
        _ => 0.0,
    })
}

fn sample(s: f64, point: LinePoint) -> LineSample {
    LineSample {
        s,
        point,
        lane: LaneId(0),
        offset: 0.0,
        lane_width: (1.75, 1.75),
        road_width: (5.75, 2.25),
        marks: (BoundaryType::DottedWhite, BoundaryType::SolidWhite),
        neighbours: [None, Some(3.5), None, None],
        in_junction: false,
        speed_limit: None,
    }
}
