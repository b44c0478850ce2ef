//! What can be claimed after a number of runs: exact binomial bounds and percentiles.
//!
//! Bounds are one-sided Clopper–Pearson (1934): exact, hence conservative for every number of runs.

/// Confidence of all claims, unless said otherwise.
pub const CONFIDENCE: f64 = 0.95;

/// Halvings of `[0, 1]` until neighbouring doubles are reached.
const HALVINGS: u32 = 60;

/// Largest number of terms of the continued fraction; it converges in about the square root of its arguments.
const TERMS: u32 = 100_000;

/// Relative accuracy of the continued fraction.
const EPSILON: f64 = 1e-15;

/// Stands in for 0 in denominators of the continued fraction (Lentz).
const TINY: f64 = 1e-300;

/// Upper bound of the failure rate after `failures` in `runs` independent runs, at `confidence`.
///
/// 1 without any run or when every run failed. Without failures this is `1 − (1 − confidence)^(1/runs)`.
pub fn failure_rate_bound(failures: u64, runs: u64, confidence: f64) -> f64 {
    if runs == 0 || failures >= runs {
        return 1.0;
    }
    if failures == 0 {
        return -libm::expm1(libm::log1p(-confidence) / runs as f64);
    }
    // P(more than `failures` | rate) grows with the rate; find where it reaches the confidence.
    let (a, b) = (failures as f64 + 1.0, (runs - failures) as f64);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if regularised_beta(a, b, middle) < confidence {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Clean runs needed to claim, at `confidence`, that fewer than `rate` of all runs fail. `None` for a rate or a
/// confidence outside (0, 1).
pub fn runs_for_claim(rate: f64, confidence: f64) -> Option<u64> {
    let is_share = |x: f64| x > 0.0 && x < 1.0;
    if !is_share(rate) || !is_share(confidence) {
        return None;
    }
    let runs = (libm::log1p(-confidence) / libm::log1p(-rate)).ceil();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive, and saturating is right"
    )]
    let runs = runs as u64;
    Some(runs)
}

/// The percentile `p` (0 to 100) by linear interpolation between order statistics (Hyndman and Fan's type 7).
/// `None` of nothing; not-a-number sorts last.
pub fn percentile(values: &[f64], p: f64) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let place = (p / 100.0).clamp(0.0, 1.0) * last as f64;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the indices above"
    )]
    let below = place.floor() as usize;
    let above = (below + 1).min(last);
    Some(sorted[below] + (sorted[above] - sorted[below]) * (place - below as f64))
}

/// Probability of at most `few` heads in `all` throws of a fair coin.
pub(super) fn at_most_heads(few: u64, all: u64) -> f64 {
    if few >= all {
        return 1.0;
    }
    // The lower tail of the binomial distribution is the upper one of a beta distribution.
    regularised_beta((all - few) as f64, few as f64 + 1.0, 0.5)
}

/// The regularised incomplete beta function `I_x(a, b)`, for `a, b > 0`.
///
/// Continued fraction with modified Lentz (Numerical Recipes, 6.4); about 13 digits.
pub(super) fn regularised_beta(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    if x >= 1.0 {
        return 1.0;
    }
    // The fraction converges fast below the mean; above it, use the symmetry.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - regularised_beta(b, a, 1.0 - x);
    }
    let ln_front = a * libm::log(x) + b * libm::log1p(-x) - ln_beta(a, b);
    libm::exp(ln_front) * beta_fraction(a, b, x) / a
}

/// Logarithm of the beta function.
pub(super) fn ln_beta(a: f64, b: f64) -> f64 {
    libm::lgamma(a) + libm::lgamma(b) - libm::lgamma(a + b)
}

fn beta_fraction(a: f64, b: f64, x: f64) -> f64 {
    let guarded = |v: f64| if v.abs() < TINY { TINY } else { v };
    let mut c = 1.0;
    let mut d = 1.0 / guarded(1.0 - (a + b) * x / (a + 1.0));
    let mut fraction = d;
    for term in 1..=TERMS {
        let m = f64::from(term);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let mut change = 1.0;
        for step in [even, odd] {
            d = 1.0 / guarded(1.0 + step * d);
            c = guarded(1.0 + step / c);
            change = c * d;
            fraction *= change;
        }
        if (change - 1.0).abs() < EPSILON {
            break;
        }
    }
    fraction
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_for_a_claim_are_the_worked_numbers() {
        let cases = [
            (0.10, 0.95, 29),
            (0.01, 0.95, 299),
            (0.001, 0.95, 2995),
            (0.01, 0.99, 459),
            (0.001, 0.99, 4603),
        ];
        for (rate, confidence, runs) in cases {
            assert_eq!(
                runs_for_claim(rate, confidence),
                Some(runs),
                "{rate} at {confidence}"
            );
        }
        assert_eq!(runs_for_claim(0.0, 0.95), None);
        assert_eq!(runs_for_claim(0.1, 1.0), None);
    }

    #[test]
    fn bounds_after_clean_runs_are_the_worked_numbers() {
        let cases = [
            (64, 4.6, 0.05),
            (256, 1.2, 0.05),
            (500, 0.60, 0.005),
            (1000, 0.30, 0.005),
            (4096, 0.073, 0.0005),
            (10_000, 0.030, 0.0005),
        ];
        for (runs, percent, last_digit) in cases {
            let found = failure_rate_bound(0, runs, CONFIDENCE);
            assert!((found * 100.0 - percent).abs() <= last_digit, "{runs}: {found}");
            let by_power = 1.0 - libm::pow(0.05, 1.0 / runs as f64);
            assert!((found - by_power).abs() < 1e-12);
        }
    }

    /// P(X <= k) summed term by term.
    fn binomial_cdf(k: u64, n: u64, p: f64) -> f64 {
        let mut term = libm::pow(1.0 - p, n as f64);
        let mut sum = term;
        for i in 0..k {
            term *= (n - i) as f64 / (i + 1) as f64 * p / (1.0 - p);
            sum += term;
        }
        sum
    }

    #[test]
    fn at_the_bound_so_few_failures_have_a_chance_of_one_in_twenty() {
        for (failures, runs) in [
            (1, 2),
            (1, 20),
            (3, 50),
            (10, 200),
            (49, 50),
            (7, 400),
            (150, 300),
        ] {
            let bound = failure_rate_bound(failures, runs, CONFIDENCE);
            let chance = binomial_cdf(failures, runs, bound);
            assert!((chance - 0.05).abs() < 1e-9, "{failures} of {runs}: {chance}");
        }
        assert!((failure_rate_bound(5, 5, CONFIDENCE) - 1.0).abs() < 1e-15);
        assert!((failure_rate_bound(0, 0, CONFIDENCE) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn one_more_failure_raises_the_bound_and_one_more_run_lowers_it() {
        for failures in 0..20 {
            let bound = failure_rate_bound(failures, 1000, CONFIDENCE);
            assert!(bound < failure_rate_bound(failures + 1, 1000, CONFIDENCE));
            assert!(bound > failure_rate_bound(failures, 1001, CONFIDENCE));
            assert!(bound > failures as f64 / 1000.0);
        }
        let large = failure_rate_bound(400_000, 1_000_000, CONFIDENCE);
        assert!(large > 0.4 && large < 0.402, "{large}");
    }

    #[test]
    fn percentiles_interpolate() {
        let values = [4.0, 1.0, 3.0, 2.0];
        assert_eq!(percentile(&values, 0.0), Some(1.0));
        assert_eq!(percentile(&values, 100.0), Some(4.0));
        assert_eq!(percentile(&values, 50.0), Some(2.5));
        assert_eq!(
            percentile(&values, 95.0).map(|v| (v * 1e9).round() / 1e9),
            Some(3.85)
        );
        assert_eq!(percentile(&[], 50.0), None);
        assert_eq!(percentile(&[7.0], 95.0), Some(7.0));
    }

    #[test]
    fn heads_are_counted() {
        for (few, all) in [(0, 5), (1, 10), (4, 9), (30, 64), (64, 64)] {
            let found = at_most_heads(few, all);
            assert!(
                (found - binomial_cdf(few, all, 0.5)).abs() < 1e-12,
                "{few} of {all}"
            );
        }
        assert!((at_most_heads(1, 10) - 11.0 / 1024.0).abs() < 1e-15);
    }
}
