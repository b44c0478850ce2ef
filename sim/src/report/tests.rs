//! Reports of hand-made rows.

use super::*;
use crate::verdict::Metric;

fn metric(name: &str, value: f64, limit: f64) -> Metric {
    Metric {
        name: name.to_owned(),
        value: Some(value),
        threshold: Some(limit),
        pass: value <= limit,
        gate: true,
        worst_t: Some(4.2),
        worst_obstacle: Some("parked <1>".to_owned()),
    }
}

fn row(scenario: &str, seed: u64, collisions: f64) -> SweepRow {
    let pass = collisions <= 0.0;
    let verdict = Verdict {
        pass,
        ending: if pass {
            Ending::GoalReached
        } else {
            Ending::Collision
        },
        summary: if pass {
            "passed: reached the goal"
        } else {
            "failed: hit the standing `parked <1>`"
        }
        .to_owned(),
        duration: 20.0 + seed as f64,
        metrics: vec![
            metric("no_collision", collisions, 0.0),
            metric("progress", 0.5, 1.0),
            metric("min_clearance", 0.1 * seed as f64, 9.0),
        ],
        collisions: Vec::new(),
        outcomes: Vec::new(),
        fallbacks: Vec::new(),
        digest: format!("{seed:x}"),
    };
    SweepRow {
        scenario: scenario.to_owned(),
        seed,
        result: RunResult::Judged(Box::new(verdict)),
        has_goal: true,
        rejected: BTreeMap::from([("overlap at the start".to_owned(), 2)]),
        replay: format!("corridor run {scenario} --seed {seed}"),
        wall_time: Duration::from_millis(10 * seed),
        cycles: CycleTimes::default(),
    }
}

fn broken(scenario: &str, seed: u64) -> SweepRow {
    SweepRow {
        result: RunResult::Broken("cannot read the map".to_owned()),
        ..row(scenario, seed, 0.0)
    }
}

fn report() -> SweepReport {
    SweepReport::new(vec![
        row("nudge", 3, 0.0),
        row("nudge", 1, 0.0),
        broken("blocked", 7),
        row("nudge", 2, 1.0),
    ])
}

#[test]
fn the_digest_knows_no_order_of_arrival_and_no_wall_time_but_every_state() {
    let report = report();
    let mut rows = report.rows().to_vec();
    rows.reverse();
    for row in &mut rows {
        row.wall_time = Duration::from_secs(9);
    }
    assert_eq!(SweepReport::new(rows.clone()).digest(), report.digest());
    let RunResult::Judged(verdict) = &mut rows[0].result else {
        panic!("a judged row")
    };
    verdict.digest.push('0');
    assert_ne!(SweepReport::new(rows).digest(), report.digest());
}

#[test]
fn summaries_count_and_bound() {
    let summaries = report().scenarios();
    let [blocked, nudge] = &summaries[..] else {
        panic!("two scenarios")
    };
    assert_eq!((blocked.runs, blocked.broken, blocked.passed), (1, 1, 0));
    assert_eq!((nudge.runs, nudge.passed, nudge.collisions), (3, 2, 1));
    assert_eq!(
        (nudge.worst_seed, nudge.longest_seed, nudge.slowest_seed),
        (Some(2), Some(3), Some(3))
    );
    assert_eq!((nudge.progress, nudge.rejected), (Some(0.5), 6));
    // One failure in three runs: p³ + 3p²(1 − p) = 0.95 where p = 0.8646.
    assert!(
        (nudge.failure_rate_bound - 0.8646).abs() < 1e-4,
        "{}",
        nudge.failure_rate_bound
    );
}

#[test]
fn junit_tells_violated_properties_from_broken_tools() {
    let xml = to_junit(&report()).unwrap();
    assert!(
        xml.contains(r#"tests="4" skipped="0" failures="1" errors="1""#),
        "{xml}"
    );
    assert!(xml.contains(r#"name="nudge[seed=2]""#) && xml.contains(r#"type="no_collision""#));
    assert!(xml.contains("hit the standing `parked &lt;1&gt;`"), "{xml}");
    assert!(xml.contains("<system-out>corridor run nudge --seed 2</system-out>"));
    assert!(xml.contains(r#"type="infrastructure""#));
}

#[test]
fn json_keeps_wall_times_apart() {
    let document: serde_json::Value = serde_json::from_str(&to_json(&report()).unwrap()).unwrap();
    assert_eq!(document["rows"][1]["seed"], 1);
    assert_eq!(document["rows"][0]["error"], "cannot read the map");
    assert_eq!(document["rejected"]["overlap at the start"], 8);
    assert_eq!(document["passed"], false);
    let mut slower = report().rows().to_vec();
    slower[0].wall_time = Duration::from_secs(100);
    let mut other: serde_json::Value =
        serde_json::from_str(&to_json(&SweepReport::new(slower)).unwrap()).unwrap();
    assert_ne!(document, other);
    other["timing"] = document["timing"].clone();
    assert_eq!(document, other);
}

#[test]
fn the_table_reads_without_colour_and_says_the_same_with_it() {
    let plain = to_table(&report(), Colour::Never);
    let expected = [
        "BROKEN blocked seed 7: cannot read the map",
        "FAILED nudge seed 2: hit the standing",
        "again: corridor run nudge --seed 2",
        "2 of 4 runs did not pass; 8 draws rejected (8 overlap at the start)",
        "87 %",
        &format!("digest {}", report().digest()),
    ];
    for part in expected {
        assert!(plain.contains(part), "`{part}` is not in\n{plain}");
    }
    assert!(!plain.contains('\u{1b}'));
    let mut coloured = to_table(&report(), Colour::Always);
    assert!(coloured.contains('\u{1b}'));
    for code in ["\u{1b}[31m", "\u{1b}[32m", "\u{1b}[0m"] {
        coloured = coloured.replace(code, "");
    }
    assert_eq!(coloured, plain);
}

#[test]
fn clean_sweeps_say_what_they_prove() {
    let rows = (0..299).map(|seed| row("nudge", seed, 0.0)).collect();
    let report = SweepReport::new(rows);
    let text = to_table(&report, Colour::Never);
    assert!(report.passed() && text.contains("all 299 runs passed"), "{text}");
    assert!(text.contains("1.00 %"), "{text}");
    assert!(SweepReport::new(Vec::new()).passed());
    assert!(to_table(&SweepReport::new(Vec::new()), Colour::Never).contains("all 0 runs"));
}
