//! Numbers from 0 to 1, counted in bins: their quantiles to a thousandth, whatever their number.

/// Bins of a thousandth; the last one holds 1 itself.
const BINS: usize = 1001;

/// Counted shares.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Shares {
    counts: Vec<u64>,
    count: u64,
    sum: f64,
}

impl Shares {
    /// Takes in one more; what lies outside is put at the end it is nearest to, what is no number is left out.
    pub(super) fn add(&mut self, share: f64) {
        if share.is_nan() {
            return;
        }
        self.counts.resize(BINS, 0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the bins"
        )]
        let bin = (share.clamp(0.0, 1.0) * (BINS - 1) as f64).round() as usize;
        self.counts[bin] += 1;
        self.count += 1;
        self.sum += share;
    }

    /// The lower median; `None` of nothing.
    pub(super) fn median(&self) -> Option<f64> {
        let mut seen = 0;
        let half = self.count.div_ceil(2);
        let passed = self.counts.iter().position(|count| {
            seen += count;
            seen >= half
        });
        passed
            .filter(|_| self.count > 0)
            .map(|bin| bin as f64 / (BINS - 1) as f64)
    }

    /// The mean; `None` of nothing.
    pub(super) fn mean(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum / self.count as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_that_of_the_sorted_numbers_to_a_thousandth() {
        let mut shares = Shares::default();
        assert_eq!((shares.median(), shares.mean()), (None, None));
        for k in (0..=100).rev() {
            shares.add(f64::from(k * k) / 10_000.0);
        }
        shares.add(f64::NAN);
        assert!((shares.median().unwrap() - 0.25).abs() <= 0.0005 + 1e-12);
        assert!((shares.mean().unwrap() - 0.335).abs() < 1e-3);
        let mut ends = Shares::default();
        ends.add(-3.0);
        ends.add(7.0);
        assert_eq!(ends.median(), Some(0.0));
    }
}
