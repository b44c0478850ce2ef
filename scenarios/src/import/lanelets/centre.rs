//! The middle between two bounds, before smoothing. World frame, metres.

use super::bound_curve::BoundCurve;
use super::polyline::Polyline;
use super::{Lanelet, Source};
use super::budget::Budget;
use crate::import::ImportError;

/// Distance of cross-sections, m.
const SPACING: f64 = 0.5;

/// A lanelet with a shorter centre line is none, m.
const LEAST_LENGTH: f64 = 1e-5;

/// The bounds of a lanelet and the line between them.
#[derive(Debug)]
pub(super) struct Strip {
    pub(super) left: Polyline,
    pub(super) right: Polyline,
    /// At least two points at even distances, half a metre or a little less.
    pub(super) centre: Polyline,
}

/// The strip of a lanelet; `None` when it has no length.
pub(super) fn strip(
    number: usize,
    budget: &mut Budget,
    source: &mut Source<'_, '_>,
) -> Result<Option<Strip>, ImportError> {
    let Lanelet { left, right, .. } = &source.lanelets[number];
    let (Some(left), Some(right)) = (Polyline::new(left), Polyline::new(right)) else {
        return Ok(None);
    };
    let steps = steps(f64::midpoint(left.length(), right.length()));
    budget.cross_sections(2.0 * steps, number, source)?;
    let (left_curve, right_curve) = (BoundCurve::through(&left), BoundCurve::through(&right));
    let middle: Vec<_> = (0..=whole(steps))
        .map(|k| {
            let share = k as f64 / steps;
            (left_curve.at(share) + right_curve.at(share)) / 2.0
        })
        .collect();
    let Some(middle) = Polyline::new(&middle).filter(|line| line.length() > LEAST_LENGTH) else {
        return Ok(None);
    };
    let even = middle.resampled(whole(self::steps(middle.length())));
    let centre = Polyline::new(&even).filter(|line| line.points().len() > 1);
    Ok(centre.map(|centre| Strip { left, right, centre }))
}

/// How many steps of half a metre at most a length takes.
fn steps(length: f64) -> f64 {
    (length / SPACING).ceil().max(1.0)
}

/// A number of steps that the budget has let through.
fn whole(steps: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at least 1, and the budget is far below 2^32"
    )]
    let whole = steps as usize;
    whole
}
