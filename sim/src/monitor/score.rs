//! `nuplan_cls` and `ext_cls`: the closed-loop scores of a run, for comparison with other planners. Never a gate.
//!
//! A product of multipliers times the mean of terms by their weights, which are those of the list of metrics. nuPlan's
//! score has four multipliers and four terms. The extended one has two terms more, and every gate on the driving as a
//! multiplier; the two are never mixed. What a run gave no occasion to measure counts as good.

use super::measure::Measure;
use super::metrics::{self, Role};
use crate::verdict::Metric;

/// How a metric becomes a term.
#[derive(Clone, Copy, Debug)]
enum Term {
    /// It is one itself.
    Value,
    /// 1 where it is good enough, else 0.
    Pass,
}

/// nuPlan's terms.
const NUPLAN_TERMS: [(&str, Term); 4] = [
    ("progress", Term::Value),
    ("ttc", Term::Pass),
    ("speed_limit", Term::Value),
    ("comfort", Term::Pass),
];

/// What the extended score adds.
const MORE_TERMS: [(&str, Term); 2] = [("lane_keep", Term::Pass), ("consistency", Term::Value)];

/// nuPlan's multipliers that are 0 or 1.
const NUPLAN_MULTIPLIERS: [&str; 2] = ["drivable_area", "progress_min"];

/// What the extended score adds.
const MORE_MULTIPLIERS: [&str; 4] = ["no_collision", "standstill", "scenario_completed", "decider_ok"];

/// Distance against the lane's direction up to which the score is whole, and half, m.
const AGAINST: [(f64, f64); 2] = [(2.0, 1.0), (6.0, 0.5)];

/// Both scores, in `[0, 1]`. `collisions` is nuPlan's multiplier for contacts.
pub(super) fn scores(metrics: &[Metric], collisions: f64) -> [Measure; 2] {
    let sheet = Sheet { metrics };
    let more = NUPLAN_TERMS.into_iter().chain(MORE_TERMS);
    let nuplan = collisions * sheet.direction() * sheet.all_pass(&NUPLAN_MULTIPLIERS);
    let extended = nuplan * sheet.all_pass(&MORE_MULTIPLIERS);
    [
        Measure::new("nuplan_cls", Some(nuplan * sheet.mean(NUPLAN_TERMS))),
        Measure::new("ext_cls", Some(extended * sheet.mean(more))),
    ]
}

/// The metrics of one run.
struct Sheet<'a> {
    metrics: &'a [Metric],
}

impl Sheet<'_> {
    fn find(&self, name: &str) -> Option<&Metric> {
        self.metrics.iter().find(|metric| metric.name == name)
    }

    /// 1 where all of these are good enough, else 0.
    fn all_pass(&self, names: &[&str]) -> f64 {
        let pass = |name: &&str| self.find(name).is_none_or(|metric| metric.pass);
        f64::from(u8::from(names.iter().all(pass)))
    }

    fn direction(&self) -> f64 {
        let against = self.find("driving_direction").and_then(|metric| metric.value);
        let step = AGAINST.iter().find(|(limit, _)| against.unwrap_or(0.0) <= *limit);
        step.map_or(0.0, |(_, factor)| *factor)
    }

    fn mean(&self, terms: impl IntoIterator<Item = (&'static str, Term)>) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for (name, term) in terms {
            let weight = weight(name);
            sum += weight * self.term(name, term);
            weights += weight;
        }
        sum / weights
    }

    fn term(&self, name: &str, term: Term) -> f64 {
        let value = self.find(name).and_then(|metric| metric.value);
        match term {
            Term::Value => value.unwrap_or(1.0),
            Term::Pass => self.all_pass(&[name]),
        }
    }
}

fn weight(name: &str) -> f64 {
    match metrics::find(name).map(|definition| definition.role) {
        Some(Role::Weighted(weight)) => weight,
        _ => unreachable!("every term has a weight in the list"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn metric(name: &str, value: f64, pass: bool) -> Metric {
        Metric {
            pass,
            ..Measure::new(metrics::find(name).unwrap().name, Some(value)).into_metric(&[])
        }
    }

    fn both(metrics: &[Metric], collisions: f64) -> [f64; 2] {
        scores(metrics, collisions).map(|score| score.into_metric(&[]).value.unwrap())
    }

    fn is(found: [f64; 2], expected: [f64; 2]) -> bool {
        (found[0] - expected[0]).abs() < 1e-12 && (found[1] - expected[1]).abs() < 1e-12
    }

    #[test]
    fn terms_count_by_their_weights_and_the_two_scores_never_mix() {
        assert!(is(both(&[], 1.0), [1.0, 1.0]), "nothing was measured");
        let lose = |name, value| both(&[metric(name, value, false)], 1.0);
        assert!(is(lose("progress", 0.5), [13.5 / 16.0, 17.5 / 20.0]));
        assert!(is(lose("ttc", 0.5), [11.0 / 16.0, 15.0 / 20.0]));
        assert!(is(lose("speed_limit", 0.25), [13.0 / 16.0, 17.0 / 20.0]));
        assert!(is(lose("comfort", 1.5), [14.0 / 16.0, 18.0 / 20.0]));
        assert!(is(lose("lane_keep", 3.0), [1.0, 18.0 / 20.0]));
        assert!(is(lose("consistency", 0.25), [1.0, 18.5 / 20.0]));
    }

    #[test]
    fn multipliers_multiply() {
        let fails = |name, value| both(&[metric(name, value, false)], 1.0);
        assert!(is(fails("drivable_area", 0.4), [0.0, 0.0]));
        assert!(is(fails("progress_min", 0.1), [0.0, 0.0]));
        for name in MORE_MULTIPLIERS {
            assert!(is(fails(name, 20.0), [1.0, 0.0]), "{name}");
        }
        for (against, factor) in [(2.0, 1.0), (2.1, 0.5), (6.0, 0.5), (6.1, 0.0)] {
            assert!(is(fails("driving_direction", against), [factor, factor]));
        }
        assert!(is(both(&[], 0.5), [0.5, 0.5]), "a cone was touched");
    }
}
