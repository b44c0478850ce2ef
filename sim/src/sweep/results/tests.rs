//! Results files that are torn, damaged, resumed, cut into parts and merged.

use super::*;
use crate::sweep::{CycleTimes, Judgement, RunResult, SweepRow};
use crate::verdict::Ending;
use std::collections::BTreeMap;
use std::fs;
use std::time::Duration;

fn header(part: u64, parts: u64, count: u64) -> Header {
    Header {
        format: FORMAT,
        build: "1.2.3".to_owned(),
        behaviour: "0123".to_owned(),
        scenarios: vec!["catalog".to_owned()],
        content: "4567".to_owned(),
        settings: Vec::new(),
        count,
        first_seed: 1,
        until: None,
        part,
        parts,
    }
}

fn row(job: u64) -> SweepRow {
    let judgement = Judgement {
        pass: !job.is_multiple_of(5),
        ending: Ending::GoalReached,
        summary: format!("passed: {job}"),
        duration: 1.5,
        metrics: BTreeMap::from([("progress".to_owned(), 1.0 / (job + 1) as f64)]),
        failed: Vec::new(),
        collisions: Vec::new(),
        outcomes: Vec::new(),
        signature: None,
        digest: format!("{job:x}"),
    };
    SweepRow {
        job,
        scenario: "nudge".to_owned(),
        seed: job,
        result: RunResult::Judged(Box::new(judgement)),
        has_goal: true,
        rejected: BTreeMap::new(),
        tried: None,
        replay: String::new(),
        wall_time: Duration::ZERO,
        cycles: CycleTimes::default(),
    }
}

/// Writes what is missing in a file that is begun or gone on with, up to row `until`, and ends it if that is the last.
fn go_on(path: &Path, header: &Header, until: u64) -> SweepReport {
    let mut report = SweepReport::default();
    let mut writer = ResultsWriter::resume(path, header, |row| report.add(row)).unwrap();
    let length = header.count.saturating_sub(header.part).div_ceil(header.parts);
    if !writer.is_done() {
        for nth in writer.rows()..until.min(length) {
            let row = row(header.job(nth));
            report.add(&row);
            writer.add(&row).unwrap();
        }
        if until >= length {
            writer.finish(&report).unwrap();
        }
    }
    report
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

#[test]
fn wherever_it_is_torn_it_ends_in_the_same_bytes() {
    let folder = folder();
    let (whole, torn) = (
        folder.path().join("whole.jsonl"),
        folder.path().join("torn.jsonl"),
    );
    let header = header(0, 1, 7);
    let report = go_on(&whole, &header, 7);
    let bytes = fs::read(&whole).unwrap();
    for length in 0..=bytes.len() {
        fs::write(&torn, &bytes[..length]).unwrap();
        assert_eq!(go_on(&torn, &header, 7).digest(), report.digest());
        assert_eq!(fs::read(&torn).unwrap(), bytes, "torn after {length} bytes");
    }
    let results = Results::open(&whole).unwrap();
    assert_eq!(results.report().digest(), report.digest());
    let rows: Vec<SweepRow> = results.rows().unwrap().map(Result::unwrap).collect();
    assert_eq!(rows, (0..7).map(row).collect::<Vec<_>>());
}

#[test]
fn an_unfinished_sweep_is_not_lost_and_not_taken_for_a_whole_one() {
    let folder = folder();
    let path = folder.path().join("a.jsonl");
    let header = header(0, 1, 7);
    go_on(&path, &header, 3);
    assert!(matches!(
        ResultsWriter::create(&path, &header),
        Err(ResultsError::WouldBeLost(_))
    ));
    assert!(matches!(Results::open(&path), Err(ResultsError::Unfinished(_))));
    go_on(&path, &header, 7);
    assert!(
        ResultsWriter::create(&path, &header).is_ok(),
        "a finished one is a report like others"
    );
    fs::write(&path, "notes of mine\n").unwrap();
    let message = Results::open(&path).unwrap_err().to_string();
    assert!(
        message.contains("line 1") && message.contains("no results file"),
        "{message}"
    );
}

#[test]
fn another_sweep_is_not_gone_on_with() {
    let folder = folder();
    let path = folder.path().join("a.jsonl");
    go_on(&path, &header(0, 1, 7), 3);
    for (other, what) in [
        (
            Header {
                behaviour: "x".to_owned(),
                ..header(0, 1, 7)
            },
            "behaviour",
        ),
        (
            Header {
                settings: vec!["tick=0.2".to_owned()],
                ..header(0, 1, 7)
            },
            "settings",
        ),
        (header(0, 1, 8), "count"),
        (header(1, 2, 7), "part"),
    ] {
        let error = ResultsWriter::resume(&path, &other, |_| ())
            .unwrap_err()
            .to_string();
        assert!(error.contains("another sweep") && error.contains(what), "{error}");
    }
}

#[test]
fn damage_is_told_with_its_line() {
    let folder = folder();
    let path = folder.path().join("a.jsonl");
    go_on(&path, &header(0, 1, 7), 7);
    let text = fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let without = |k: usize| [&lines[..k], &lines[k + 1..]].concat().join("\n") + "\n";
    for (damaged, line) in [
        (without(3), "line 4"),
        (text.replace("passed: 4\"", "passed: 4\",\"x\":1"), "line 6"),
        (text.replace("\"digest\":\"4\"", "\"digest\":\"5\""), "line 9"),
        (text.clone() + lines[2] + "\n", "line 10"),
        (text.replace("\"format\":1", "\"format\":7"), "line 1"),
    ] {
        assert_ne!(damaged, text);
        fs::write(&path, damaged).unwrap();
        let error = Results::open(&path).unwrap_err().to_string();
        assert!(error.contains(line), "{line}: {error}");
    }
}

#[test]
fn parts_merge_into_the_bytes_of_the_whole() {
    let folder = folder();
    let place = |name: &str| folder.path().join(name);
    for (count, parts) in [(11, 4), (3, 3), (9, 2)] {
        let whole = place("whole.jsonl");
        let _ = fs::remove_file(&whole);
        go_on(&whole, &header(0, 1, count), count);
        let paths: Vec<PathBuf> = (0..parts)
            .map(|part| place(&format!("{count}-{part}.jsonl")))
            .collect();
        for (part, path) in (0..).zip(&paths) {
            go_on(path, &header(part, parts, count), count);
        }
        let shuffled: Vec<PathBuf> = paths.iter().rev().cloned().collect();
        let merged = place("merged.jsonl");
        merge(&merged, &shuffled).unwrap();
        assert_eq!(
            fs::read(&merged).unwrap(),
            fs::read(&whole).unwrap(),
            "{count} in {parts}"
        );
    }
}

#[test]
fn gaps_doubles_and_strangers_are_not_merged() {
    let folder = folder();
    let place = |name: &str| folder.path().join(name);
    let paths: Vec<PathBuf> = (0..3).map(|part| place(&format!("{part}.jsonl"))).collect();
    for (part, path) in (0..).zip(&paths) {
        go_on(path, &header(part, 3, 8), 8);
    }
    let refused = |paths: &[PathBuf]| {
        let out = place("out.jsonl");
        let error = merge(&out, paths).unwrap_err().to_string();
        assert!(
            !out.exists() && fs::read_dir(folder.path()).unwrap().count() < 8,
            "nothing is left behind"
        );
        error
    };
    assert!(refused(&paths[..2]).contains("missing: part 3/3"));
    let twice = [paths.clone(), vec![paths[1].clone()]].concat();
    assert!(refused(&twice).contains("part 2/3 is there twice"));
    let stranger = place("stranger.jsonl");
    go_on(
        &stranger,
        &Header {
            build: "9".to_owned(),
            ..header(2, 3, 8)
        },
        8,
    );
    assert!(refused(&[paths[0].clone(), paths[1].clone(), stranger]).contains("version"));
    let unfinished = place("unfinished.jsonl");
    go_on(&unfinished, &header(2, 3, 8), 1);
    assert!(refused(&[paths[0].clone(), paths[1].clone(), unfinished]).contains("unfinished"));
    assert!(refused(&[]).contains("nothing to merge"));
}
