//! The laws that a number may be drawn from, and the place of a value in its law.
//!
//! A *quantile* is the value of the law's distribution function there; where the law jumps (whole numbers, choices,
//! the ends of a clamp), it is the middle of the jump, so that [`Law::at`] leads back to the same value.

use crate::random::Stream;
use serde::{Deserialize, Serialize};
use std::f64::consts::SQRT_2;

/// Beyond so many standard deviations a normal deviate is never drawn.
const FARTHEST_DEVIATE: f64 = 9.0;

/// Halvings of the interval of deviates: the last one is below the spacing of numbers at 9.
const HALVINGS: u32 = 54;

/// How a number comes about.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Law {
    Fixed(f64),
    Uniform(f64, f64),
    Normal {
        mean: f64,
        standard_deviation: f64,
        clamp: (f64, f64),
    },
    Choice(Vec<f64>),
}

/// The kind of a law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LawKind {
    /// Any number between two ends, each as likely.
    Uniform,
    /// A normal law between two ends.
    Normal,
    /// One of a list.
    Choice,
}

impl Law {
    /// The kind of law; nothing for a number that is always the same.
    pub(super) fn kind(&self) -> Option<LawKind> {
        match self {
            Self::Fixed(_) => None,
            Self::Uniform(..) => Some(LawKind::Uniform),
            Self::Normal { .. } => Some(LawKind::Normal),
            Self::Choice(_) => Some(LawKind::Choice),
        }
    }

    /// The smallest and the largest number it gives.
    pub(super) fn ends(&self) -> (f64, f64) {
        match self {
            Self::Fixed(value) => (*value, *value),
            Self::Uniform(low, high) => (*low, *high),
            Self::Normal { clamp, .. } => *clamp,
            Self::Choice(values) => (
                values.iter().copied().fold(f64::MAX, f64::min),
                values.iter().copied().fold(f64::MIN, f64::max),
            ),
        }
    }

    /// How many different numbers it gives, where they can be counted.
    pub(super) fn steps(&self, whole: bool) -> Option<usize> {
        match self {
            Self::Choice(values) => {
                let mut values = ascending(values);
                values.dedup();
                Some(values.len())
            }
            Self::Uniform(low, high)
            | Self::Normal {
                clamp: (low, high), ..
            } if whole => Some(count(*low, *high)),
            _ => None,
        }
    }

    /// Draws a number. A whole uniform number takes both ends.
    pub(super) fn draw(&self, stream: &mut Stream, whole: bool) -> f64 {
        match self {
            Self::Fixed(value) => *value,
            Self::Uniform(low, high) if whole => low + stream.index(count(*low, *high)) as f64,
            Self::Uniform(low, high) => stream.uniform(*low, *high),
            Self::Normal {
                mean,
                standard_deviation,
                clamp: (low, high),
            } => {
                let value = stream.normal(*mean, *standard_deviation).clamp(*low, *high);
                if whole { value.round() } else { value }
            }
            Self::Choice(values) => values[stream.index(values.len())],
        }
    }

    /// The quantile of a number that it gives, in `[0, 1]`.
    pub(super) fn quantile(&self, value: f64, whole: bool) -> f64 {
        let (below, up_to) = self.jump(value, whole);
        f64::midpoint(below, up_to).clamp(0.0, 1.0)
    }

    /// The shares of draws that are less than `value`, and at most `value`.
    fn jump(&self, value: f64, whole: bool) -> (f64, f64) {
        match self {
            Self::Uniform(low, high) if whole => {
                let share = 1.0 / count(*low, *high) as f64;
                ((value - low) * share, (value - low + 1.0) * share)
            }
            Self::Uniform(low, high) if high > low => {
                let share = (value - low) / (high - low);
                (share, share)
            }
            Self::Normal {
                mean,
                standard_deviation,
                clamp: (low, high),
            } if *standard_deviation > 0.0 => {
                let half = if whole { 0.5 } else { 0.0 };
                let share = |x: f64| standard_normal((x - mean) / standard_deviation);
                (
                    if value <= *low { 0.0 } else { share(value - half) },
                    if value >= *high { 1.0 } else { share(value + half) },
                )
            }
            Self::Choice(values) => {
                let share = |fits: &dyn Fn(f64) -> bool| {
                    values.iter().filter(|v| fits(**v)).count() as f64 / values.len() as f64
                };
                (share(&|v| v < value), share(&|v| v <= value))
            }
            // Always the same.
            Self::Fixed(_) | Self::Uniform(..) | Self::Normal { .. } => (0.0, 1.0),
        }
    }

    /// The number at a quantile.
    pub(super) fn at(&self, quantile: f64, whole: bool) -> f64 {
        match self {
            Self::Fixed(value) => *value,
            Self::Uniform(low, high) if whole => low + place(quantile, count(*low, *high)) as f64,
            Self::Uniform(low, high) => (low + (high - low) * quantile).clamp(*low, *high),
            Self::Normal {
                mean,
                standard_deviation,
                clamp: (low, high),
            } => {
                let value = (mean + standard_deviation * deviate(quantile)).clamp(*low, *high);
                if whole { value.round() } else { value }
            }
            Self::Choice(values) => ascending(values)[place(quantile, values.len())],
        }
    }
}

fn ascending(values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values
}

/// How many whole numbers there are from `low` to `high`.
fn count(low: f64, high: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole numbers of at most 200, ascending"
    )]
    let count = (high - low) as usize + 1;
    count
}

/// The place of a quantile among `count` equal shares.
fn place(quantile: f64, count: usize) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a share of a small number; the cast saturates"
    )]
    let place = (quantile * count as f64) as usize;
    place.min(count - 1)
}

/// The distribution function of the standard normal law.
fn standard_normal(deviate: f64) -> f64 {
    0.5 * libm::erfc(-deviate / SQRT_2)
}

/// The standard normal deviate at a quantile, to the last bits, by bisection: monotone, and no table of constants.
fn deviate(quantile: f64) -> f64 {
    let (mut low, mut high) = (-FARTHEST_DEVIATE, FARTHEST_DEVIATE);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if standard_normal(middle) < quantile {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

#[cfg(test)]
mod tests {
    #![expect(clippy::float_cmp, reason = "ends and constants are exact")]

    use super::*;

    fn laws() -> Vec<(Law, bool)> {
        let normal = |clamp| Law::Normal {
            mean: 5.0,
            standard_deviation: 1.0,
            clamp,
        };
        vec![
            (Law::Uniform(-2.0, 6.0), false),
            (Law::Uniform(2.0, 5.0), true),
            (normal((4.0, 6.0)), false),
            (normal((3.0, 9.0)), true),
            (Law::Choice(vec![8.0, 2.0, 2.0, 4.0]), false),
        ]
    }

    #[test]
    fn quantiles_are_those_of_tables() {
        let table = [
            (1.0, 0.841_344_746_068_542_9),
            (-1.959_963_984_540_054, 0.025),
            (0.0, 0.5),
        ];
        for (z, p) in table {
            assert!((standard_normal(z) - p).abs() < 1e-15, "{z}");
            assert!((deviate(p) - z).abs() < 1e-13, "{p}");
        }
        let law = Law::Normal {
            mean: 5.0,
            standard_deviation: 2.0,
            clamp: (3.0, 9.0),
        };
        assert!((law.quantile(7.0, false) - 0.841_344_746_068_543).abs() < 1e-14);
        // The ends hold all that lies beyond them: 15.87 % below 3, 2.28 % above 9.
        assert!((law.quantile(3.0, false) - 0.158_655_253_931_457 / 2.0).abs() < 1e-14);
        assert!((law.quantile(9.0, false) - (1.0 - 0.022_750_131_948_179 / 2.0)).abs() < 1e-14);
        assert!((Law::Uniform(2.0, 6.0).quantile(3.0, false) - 0.25).abs() < 1e-15);
        assert!((Law::Uniform(2.0, 5.0).quantile(3.0, true) - 0.375).abs() < 1e-15);
        let choice = Law::Choice(vec![8.0, 2.0, 2.0, 4.0]);
        let places = [2.0, 4.0, 8.0].map(|value| choice.quantile(value, false));
        assert!(
            places
                .iter()
                .zip([0.25, 0.625, 0.875])
                .all(|(a, b)| (a - b).abs() < 1e-15)
        );
    }

    #[test]
    fn a_quantile_leads_back_to_its_value() {
        for (law, whole) in laws() {
            for k in 0..2000 {
                let value = law.draw(&mut Stream::new(3, "law", k), whole);
                let quantile = law.quantile(value, whole);
                assert!((0.0..=1.0).contains(&quantile));
                let back = law.at(quantile, whole);
                assert!(
                    (back - value).abs() < 1e-12,
                    "{law:?}: {value} is at {quantile}, there is {back}"
                );
            }
            let (low, high) = law.ends();
            assert_eq!([law.at(0.0, whole), law.at(1.0, whole)], [low, high], "{law:?}");
        }
    }

    #[test]
    fn quantiles_of_draws_are_spread_evenly() {
        for (law, whole) in laws() {
            let mean = (0..4000)
                .map(|k| law.quantile(law.draw(&mut Stream::new(9, "law", k), whole), whole))
                .sum::<f64>()
                / 4000.0;
            // Five standard errors of a uniform number's mean.
            assert!((mean - 0.5).abs() < 0.023, "{law:?}: {mean}");
        }
    }

    #[test]
    fn numbers_that_can_be_counted_are() {
        let steps: Vec<Option<usize>> = laws().iter().map(|(law, whole)| law.steps(*whole)).collect();
        assert_eq!(steps, [None, Some(4), None, Some(7), Some(3)]);
        let degenerate = Law::Normal {
            mean: 5.0,
            standard_deviation: 0.0,
            clamp: (4.0, 6.0),
        };
        assert_eq!(
            (degenerate.quantile(5.0, false), degenerate.at(0.0, false)),
            (0.5, 5.0)
        );
        assert_eq!(Law::Uniform(3.0, 3.0).quantile(3.0, false), 0.5);
    }
}
