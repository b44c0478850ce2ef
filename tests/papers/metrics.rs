//! sim/METRICS.md and the code say the same, in both directions: the table is the list in the code, and a verdict holds
//! exactly the metrics of the table, with the thresholds and roles that it gives.

use corridor_scenarios::{MapCache, catalog};
use corridor_sim::monitor::metrics;
use corridor_sim::run::run;
use corridor_sim::settings::Settings;
use corridor_sim::verdict::Metric;
use std::collections::BTreeMap;

/// Runs that among them pull over, refuse, stand, borrow, change lanes, meet somebody, and collide.
const RUNS: [(&str, u64, &[&str]); 8] = [
    ("pull_over_between_parked", 1, &[]),
    ("pull_over_no_gap", 1, &[]),
    ("blocked_both_lanes", 1, &[]),
    ("borrow_with_oncoming", 1, &[]),
    ("lane_change_left", 1, &[]),
    ("jaywalker_from_left", 6, &[]),
    ("hard_braking_leader", 1, &[]),
    ("blocked_sweep", 3, &["fault=mirrored"]),
];

/// A row of the table, as the paper has it.
#[derive(Debug)]
struct Row {
    unit: String,
    good: String,
    role: String,
}

fn rows(text: &str) -> BTreeMap<String, Row> {
    let mut rows = BTreeMap::new();
    for line in text.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [name, formula, unit, good, role, source] = cells[..] else {
            continue;
        };
        assert!(!formula.is_empty() && !source.is_empty(), "{line}");
        let row = Row {
            unit: unit.to_owned(),
            good: good.to_owned(),
            role: role.to_owned(),
        };
        let name = name.trim_matches('`').to_owned();
        assert!(rows.insert(name, row).is_none(), "twice: {line}");
    }
    rows
}

fn verdicts() -> Vec<Vec<Metric>> {
    let judge = |(scenario, seed, overrides): (&str, u64, &[&str])| {
        let family = catalog::find(scenario).unwrap().load(&MapCache::new()).unwrap();
        let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
        let drawn = family.draw(seed).unwrap();
        run(&drawn.scenario, &Settings::with(&overrides).unwrap()).metrics
    };
    RUNS.into_iter().map(judge).collect()
}

#[test]
fn the_table_of_metrics_is_the_list_in_the_code() {
    let (paper, list) = (super::read("sim/METRICS.md"), metrics::tables());
    assert!(
        paper.contains(list.trim_end()),
        "sim/METRICS.md must have these tables:\n\n{list}"
    );
    assert_eq!(rows(&paper).len(), metrics::definitions().count());
}

#[test]
fn a_verdict_has_the_metrics_of_the_table() {
    let table = rows(&super::read("sim/METRICS.md"));
    let names: Vec<&String> = table.keys().collect();
    let verdicts = verdicts();
    for verdict in &verdicts {
        let mut found: Vec<&String> = verdict.iter().map(|metric| &metric.name).collect();
        found.sort();
        assert_eq!(found, names);
        for metric in verdict {
            agrees(metric, &table[&metric.name]);
        }
    }
    // Each of them is measured somewhere, and has a worst moment where it has one at all.
    for name in names {
        let of_name = || verdicts.iter().flatten().filter(|metric| metric.name == *name);
        assert!(
            of_name().any(|metric| metric.value.is_some()),
            "`{name}` is never measured"
        );
    }
}

fn agrees(metric: &Metric, row: &Row) {
    let is_conditional = row.role.contains(", ");
    let threshold = row
        .good
        .split(' ')
        .nth(1)
        .map(|text| text.parse::<f64>().unwrap());
    assert!(
        metric.threshold == threshold || (is_conditional && metric.threshold.is_none()),
        "{metric:?} {row:?}"
    );
    let is_gate = row.role.starts_with("gate");
    assert!(
        metric.gate == is_gate || (is_conditional && !metric.gate),
        "{metric:?} {row:?}"
    );
    let Some(value) = metric.value else {
        assert!(metric.pass, "{metric:?}");
        return;
    };
    let good = metric
        .threshold
        .is_none_or(|limit| match &row.good[..row.good.find(' ').unwrap()] {
            "≤" => value <= limit,
            "<" => value < limit,
            "≥" => value >= limit,
            ">" => value > limit,
            sign => panic!("{sign}"),
        });
    assert_eq!(metric.pass, good, "{metric:?} {row:?}");
    assert!(!row.unit.is_empty());
}

#[test]
fn what_a_verdict_cannot_hold_is_said_to_be_elsewhere() {
    let paper = super::read("sim/METRICS.md");
    for elsewhere in ["| `decider_latency` |", "| `replay_hash` |"] {
        assert!(paper.contains(elsewhere), "{elsewhere}");
    }
}
