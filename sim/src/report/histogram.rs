//! How often a metric took which value, passed and failed runs apart: what the page of a sweep draws.

use crate::sweep::SweepRow;

/// Bars of a histogram.
const BINS: usize = 40;

/// One metric's bars over `low..high`; what lies outside is counted in the outermost bar.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Histogram {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    pub(super) low: f64,
    pub(super) high: f64,
    /// Passed and failed runs in each bar.
    pub(super) bars: [[u64; 2]; BINS],
}

/// What is drawn: the name of the metric, its unit and the ends of its axis. `duration` is that of the run.
const DRAWN: [(&str, &str, f64, f64); 8] = [
    ("nuplan_cls", "", 0.0, 1.0),
    ("ext_cls", "", 0.0, 1.0),
    ("min_clearance", "m", 0.0, 4.0),
    ("ttc", "s", 0.0, 3.0),
    ("progress", "", 0.0, 1.0),
    ("duration", "s", 0.0, 60.0),
    ("braking", "m/s²", 0.0, 8.0),
    ("fallback_ratio", "", 0.0, 1.0),
];

/// All histograms of a sweep.
#[derive(Clone, Debug)]
pub(super) struct Histograms(Vec<Histogram>);

impl Default for Histograms {
    fn default() -> Self {
        let empty = |(name, unit, low, high)| Histogram {
            name,
            unit,
            low,
            high,
            bars: [[0; 2]; BINS],
        };
        Self(DRAWN.map(empty).into())
    }
}

impl Histograms {
    pub(super) fn add(&mut self, row: &SweepRow) {
        for histogram in &mut self.0 {
            let value = match histogram.name {
                "duration" => row.verdict().map(|verdict| verdict.duration),
                name => row.metric(name),
            };
            if let Some(value) = value {
                histogram.add(value, row.passed());
            }
        }
    }

    /// Those with anything in them.
    pub(super) fn filled(&self) -> impl Iterator<Item = &Histogram> {
        self.0.iter().filter(|histogram| histogram.highest() > 0)
    }
}

impl Histogram {
    fn add(&mut self, value: f64, passed: bool) {
        let place = (value - self.low) / (self.high - self.low) * BINS as f64;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the bars; what is no number falls into the first"
        )]
        let bar = (place.max(0.0) as usize).min(BINS - 1);
        self.bars[bar][usize::from(!passed)] += 1;
    }

    /// The count of the highest bar.
    pub(super) fn highest(&self) -> u64 {
        self.bars
            .iter()
            .map(|[passed, failed]| passed + failed)
            .max()
            .unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_fall_into_their_bars_and_outside_into_the_outermost() {
        let mut histogram = Histograms::default().0.swap_remove(2);
        for (value, passed) in [
            (0.0, true),
            (0.05, true),
            (0.1, true),
            (3.999, false),
            (77.0, true),
            (-1.0, false),
        ] {
            histogram.add(value, passed);
        }
        assert_eq!((histogram.bars[0], histogram.bars[1]), ([2, 1], [1, 0]));
        assert_eq!((histogram.bars[BINS - 1], histogram.highest()), ([1, 1], 3));
    }
}
