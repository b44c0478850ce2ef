//! Reports of hand-made rows.

use super::*;
use crate::signature::Signature;
use crate::sweep::RunResult;
use crate::verdict::{Ending, Metric, Verdict};

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

fn signature(metric: &str) -> Signature {
    Signature {
        metric: metric.to_owned(),
        ending: Ending::Collision,
        class: None,
        label: None,
        obstacle: None,
        rung: None,
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
        signature: (!pass).then(|| signature("no_collision")),
        digest: format!("{seed:x}"),
    };
    SweepRow {
        job: 0,
        scenario: scenario.to_owned(),
        seed,
        result: RunResult::Judged(Box::new(verdict.into())),
        has_goal: true,
        rejected: BTreeMap::from([("overlap at the start".to_owned(), 2)]),
        tried: None,
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

fn rows() -> Vec<SweepRow> {
    vec![
        row("nudge", 3, 0.0),
        row("nudge", 1, 0.0),
        broken("blocked", 7),
        row("nudge", 2, 1.0),
    ]
}

fn report() -> SweepReport {
    rows().iter().collect()
}

#[test]
fn the_digest_knows_no_order_of_arrival_and_no_wall_time_but_every_state() {
    let mut other = rows();
    other.reverse();
    for row in &mut other {
        row.wall_time = Duration::from_secs(9);
    }
    let digest = |rows: &[SweepRow]| rows.iter().collect::<SweepReport>().digest();
    assert_eq!(digest(&other), report().digest());
    let RunResult::Judged(verdict) = &mut other[0].result else {
        panic!("a judged row")
    };
    verdict.digest.push('0');
    assert_ne!(digest(&other), report().digest());
    // Two rows that trade their states are not the same two rows.
    let (mut first, mut second) = (row("a", 1, 0.0), row("a", 2, 0.0));
    let usual = digest(&[first.clone(), second.clone()]);
    std::mem::swap(&mut first.result, &mut second.result);
    assert_ne!(digest(&[first, second]), usual);
}

#[test]
fn failures_are_grouped_by_kind_with_the_one_that_is_over_first() {
    let failed = |scenario: &str, seed, kind: &str| {
        let mut row = row(scenario, seed, 1.0);
        if let RunResult::Judged(verdict) = &mut row.result {
            verdict.signature = Some(signature(kind));
        }
        row
    };
    let rows = [
        failed("a", 5, "no_collision"),
        failed("b", 3, "standstill"),
        failed("b", 4, "no_collision"),
        row("a", 1, 0.0),
        broken("c", 9),
        broken("c", 8),
        failed("c", 4, "no_collision"),
    ];
    let report: SweepReport = rows.iter().collect();
    let groups = report.groups();
    let found: Vec<(u64, &str, u64)> = groups
        .iter()
        .map(|group| (group.count, group.smallest.scenario.as_str(), group.smallest.seed))
        .collect();
    assert_eq!(found, [(3, "b", 4), (2, "c", 8), (1, "b", 3)]);
    assert_eq!(groups[0].scenarios.len(), 3);
    let reversed: SweepReport = rows.iter().rev().collect();
    assert_eq!(reversed.groups(), groups, "whatever the order");
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
    let totals = Totals {
        runs: 4,
        failures: 1,
        errors: 1,
    };
    let mut junit = Junit::begin(Vec::new(), totals).unwrap();
    for row in rows() {
        junit.case(&row).unwrap();
    }
    let xml = String::from_utf8(junit.end().unwrap()).unwrap();
    assert!(xml.contains(r#"tests="4" failures="1" errors="1""#), "{xml}");
    assert!(xml.contains(r#"name="nudge[seed=2]""#) && xml.contains(r#"type="no_collision""#));
    assert!(xml.contains("hit the standing `parked &lt;1&gt;`"), "{xml}");
    assert!(xml.contains("<system-out>corridor run nudge --seed 2</system-out>"));
    assert!(xml.contains(r#"type="infrastructure""#));
    let depth = |open: &str, close: &str| (xml.matches(open).count(), xml.matches(close).count());
    assert_eq!(depth("<testcase ", "</testcase>"), (4, 4));
}

#[test]
fn csv_has_a_column_for_every_metric_and_a_cell_in_it_for_every_row() {
    let names = ["min_clearance", "no_collision", "progress"].map(str::to_owned);
    let mut csv = Csv::begin(Vec::new(), names.into()).unwrap();
    for row in rows() {
        csv.row(&row).unwrap();
    }
    let text = String::from_utf8(csv.end()).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert!(
        lines[0].ends_with("replay,min_clearance,no_collision,progress"),
        "{text}"
    );
    assert!(lines[1].ends_with(",0.30000000000000004,0,0.5"), "{text}");
    assert!(lines[3].contains("blocked,7,broken,,,,cannot read the map,") && lines[3].ends_with(",,,"));
    // The signature of the failed run is in quotes, with a comma of its own.
    let commas: Vec<usize> = lines.iter().map(|line| line.matches(',').count()).collect();
    assert_eq!(commas, [12, 12, 12, 12, 13]);
    assert!(lines[4].contains(",\"no_collision, collision\","), "{text}");
}

#[test]
fn json_keeps_wall_times_apart() {
    let document: serde_json::Value = serde_json::from_str(&to_json(&report()).unwrap()).unwrap();
    assert_eq!(document["scenarios"][1]["scenario"], "nudge");
    assert_eq!(
        document["groups"][1]["smallest"]["failure"],
        "cannot read the map"
    );
    assert_eq!(document["rejected"]["overlap at the start"], 8);
    assert_eq!(document["passed"], false);
    let mut slower = rows();
    slower[0].wall_time = Duration::from_secs(100);
    let slower: SweepReport = slower.iter().collect();
    let mut other: serde_json::Value = serde_json::from_str(&to_json(&slower).unwrap()).unwrap();
    assert_ne!(document, other);
    other["timing"] = document["timing"].clone();
    assert_eq!(document, other);
}

#[test]
fn the_page_holds_what_was_found_and_no_stray_angle_bracket() {
    let page = to_html(&report());
    for part in [
        "2 of 4 runs did not pass",
        "corridor run nudge --seed 2",
        "min_clearance",
        "cannot read the map",
    ] {
        assert!(page.contains(part), "`{part}` is not in\n{page}");
    }
    assert!(!page.contains("parked <1>") && !page.contains("http"), "{page}");
    assert_eq!(page, to_html(&report()));
}

#[test]
fn the_table_reads_without_colour_and_says_the_same_with_it() {
    let plain = to_table(&report(), Colour::Never);
    let expected = [
        "as blocked seed 7: cannot read the map",
        "BROKEN 1 x could not be run",
        "as nudge seed 2: hit the standing",
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
    let rows: Vec<SweepRow> = (0..299).map(|seed| row("nudge", seed, 0.0)).collect();
    let report: SweepReport = rows.iter().collect();
    let text = to_table(&report, Colour::Never);
    assert!(report.passed() && text.contains("all 299 runs passed"), "{text}");
    assert!(text.contains("1.00 %"), "{text}");
    assert!(SweepReport::default().passed());
    assert!(to_table(&SweepReport::default(), Colour::Never).contains("all 0 runs"));
}
