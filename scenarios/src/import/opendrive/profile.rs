//! Piecewise cubics along the road: lane widths, lane borders and the lane offset.

/// A cubic that holds from station `s` on: `a + b ds + c ds² + d ds³`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cubic {
    /// First station, m.
    pub(super) s: f64,
    /// Coefficients of ds⁰ to ds³.
    pub(super) coefficients: [f64; 4],
}

/// Records by ascending station; the last one at or before a station rules there.
#[derive(Clone, Debug, Default)]
pub(super) struct Profile(Vec<Cubic>);

impl Profile {
    pub(super) fn new(mut records: Vec<Cubic>) -> Self {
        records.sort_by(|a, b| a.s.total_cmp(&b.s));
        Self(records)
    }

    /// Value, first and second derivative at `s`, of the record that rules at `ruling`. Zero before the first.
    ///
    /// The two stations differ at the end of a stretch only, where the record that ends must answer.
    pub(super) fn at(&self, s: f64, ruling: f64) -> [f64; 3] {
        let past = self.0.partition_point(|record| record.s <= ruling);
        let Some(record) = past.checked_sub(1).map(|k| self.0[k]) else {
            return [0.0; 3];
        };
        let [a, b, c, d] = record.coefficients;
        let ds = s - record.s;
        [
            a + ds * (b + ds * (c + ds * d)),
            b + ds * (2.0 * c + ds * 3.0 * d),
            2.0 * c + 6.0 * d * ds,
        ]
    }

    /// Where records begin.
    pub(super) fn starts(&self) -> impl Iterator<Item = f64> + '_ {
        self.0.iter().map(|record| record.s)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_record_at_or_before_rules() {
        let cubic = |s, a, b| Cubic {
            s,
            coefficients: [a, b, 0.5, 0.0],
        };
        let profile = Profile::new(vec![cubic(10.0, 7.0, 0.0), cubic(1.0, 2.0, 1.0)]);
        let cases = [
            (0.5, 0.5, [0.0; 3]),
            (3.0, 3.0, [6.0, 3.0, 1.0]),
            (10.0, 10.0, [7.0, 0.0, 1.0]),
            // The record that ends at 10 answers when it is asked for.
            (10.0, 9.99, [2.0 + 9.0 + 40.5, 10.0, 1.0]),
        ];
        for (s, ruling, expected) in cases {
            for (is, expected) in profile.at(s, ruling).into_iter().zip(expected) {
                assert!((is - expected).abs() < 1e-12, "at {s}: {is} is not {expected}");
            }
        }
    }
}
