//! Smooths the centre lines of a chain of lanes (the use of the original's discrete-points smoother).
//!
//! Like the original's it moves discrete points and needs no model of the curve, but each point moves along one
//! normal only, so a lane's width is one limit and not a box; and it spreads changes of curvature (third differences)
//! where the original spreads curvature itself (second differences), which cuts corners and jumps where bends begin.
//! What comes out has continuous heading and curvature.

use super::line::LinePoint;
use crate::banded::System;
use crate::geometry::{Vec2, angle, cross};

/// Length over which the line's bends are spread, m: that of a car. Longer cuts corners, shorter follows the
/// kinks of a polyline.
const SMOOTHING_LENGTH: f64 = 5.0;

/// Weights of the four points of a third difference.
const THIRD: [f64; 4] = [-1.0, 3.0, -3.0, 1.0];

/// A point that may be moved to both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Anchor {
    /// Where it is on the raw line.
    pub position: Vec2,
    /// To the left.
    pub normal: Vec2,
    /// How far to the right (negative) and left it may be moved, m; equal: where it has to be.
    pub limits: (f64, f64),
}

/// How far each anchor is moved to the left, m. `step`: distance between anchors.
pub(super) fn offsets(anchors: &[Anchor], step: f64) -> Vec<f64> {
    let stretch = SMOOTHING_LENGTH / step;
    let weight = stretch * stretch * stretch * stretch * stretch * stretch;
    let mut system = System::zeros(anchors.len());
    for k in 0..anchors.len() {
        system.add(k, k, 1.0);
    }
    for (first, four) in anchors.windows(THIRD.len()).enumerate() {
        let raw: Vec2 = four
            .iter()
            .zip(THIRD)
            .map(|(anchor, c)| anchor.position * c)
            .sum();
        for (a, ca) in THIRD.iter().enumerate() {
            system.rhs[first + a] -= weight * ca * four[a].normal.dot(&raw);
            for (b, cb) in THIRD[..=a].iter().enumerate() {
                let coupling = four[a].normal.dot(&four[b].normal);
                system.add(first + a, first + b, weight * ca * cb * coupling);
            }
        }
    }
    let limits: Vec<(f64, f64)> = anchors.iter().map(|anchor| anchor.limits).collect();
    system.minimise(&limits)
}

/// Points on both sides that a difference of fourth order needs.
const SIDE: usize = 2;

/// Heading and curvature of a curve through evenly spaced points, by central differences of fourth order. Near an end
/// the curvature of the nearest point that has neighbours on both sides goes on.
pub(super) fn points(positions: &[Vec2]) -> Vec<LinePoint> {
    let last = positions.len() - 1;
    let inner = |k: usize| k.clamp(SIDE.min(last / 2), last - SIDE.min(last / 2));
    let point = |k: usize| {
        let (from, chord) = (inner(k), positions[k] - positions[inner(k)]);
        let (theta, kappa) = derivatives(positions, from);
        let ahead = if k >= from { chord.norm() } else { -chord.norm() };
        LinePoint {
            x: positions[k].x,
            y: positions[k].y,
            theta: angle::wrap(theta + kappa * ahead),
            kappa,
        }
    };
    (0..=last).map(point).collect()
}

/// Heading and curvature at one of the points, from as many neighbours as there are.
fn derivatives(positions: &[Vec2], k: usize) -> (f64, f64) {
    let here = positions[k];
    let (first, second) = if k >= SIDE && k + SIDE < positions.len() {
        let [a, b, _, c, d] = [0, 1, 2, 3, 4].map(|j| positions[k + j - SIDE]);
        (
            ((c - b) * 8.0 - (d - a)) / 12.0,
            ((c + b) * 16.0 - (d + a) - here * 30.0) / 12.0,
        )
    } else {
        let (before, after) = (
            positions[k.saturating_sub(1)],
            positions[(k + 1).min(positions.len() - 1)],
        );
        (after - before, Vec2::zeros())
    };
    let speed = first.norm();
    (
        libm::atan2(first.y, first.x),
        cross(first, second) / (speed * speed * speed),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Anchors every `step` along chords of the given lengths and turns.
    fn polyline(chords: &[(f64, f64)], step: f64, reach: f64) -> Vec<Anchor> {
        let (mut anchors, mut position, mut theta) = (Vec::new(), Vec2::zeros(), 0.0);
        for (length, turn) in chords {
            theta += turn;
            let (sin, cos) = angle::sin_cos(theta);
            let mut along = 0.0;
            while along < *length {
                anchors.push(Anchor {
                    position,
                    normal: Vec2::new(-sin, cos),
                    limits: (-reach, reach),
                });
                position += Vec2::new(cos, sin) * step;
                along += step;
            }
        }
        anchors
    }

    fn smoothed(anchors: &[Anchor], step: f64) -> (Vec<f64>, Vec<LinePoint>) {
        let offsets = offsets(anchors, step);
        let moved: Vec<Vec2> = anchors
            .iter()
            .zip(&offsets)
            .map(|(a, d)| a.position + a.normal * *d)
            .collect();
        (offsets, points(&moved))
    }

    #[test]
    fn a_circle_stays_where_it_is() {
        let radius = 25.0;
        let anchor = |k: usize| {
            let (sin, cos) = angle::sin_cos(k as f64 / radius);
            Anchor {
                position: Vec2::new(sin, 1.0 - cos) * radius,
                normal: Vec2::new(-sin, cos),
                limits: (-0.3, 0.3),
            }
        };
        let mut anchors: Vec<Anchor> = (0..60).map(anchor).collect();
        (anchors[0].limits, anchors[59].limits) = ((0.0, 0.0), (0.0, 0.0));
        let (offsets, points) = smoothed(&anchors, 1.0);
        assert!(offsets.iter().all(|d| d.abs() < 0.05), "{offsets:?}");
        for point in &points[10..50] {
            assert!((point.kappa - 1.0 / radius).abs() < 2e-3, "{point:?}");
        }
    }

    #[test]
    fn a_kink_becomes_a_bend_within_reach() {
        let anchors = polyline(&[(40.0, 0.0), (40.0, 0.3)], 1.0, 0.3);
        let (offsets, points) = smoothed(&anchors, 1.0);
        assert!(offsets.iter().all(|d| d.abs() <= 0.3));
        let steepest = points
            .windows(2)
            .map(|p| (p[1].kappa - p[0].kappa).abs())
            .fold(0.0, f64::max);
        let tightest = points.iter().map(|p| p.kappa.abs()).fold(0.0, f64::max);
        assert!(steepest < 0.03 && tightest < 0.09, "{steepest} {tightest}");
        let end = points[points.len() - 8];
        assert!(
            (end.theta - 0.3).abs() < 0.01 && end.kappa.abs() < 0.01,
            "{end:?}"
        );
    }

    proptest! {
        /// Polylines as maps have them: the line stays in reach, and curvature changes little from metre to metre.
        #[test]
        fn every_polyline_gets_continuous_curvature(
            chords in prop::collection::vec((6.0..40.0f64, -0.15..0.15f64), 2..8),
            mirrored in any::<bool>(),
        ) {
            let sign = if mirrored { -1.0 } else { 1.0 };
            let chords: Vec<(f64, f64)> = chords.iter().map(|(l, t)| (*l, sign * t)).collect();
            let (offsets, points) = smoothed(&polyline(&chords, 1.0, 0.5), 1.0);
            prop_assert!(offsets.iter().all(|d| d.abs() <= 0.5));
            for pair in points.windows(2) {
                prop_assert!((pair[1].kappa - pair[0].kappa).abs() < 0.03, "{pair:?}");
            }
        }
    }
}
