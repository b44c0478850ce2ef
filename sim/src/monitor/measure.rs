//! From observations to metrics: extremes with their moment, longest spans, percentiles and limits.

use crate::verdict::Metric;
use corridor_decider::frame::ObstacleId;

/// The most extreme value seen, with its time and obstacle. Once not-a-number, always not-a-number: a broken
/// measurement must fail its limit and not hide behind a later sound one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Extreme {
    pub(super) value: Option<f64>,
    pub(super) time: Option<f64>,
    pub(super) obstacle: Option<ObstacleId>,
}

impl Extreme {
    /// Keeps the larger value; the earlier one of equals.
    pub(super) fn raise(&mut self, value: f64, time: f64, obstacle: Option<ObstacleId>) {
        if self.value.is_none_or(|best| value > best || value.is_nan()) {
            self.set(value, time, obstacle);
        }
    }

    /// Keeps the smaller value; the earlier one of equals.
    pub(super) fn lower(&mut self, value: f64, time: f64, obstacle: Option<ObstacleId>) {
        if self.value.is_none_or(|best| value < best || value.is_nan()) {
            self.set(value, time, obstacle);
        }
    }

    fn set(&mut self, value: f64, time: f64, obstacle: Option<ObstacleId>) {
        *self = Self {
            value: Some(value),
            time: Some(time),
            obstacle,
        };
    }

    /// A metric of this value.
    pub(super) fn measure(&self, name: &'static str) -> Measure {
        Measure::new(name, self.value).at(self.time).with(self.obstacle)
    }
}

/// The longest time for which something held without a break, sampled.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LongestSpan {
    since: Option<f64>,
    longest: Extreme,
}

impl LongestSpan {
    /// Takes the next sample and gives the length of the span it belongs to, s.
    pub(super) fn sample(&mut self, holds: bool, time: f64) -> f64 {
        if !holds {
            self.since = None;
            return 0.0;
        }
        let span = time - *self.since.get_or_insert(time);
        self.longest.raise(span, time, None);
        span
    }

    /// The longest span, s; 0 where it never held.
    pub(super) fn measure(&self, name: &'static str) -> Measure {
        let longest = self.longest.value.unwrap_or(0.0);
        self.longest.measure(name).value(Some(longest))
    }
}

/// What a value is compared with.
#[derive(Clone, Copy, Debug)]
enum Limit {
    Reported,
    AtMost(f64),
    Below(f64),
    AtLeast(f64),
    Above(f64),
}

/// A metric in the making: names of obstacles are filled in at the end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measure {
    name: &'static str,
    value: Option<f64>,
    limit: Limit,
    gate: bool,
    time: Option<f64>,
    obstacle: Option<ObstacleId>,
}

impl Measure {
    /// A reported value.
    pub(super) fn new(name: &'static str, value: Option<f64>) -> Self {
        Self {
            name,
            value,
            limit: Limit::Reported,
            gate: false,
            time: None,
            obstacle: None,
        }
    }

    /// The same with another value.
    pub(super) fn value(self, value: Option<f64>) -> Self {
        Self { value, ..self }
    }

    /// The time of its worst moment.
    pub(super) fn at(self, time: Option<f64>) -> Self {
        Self { time, ..self }
    }

    /// The obstacle of its worst moment.
    pub(super) fn with(self, obstacle: Option<ObstacleId>) -> Self {
        Self { obstacle, ..self }
    }

    /// Good while the value is not above `limit`.
    pub(super) fn at_most(self, limit: f64) -> Self {
        let limit = Limit::AtMost(limit);
        Self { limit, ..self }
    }

    /// Good while the value is below `limit`.
    pub(super) fn below(self, limit: f64) -> Self {
        let limit = Limit::Below(limit);
        Self { limit, ..self }
    }

    /// Good while the value is not below `limit`.
    pub(super) fn at_least(self, limit: f64) -> Self {
        let limit = Limit::AtLeast(limit);
        Self { limit, ..self }
    }

    /// Good while the value is above `limit`.
    pub(super) fn above(self, limit: f64) -> Self {
        let limit = Limit::Above(limit);
        Self { limit, ..self }
    }

    /// Failing it fails the run.
    pub(super) fn gate(self) -> Self {
        self.gate_if(true)
    }

    /// Failing it fails the run when `gate` holds.
    pub(super) fn gate_if(self, gate: bool) -> Self {
        Self { gate, ..self }
    }

    fn pass(&self) -> bool {
        self.value.is_none_or(|value| match self.limit {
            Limit::Reported => true,
            Limit::AtMost(limit) => value <= limit,
            Limit::Below(limit) => value < limit,
            Limit::AtLeast(limit) => value >= limit,
            Limit::Above(limit) => value > limit,
        })
    }

    /// The finished metric; `names` are those of the obstacles, by their ids.
    pub(super) fn into_metric(self, names: &[String]) -> Metric {
        let threshold = match self.limit {
            Limit::Reported => None,
            Limit::AtMost(limit) | Limit::Below(limit) | Limit::AtLeast(limit) | Limit::Above(limit) => {
                Some(limit)
            }
        };
        Metric {
            name: self.name.to_owned(),
            value: self.value,
            threshold,
            pass: self.pass(),
            gate: self.gate,
            worst_t: self.time,
            worst_obstacle: self.obstacle.map(|id| name_of(names, id)),
        }
    }
}

/// Name of an obstacle; its number when the scenario knows none such.
pub(super) fn name_of(names: &[String], id: ObstacleId) -> String {
    names
        .get(id.0 as usize)
        .cloned()
        .unwrap_or_else(|| format!("obstacle {}", id.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn not_a_number_sticks_and_fails_every_limit() {
        let mut worst = Extreme::default();
        for value in [1.0, f64::NAN, 2.0, -1.0] {
            worst.raise(value, 0.5, None);
        }
        assert!(worst.value.unwrap().is_nan());
        assert!(!worst.measure("x").at_most(1e9).into_metric(&[]).pass);
        assert!(!worst.measure("x").at_least(-1e9).into_metric(&[]).pass);
    }

    #[test]
    fn a_span_is_longest_without_a_break() {
        let mut span = LongestSpan::default();
        for (time, holds) in [(0.0, true), (0.1, true), (0.2, false), (0.3, true), (0.9, true)] {
            span.sample(holds, time);
        }
        let measure = span.measure("x");
        let metric = measure.into_metric(&[]);
        assert!((metric.value.unwrap() - 0.6).abs() < 1e-12 && metric.worst_t == Some(0.9));
    }

    #[test]
    fn limits_hold_from_their_own_side() {
        let pass = |measure: Measure| measure.into_metric(&[]).pass;
        let at = |value| Measure::new("x", Some(value));
        assert!(pass(at(1.0).at_most(1.0)) && !pass(at(1.0 + 1e-12).at_most(1.0)));
        assert!(pass(at(1.0).at_least(1.0)) && !pass(at(1.0 - 1e-12).at_least(1.0)));
        assert!(!pass(at(1.0).below(1.0)) && pass(at(1.0 - 1e-12).below(1.0)));
        assert!(!pass(at(1.0).above(1.0)) && pass(at(1.0 + 1e-12).above(1.0)));
        assert!(pass(Measure::new("x", None).below(1.0)));
    }
}
