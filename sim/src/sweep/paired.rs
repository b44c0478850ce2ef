//! What can be claimed of two deciders that were run on the same seeds: a test of how often each has an outcome, a
//! range for how far a metric differs, and a correction for asking many questions at once.
//!
//! `McNemar` (1947) by exact binomial tails; the interval of a median by order statistics, as in Conover, *Practical
//! Nonparametric Statistics*; Holm (1979). None of them assumes how a metric is distributed. All treat the pairs as
//! independent.

use super::statistics::{at_most_heads, percentile};
use serde::Serialize;

/// A median with the range in which the true one lies at the confidence asked for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Median {
    /// The median of what was seen.
    pub value: f64,
    /// The range; `None` where there is too little to bound it: fewer than six values at 95 %.
    pub range: Option<(f64, f64)>,
}

/// Probability that two deciders that are equally good differ at least so much: the two-sided test of the seeds on
/// which they differ, from the number of those that only the one and only the other passes.
pub fn mcnemar(only_first: u64, only_second: u64) -> f64 {
    let all = only_first + only_second;
    let few = only_first.min(only_second);
    (2.0 * at_most_heads(few, all)).min(1.0)
}

/// The median of `values` and its range at `confidence`: from one of the values to another, so chosen that it misses
/// the true median no more often than it may, whatever the distribution. `None` of nothing.
pub fn median(values: &[f64], confidence: f64) -> Option<Median> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let value = percentile(&sorted, 50.0)?;
    let range =
        values_left_out(sorted.len(), confidence).map(|out| (sorted[out], sorted[sorted.len() - 1 - out]));
    Some(Median { value, range })
}

/// How many of `count` sorted values may be left out at either end; `None`: the whole range promises too little.
///
/// The true median lies below the value after `out` others only if at most `out` values do, each with a chance of ½.
fn values_left_out(count: usize, confidence: f64) -> Option<usize> {
    let misses = |out: usize| 2.0 * at_most_heads(out as u64, count as u64);
    let allowed = 1.0 - confidence;
    let (mut good, mut bad) = (0, count / 2);
    if bad == 0 || misses(good) > allowed {
        return None;
    }
    while bad - good > 1 {
        let middle = usize::midpoint(good, bad);
        if misses(middle) <= allowed {
            good = middle;
        } else {
            bad = middle;
        }
    }
    Some(good)
}

/// The probabilities of several tests corrected for their number, in the order given: to call every test significant
/// whose corrected probability is at most `alpha` is wrong about any of them with a chance of at most `alpha`.
pub fn holm(probabilities: &[f64]) -> Vec<f64> {
    let count = probabilities.len();
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|a, b| probabilities[*a].total_cmp(&probabilities[*b]).then(a.cmp(b)));
    let mut corrected = vec![1.0; count];
    let mut largest = 0.0_f64;
    for (k, place) in order.into_iter().enumerate() {
        largest = largest.max((count - k) as f64 * probabilities[place]).min(1.0);
        corrected[place] = largest;
    }
    corrected
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Share of all 2ⁿ ways to hand the seeds on which they differ to the one or the other that are at least as uneven.
    fn by_enumeration(first: u32, second: u32) -> f64 {
        let all = first + second;
        let uneven = first.abs_diff(second);
        let ways = (0_u32..1 << all).filter(|way| {
            let ones = way.count_ones();
            ones.abs_diff(all - ones) >= uneven
        });
        ways.count() as f64 / f64::from(1_u32 << all)
    }

    #[test]
    fn mcnemar_is_the_share_of_ways_that_are_as_uneven() {
        for first in 0..8 {
            for second in 0..8 {
                let found = mcnemar(u64::from(first), u64::from(second));
                let expected = by_enumeration(first, second);
                assert!((found - expected).abs() < 1e-13, "{first}, {second}: {found}");
            }
        }
    }

    /// As `scipy.stats.binomtest` has them.
    #[test]
    fn mcnemar_of_many_seeds_is_that_of_another_program() {
        let cases = [
            (6, 59, 4.964_650_327_128_616e-12),
            (121, 59, 4.434_449_263_754_164e-6),
            (1000, 1100, 0.030_720_707_864_242_49),
        ];
        for (first, second, expected) in cases {
            let found = mcnemar(first, second);
            assert!(
                (found / expected - 1.0).abs() < 1e-10,
                "{first}, {second}: {found:e}"
            );
        }
    }

    /// Of six values the whole range misses the median with a chance of 2/64 = 3.1 %; of five, with 6.3 %. Of 20, five
    /// may be left out on either side (4.1 %), of 100, 39 (3.5 %).
    #[test]
    fn the_range_of_a_median_is_the_worked_one() {
        let cases = [
            (5, None),
            (6, Some(0)),
            (8, Some(0)),
            (9, Some(1)),
            (20, Some(5)),
            (100, Some(39)),
        ];
        for (count, out) in cases {
            assert_eq!(values_left_out(count, 0.95), out, "{count}");
        }
        assert_eq!(median(&[], 0.95), None);
        let values: Vec<f64> = (0..20).rev().map(f64::from).collect();
        let found = median(&values, 0.95).unwrap();
        assert_eq!((found.value, found.range), (9.5, Some((5.0, 14.0))));
    }

    /// The chance to miss is added up over all 2ⁿ ways to lie on either side of the median.
    #[test]
    fn the_range_holds_what_it_promises_and_a_narrower_one_would_not() {
        for count in 6_usize..=16 {
            let out = values_left_out(count, 0.95).unwrap();
            let misses = |out: usize| {
                let ways = (0_u32..1 << count).filter(|way| {
                    let below = way.count_ones() as usize;
                    below <= out || count - below <= out
                });
                ways.count() as f64 / f64::from(1_u32 << count)
            };
            assert!(misses(out) <= 0.05, "{count}");
            assert!(misses(out + 1) > 0.05, "{count}");
        }
    }

    /// Holm's steps by hand: 4·0.01, 3·0.013, 2·0.03, 1·0.04, none below the one before.
    #[test]
    fn holm_is_the_worked_numbers() {
        let corrected = holm(&[0.03, 0.01, 0.04, 0.013]);
        for (found, expected) in corrected.iter().zip([0.06, 0.04, 0.06, 0.04]) {
            assert!((found - expected).abs() < 1e-15, "{corrected:?}");
        }
        assert_eq!(holm(&[0.7, 0.9]), [1.0, 1.0]);
        assert!(holm(&[]).is_empty());
    }
}
