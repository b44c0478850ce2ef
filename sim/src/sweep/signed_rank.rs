//! Wilcoxon's signed-rank test (1945): whether the differences of pairs lie about 0.
//!
//! Pairs without a difference are left out, as Wilcoxon did; equal differences share the mean of their ranks. Up to
//! [`EXACT`] differences the probability is exact, ties included: every way to sign the ranks is counted. Beyond, it
//! is that of the normal distribution, with the variance corrected for ties and half a rank for continuity.

/// Most differences that are counted exactly. Beyond, the normal distribution is good to some hundredths of what it
/// gives wherever that is not tiny.
pub const EXACT: usize = 50;

/// Two-sided probability that differences drawn from a distribution symmetric about 0 are at least as one-sided as
/// these. 1 where nothing differs. Not-a-number is not a difference: it is left out.
pub fn signed_rank(differences: &[f64]) -> f64 {
    let mut differences: Vec<f64> = differences.iter().copied().filter(|d| d.abs() > 0.0).collect();
    differences.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let ranks = Ranks::of(&differences);
    if differences.is_empty() {
        1.0
    } else if differences.len() <= EXACT {
        ranks.exact()
    } else {
        ranks.approximate()
    }
}

/// Ranks of the magnitudes, doubled: the mean of two neighbouring ranks is then whole, too.
struct Ranks {
    doubled: Vec<usize>,
    /// Sum of those of positive differences.
    positive: usize,
    /// Σ (t³ − t) over groups of `t` equal magnitudes.
    ties: f64,
}

impl Ranks {
    /// The ranks of differences that are sorted by magnitude.
    fn of(sorted: &[f64]) -> Self {
        let mut ranks = Self {
            doubled: Vec::with_capacity(sorted.len()),
            positive: 0,
            ties: 0.0,
        };
        for group in sorted.chunk_by(|a, b| a.abs().total_cmp(&b.abs()).is_eq()) {
            let before = ranks.doubled.len();
            // The mean of the ranks `before + 1` to `before + length`, twice.
            let doubled = 2 * before + 1 + group.len();
            let positive = group.iter().filter(|d| **d > 0.0).count();
            ranks.positive += positive * doubled;
            ranks.doubled.extend(group.iter().map(|_| doubled));
            let t = group.len() as f64;
            ranks.ties += t * t * t - t;
        }
        ranks
    }

    /// Both tails of the distribution of the sum over all ways to sign the ranks, each as likely.
    fn exact(&self) -> f64 {
        let total: usize = self.doubled.iter().sum();
        let mut chance = vec![0.0; total + 1];
        chance[0] = 1.0;
        let mut reached = 0;
        for rank in &self.doubled {
            reached += rank;
            for sum in (0..=reached).rev() {
                let with = if sum >= *rank { chance[sum - rank] } else { 0.0 };
                chance[sum] = 0.5 * (chance[sum] + with);
            }
        }
        let tail = self.positive.min(total - self.positive);
        let below: f64 = chance[..=tail].iter().sum();
        (2.0 * below).min(1.0)
    }

    fn approximate(&self) -> f64 {
        let n = self.doubled.len() as f64;
        let sum = 0.5 * self.positive as f64;
        let mean = n * (n + 1.0) / 4.0;
        let variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - self.ties / 48.0;
        let z = ((sum - mean).abs() - 0.5).max(0.0) / variance.sqrt();
        libm::erfc(z * std::f64::consts::FRAC_1_SQRT_2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Share of all 2ⁿ ways to sign the differences whose sum of positive ranks is at least as far from its mean. Ranks
    /// by counting what is smaller and what is not larger.
    fn by_enumeration(differences: &[f64]) -> f64 {
        let differing: Vec<f64> = differences.iter().copied().filter(|d| d.abs() > 0.0).collect();
        let rank = |d: &f64| {
            let smaller = differing.iter().filter(|o| o.abs() < d.abs()).count() as f64;
            let not_larger = differing.iter().filter(|o| o.abs() <= d.abs()).count() as f64;
            0.5 * (smaller + not_larger + 1.0)
        };
        let ranks: Vec<f64> = differing.iter().map(rank).collect();
        let mean = 0.5 * ranks.iter().sum::<f64>();
        let off = |is_positive: &dyn Fn(usize) -> bool| {
            let positive = ranks.iter().enumerate().filter(|(k, _)| is_positive(*k));
            (positive.map(|(_, rank)| rank).sum::<f64>() - mean).abs()
        };
        let seen = off(&|k| differing[k] > 0.0);
        let ways = (0_u32..1 << ranks.len()).filter(|way| off(&|k| way >> k & 1 == 1) >= seen - 1e-9);
        ways.count() as f64 / f64::from(1_u32 << ranks.len())
    }

    proptest! {
        #[test]
        fn exact_is_the_share_of_signs_as_one_sided(values in prop::collection::vec(-6_i32..=6, 0..=10)) {
            let tied: Vec<f64> = values.iter().map(|v| f64::from(*v)).collect();
            prop_assert!((signed_rank(&tied) - by_enumeration(&tied)).abs() < 1e-12);
            // The same signs without ties.
            let apart: Vec<f64> = (1..).zip(&tied).map(|(k, v)| v * (1.0 + f64::from(k) / 64.0)).collect();
            prop_assert!((signed_rank(&apart) - by_enumeration(&apart)).abs() < 1e-12);
        }

        #[test]
        fn neither_order_nor_scale_nor_side_matters(values in prop::collection::vec(-1e3..1e3, 0..80)) {
            let p = signed_rank(&values);
            prop_assert!((0.0..=1.0).contains(&p));
            let other: Vec<f64> = values.iter().rev().map(|v| -4.0 * v).collect();
            prop_assert!((signed_rank(&other) - p).abs() < 1e-12);
        }
    }

    /// Darwin's fifteen pairs of crossed and self-fertilised maize, in eighths of an inch (Fisher, *The Design of
    /// Experiments*): the negative ranks add up to 24, and 1352 of 2¹⁵ ways are as one-sided.
    #[test]
    fn darwins_maize_is_the_worked_number() {
        let differences = [
            49.0, -67.0, 8.0, 16.0, 6.0, 23.0, 28.0, 41.0, 14.0, 29.0, 56.0, 24.0, 75.0, 60.0, -48.0,
        ];
        assert!((signed_rank(&differences) - 1352.0 / 32768.0).abs() < 1e-15);
    }

    /// As `scipy.stats.wilcoxon(…, zero_method="wilcox", correction=True, method="approx")` has them: 60 differences
    /// of which some are tied and one more is 0, and 120 of which nearly all are tied.
    #[test]
    fn many_differences_give_what_another_program_gives() {
        let some: Vec<f64> = (0..61).map(|k| f64::from(k * 37 % 61 - 24) / 4.0).collect();
        let nearly_all: Vec<f64> = (0..120).map(|k| f64::from(k * k * 7 % 23 - 9)).collect();
        for (differences, expected) in [
            (some, 0.016_227_476_697_008_532),
            (nearly_all, 3.105_623_867_426_989e-11),
        ] {
            let found = signed_rank(&differences);
            assert!((found / expected - 1.0).abs() < 1e-9, "{found:e}");
        }
    }

    /// Where the exact one ends the other goes on: with one difference more or less, they are nearly the same.
    #[test]
    fn the_approximation_meets_the_exact_probability() {
        let differences = |count: i32| {
            let sign = |k: i32| if k % 3 == 0 { -1.0 } else { 1.0 };
            (1..=count).map(|k| sign(k) * f64::from(k)).collect::<Vec<f64>>()
        };
        let mut sorted = differences(50);
        sorted.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
        let ranks = Ranks::of(&sorted);
        let (exact, approximate) = (ranks.exact(), ranks.approximate());
        assert!((approximate / exact - 1.0).abs() < 0.05, "{exact} {approximate}");
    }

    #[test]
    fn nothing_that_differs_is_no_evidence() {
        for differences in [&[][..], &[0.0, -0.0, 0.0], &[f64::NAN]] {
            assert!((signed_rank(differences) - 1.0).abs() < 1e-15);
        }
        assert!((signed_rank(&[3.0]) - 1.0).abs() < 1e-15);
    }
}
