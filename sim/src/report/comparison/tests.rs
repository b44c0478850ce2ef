//! Comparisons of hand-made pairs.

use super::super::Colour;
use super::*;
use crate::sweep::{CycleTimes, RunResult};
use crate::verdict::{Metric, Verdict};
use std::collections::BTreeMap;
use std::time::Duration;

fn metric(name: &str, value: f64, pass: bool) -> Metric {
    Metric {
        name: name.to_owned(),
        value: Some(value),
        threshold: None,
        pass,
        gate: false,
        worst_t: None,
        worst_obstacle: None,
    }
}

/// A run that came this far, 1.0: to its goal.
fn run(seed: u64, progress: f64) -> SweepRow {
    let there = progress >= 1.0;
    let verdict = Verdict {
        pass: there,
        ending: if there {
            Ending::GoalReached
        } else {
            Ending::Timeout
        },
        summary: if there { "passed" } else { "failed: out of time" }.to_owned(),
        duration: 20.0,
        metrics: vec![
            metric("no_at_fault_collision", 0.0, true),
            metric("progress", progress, true),
        ],
        collisions: Vec::new(),
        outcomes: Vec::new(),
        fallbacks: Vec::new(),
        signature: None,
        digest: format!("{seed:x}"),
    };
    SweepRow {
        job: seed,
        scenario: format!("street {}", seed % 2),
        seed,
        result: RunResult::Judged(Box::new(verdict.into())),
        has_goal: true,
        rejected: BTreeMap::from([("overlap at the start".to_owned(), 1)]),
        tried: None,
        replay: format!("corridor run street --seed {seed}"),
        wall_time: Duration::from_millis(seed),
        cycles: CycleTimes::default(),
    }
}

/// The same run with a collision at fault.
fn crashed(row: SweepRow) -> SweepRow {
    let RunResult::Judged(mut verdict) = row.result else {
        panic!("a judged row")
    };
    verdict.pass = false;
    verdict.ending = Ending::Collision;
    verdict.failed = vec![metric("no_at_fault_collision", 1.0, false)];
    SweepRow {
        result: RunResult::Judged(verdict),
        ..row
    }
}

fn broken(seed: u64) -> SweepRow {
    SweepRow {
        result: RunResult::Broken("cannot read the map".to_owned()),
        ..run(seed, 1.0)
    }
}

/// Twelve seeds: the second comes less far on seeds 2 to 11, crashes on seed 9, and cannot be run on 12.
fn pairs() -> Vec<[SweepRow; 2]> {
    let mut pairs: Vec<[SweepRow; 2]> = (1..=12)
        .map(|seed| {
            let progress = if seed == 1 { 1.0 } else { 1.0 - 0.05 * seed as f64 };
            [run(seed, 1.0), run(seed, progress)]
        })
        .collect();
    pairs[8][1] = crashed(pairs[8][1].clone());
    pairs[11][1] = broken(12);
    pairs
}

fn names() -> [String; 2] {
    ["old", "new"].map(str::to_owned)
}

fn comparison() -> Comparison {
    Comparison::new(names(), pairs())
}

#[test]
fn outcomes_are_counted_in_pairs() {
    let comparison = comparison();
    let passed = &comparison.outcomes[0];
    assert_eq!(passed.name, "passed");
    let expected = Fourfold {
        both: 1,
        only_first: 10,
        only_second: 0,
        neither: 0,
    };
    assert_eq!(passed.counts, expected);
    assert!((passed.test.p - 2.0 / 1024.0).abs() < 1e-15);
    let named: Vec<&str> = comparison.outcomes.iter().map(|row| row.name).collect();
    // No run was asked to pull over, and none measured its comfort.
    assert_eq!(named, ["passed", "no_at_fault_collision", "goal_reached"]);
}

/// Differences −0.10, −0.15, …, −0.55 and one 0: the sixth of eleven is −0.30; one value may be left out at either end;
/// ten of one sign have a chance of 2/1024.
#[test]
fn metrics_are_compared_pair_by_pair() {
    let comparison = comparison();
    let [progress, time] = &comparison.quantities[..] else {
        panic!("{:?}", comparison.quantities)
    };
    assert_eq!((progress.name, progress.pairs), ("progress", 11));
    assert_eq!(
        (progress.first_better, progress.second_better, progress.equal),
        (10, 0, 1)
    );
    let (low, high) = progress.difference.range.unwrap();
    let medians = [
        progress.medians[0],
        progress.medians[1],
        progress.difference.value,
        low,
        high,
    ];
    for (found, expected) in medians.iter().zip([1.0, 0.7, -0.3, -0.5, -0.1]) {
        assert!((found - expected).abs() < 1e-9, "{medians:?}");
    }
    assert!((progress.test.p - 2.0 / 1024.0).abs() < 1e-15);
    // Only on seed 1 did both reach the goal.
    assert_eq!((time.name, time.pairs, time.equal), ("time_to_goal", 1, 1));
    assert_eq!(time.difference.range, None);
}

/// Five tests: 2/1024 three times, and 1 twice. Times five, not above the smallest corrected one before.
#[test]
fn probabilities_are_corrected_over_both_tables() {
    let comparison = comparison();
    assert_eq!(comparison.tests(), 5);
    let outcomes = comparison.outcomes.iter().map(|row| row.test);
    let tests: Vec<Test> = outcomes
        .chain(comparison.quantities.iter().map(|row| row.test))
        .collect();
    let significant: Vec<bool> = tests.iter().map(|test| test.significant).collect();
    assert_eq!(significant, [true, false, true, true, false]);
    assert!((tests[0].p_holm - 10.0 / 1024.0).abs() < 1e-15);
}

#[test]
fn the_worst_comes_first_and_what_could_not_be_run_is_left_out() {
    let comparison = comparison();
    let only = comparison.passed_by_only(0);
    let seeds: Vec<u64> = only.iter().map(|pair| pair[1].seed).collect();
    assert_eq!(seeds, [9, 2, 3, 4, 5, 6, 7, 8, 11, 10]);
    assert!(comparison.passed_by_only(1).is_empty());
    let text = comparison_to_table(&comparison, Colour::Never);
    let expected = [
        "old and new on the same 12 seeds of 2 scenarios; 1 left out: a run could not be made; \
         12 draws rejected for both (12 overlap at the start)",
        "10 seeds pass under old and not under new:",
        "FAILED street 1 seed 9: ",
        "  again: corridor run street --seed 9",
        "new: collisions at fault 1, failed deciders 0, runs that could not be made 1",
        "-0.500 to -0.100",
        "0.002   0.010 *",
    ];
    for part in expected {
        assert!(text.contains(part), "`{part}` is not in\n{text}");
    }
}

#[test]
fn colour_says_nothing_of_its_own() {
    let comparison = comparison();
    let mut coloured = comparison_to_table(&comparison, Colour::Always);
    assert!(coloured.contains('\u{1b}'));
    for code in ["\u{1b}[31m", "\u{1b}[32m", "\u{1b}[1m", "\u{1b}[0m"] {
        coloured = coloured.replace(code, "");
    }
    assert_eq!(coloured, comparison_to_table(&comparison, Colour::Never));
}

#[test]
fn neither_order_nor_wall_time_changes_what_is_said() {
    let mut other = pairs();
    other.reverse();
    for row in other.iter_mut().flatten() {
        row.wall_time = Duration::from_secs(9);
        row.cycles.add(Duration::from_millis(7));
    }
    let other = Comparison::new(names(), other);
    let same = comparison();
    assert_eq!(
        comparison_to_table(&other, Colour::Never),
        comparison_to_table(&same, Colour::Never)
    );
    assert_eq!(
        comparison_to_json(&other).unwrap(),
        comparison_to_json(&same).unwrap()
    );
}

#[test]
fn exchanging_the_two_exchanges_what_is_said() {
    let swapped = pairs().into_iter().map(|[a, b]| [b, a]).collect();
    let swapped = Comparison::new(["new", "old"].map(str::to_owned), swapped);
    let comparison = comparison();
    for (a, b) in comparison.outcomes.iter().zip(&swapped.outcomes) {
        assert_eq!(a.counts.only_first, b.counts.only_second);
        assert!((a.test.p_holm - b.test.p_holm).abs() < 1e-15);
    }
    for (a, b) in comparison.quantities.iter().zip(&swapped.quantities) {
        assert_eq!(
            (a.first_better, a.second_better),
            (b.second_better, b.first_better)
        );
        assert!((a.difference.value + b.difference.value).abs() < 1e-15);
        assert!((a.test.p_holm - b.test.p_holm).abs() < 1e-15);
    }
}

#[test]
fn json_holds_digests_rows_and_seeds() {
    let comparison = comparison();
    let document: serde_json::Value =
        serde_json::from_str(&comparison_to_json(&comparison).unwrap()).unwrap();
    assert_eq!(document["planners"][1], "new");
    assert_eq!(document["digests"][0], comparison.reports()[0].digest());
    assert_eq!(document["safe"], false);
    assert_eq!(document["broken"][0]["errors"][1], "cannot read the map");
    assert_eq!(document["outcomes"][0]["only_first"], 10);
    assert_eq!(document["metrics"][0]["name"], "progress");
    assert_eq!(document["metrics"][0]["better"], "larger");
    assert!((document["metrics"][0]["difference"]["value"].as_f64().unwrap() + 0.3).abs() < 1e-9);
    assert_eq!(document["metrics"][0]["significant"], true);
    assert_eq!(document["scenarios"][0]["only_first"], 5);
    assert_eq!(document["only_first"][0]["harm"], "at_fault");
    assert!(!comparison_to_json(&comparison).unwrap().contains("wall"));
}

#[test]
fn who_only_arrives_less_often_is_safe() {
    let pairs = (0..9).map(|seed| [run(seed, 1.0), run(seed, 0.5)]).collect();
    let comparison = Comparison::new(names(), pairs);
    assert!(comparison.is_safe());
    assert_eq!(comparison.passed_by_only(0).len(), 9);
    let empty = Comparison::new(names(), Vec::new());
    assert!(empty.is_safe() && empty.outcomes.is_empty());
    assert!(comparison_to_table(&empty, Colour::Never).contains("no seed passes under old or new alone"));
}
