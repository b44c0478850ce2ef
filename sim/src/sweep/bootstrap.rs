//! How far the mean of differences may be from what was found: the paired bootstrap (Efron 1979), percentiles.
//!
//! Pairs are drawn again with replacement, from a stream of random numbers of its own: the same differences give the same
//! range on every machine.

use super::statistics::percentile;
use corridor_scenarios::random::Stream;
use serde::Serialize;

/// How often the pairs are drawn again: the ends of the range then waver by about a tenth of its width.
const RESAMPLES: u64 = 2000;

/// A mean with the range that holds it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mean {
    /// The mean.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// The mean of `values` with its range at `confidence`. `None` of nothing.
pub fn mean(values: &[f64], confidence: f64) -> Option<Mean> {
    let average = |sum: f64| sum / values.len() as f64;
    let again = |resample| {
        let mut stream = Stream::new(0, "bootstrap", resample);
        average(
            (0..values.len())
                .map(|_| values[stream.index(values.len())])
                .sum(),
        )
    };
    if values.is_empty() {
        return None;
    }
    let means: Vec<f64> = (0..RESAMPLES).map(again).collect();
    let outside = 50.0 * (1.0 - confidence);
    Some(Mean {
        value: average(values.iter().sum()),
        low: percentile(&means, outside)?,
        high: percentile(&means, 100.0 - outside)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_range_of_normal_differences_is_that_of_the_theory() {
        let values: Vec<f64> = (0..400)
            .map(|k| Stream::new(3, "normal", k).normal(0.5, 2.0))
            .collect();
        let found = mean(&values, 0.95).unwrap();
        let average = values.iter().sum::<f64>() / 400.0;
        let variance = values.iter().map(|v| (v - average) * (v - average)).sum::<f64>() / 399.0;
        let half = 1.96 * (variance / 400.0).sqrt();
        assert!((found.value - average).abs() < 1e-12);
        for (end, expected) in [(found.low, average - half), (found.high, average + half)] {
            assert!((end - expected).abs() < 0.1 * half, "{end} {expected}");
        }
    }

    #[test]
    fn it_covers_the_truth_as_often_as_it_says() {
        let covers = |sample: u64| {
            let values: Vec<f64> = (0..40)
                .map(|k| Stream::new(sample, "sample", k).uniform(-1.0, 1.0))
                .collect();
            let found = mean(&values, 0.9).unwrap();
            found.low <= 0.0 && 0.0 <= found.high
        };
        let hits = (0..200).filter(|sample| covers(*sample)).count();
        assert!((165..=193).contains(&hits), "{hits} of 200 for nine in ten");
        assert_eq!(mean(&[], 0.95), None);
        assert_eq!(
            mean(&[2.0; 9], 0.95),
            Some(Mean {
                value: 2.0,
                low: 2.0,
                high: 2.0
            })
        );
    }
}
