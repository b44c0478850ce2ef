//! From observations to metrics: extremes with their moment, longest spans, percentiles and limits.

use super::metrics::{self, Limit};
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

/// A metric in the making: limit, role and the obstacle's name are filled in at the end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measure {
    name: &'static str,
    value: Option<f64>,
    waived: bool,
    time: Option<f64>,
    obstacle: Option<ObstacleId>,
}

impl Measure {
    /// A value of the metric of this name.
    pub(super) fn new(name: &'static str, value: Option<f64>) -> Self {
        Self {
            name,
            value,
            waived: false,
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

    /// The same without its limit unless `holds`.
    pub(super) fn only_if(self, holds: bool) -> Self {
        Self {
            waived: !holds,
            ..self
        }
    }

    /// The finished metric; `names` are those of the obstacles, by their ids.
    pub(super) fn into_metric(self, names: &[String]) -> Metric {
        let definition = metrics::find(self.name).expect("every metric is in the list");
        let limit = definition.limit.filter(|_| !self.waived);
        let holds = |limit: Limit| self.value.is_none_or(|value| limit.holds(value));
        Metric {
            name: self.name.to_owned(),
            value: self.value,
            threshold: limit.map(Limit::threshold),
            pass: limit.is_none_or(holds),
            gate: definition.is_gate() && !self.waived,
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
        assert!(!worst.measure("drivable_area").into_metric(&[]).pass);
        assert!(!worst.measure("ttc").into_metric(&[]).pass);
    }

    #[test]
    fn a_span_is_longest_without_a_break() {
        let mut span = LongestSpan::default();
        for (time, holds) in [(0.0, true), (0.1, true), (0.2, false), (0.3, true), (0.9, true)] {
            span.sample(holds, time);
        }
        let measure = span.measure("standstill");
        let metric = measure.into_metric(&[]);
        assert!((metric.value.unwrap() - 0.6).abs() < 1e-12 && metric.worst_t == Some(0.9));
    }

    #[test]
    fn what_was_not_measured_or_is_waived_passes() {
        let metric = |value| Measure::new("progress_min", value);
        assert!(metric(None).into_metric(&[]).pass && metric(None).into_metric(&[]).gate);
        let failed = metric(Some(0.1)).into_metric(&[]);
        assert!(!failed.pass && failed.gate && failed.threshold == Some(0.2));
        let waived = metric(Some(0.1)).only_if(false).into_metric(&[]);
        assert!(waived.pass && !waived.gate && waived.threshold.is_none());
    }
}
