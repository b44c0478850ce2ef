//! The middle between two bounds, before smoothing. World frame, metres.

use super::bound_curve::BoundCurve;
use super::budget::Budget;
use super::polyline::Polyline;
use super::{Lanelet, Source};
use crate::import::ImportError;
use corridor_decider::geometry::Vec2;

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
    let count = whole(steps);
    let (left_drawn, right_drawn) = (
        BoundCurve::through(&left).drawn(count),
        BoundCurve::through(&right).drawn(count),
    );
    let middle: Vec<Vec2> = left_drawn
        .iter()
        .zip(&right_drawn)
        .map(|(a, b)| (a + b) / 2.0)
        .collect();
    let centre = evenly_spaced(&middle);
    Ok(centre.map(|centre| Strip { left, right, centre }))
}

/// The line through some points in even steps of half a metre or a little less, at least one.
fn evenly_spaced(points: &[Vec2]) -> Option<Polyline> {
    let line = Polyline::new(points).filter(|line| line.length() > LEAST_LENGTH)?;
    let even = line.resampled(whole(steps(line.length())));
    Polyline::new(&even).filter(|line| line.points().len() > 1)
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
