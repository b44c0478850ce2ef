//! A sweep as a job: results files, what a kill leaves, parts, claims, and what is made of results.

use crate::program::{Folder, GOOD};
use std::time::Duration;

/// Twelve runs, some of which fail: on one street the ego has to come farther than it has time to.
fn scenarios(folder: &Folder) {
    let law = GOOD.replace(
        "[ego]",
        "cruise_speed = { uniform = [5.0, 9.0] }\ntimeout = 4.0\n[ego]",
    );
    folder.put("near.toml", &law);
    folder.put("far.toml", law.replace("distance = 20.0", "distance = 28.0"));
}

const SWEEP: [&str; 5] = ["sweep", "near.toml", "far.toml", "--count", "12"];

fn sweep<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&SWEEP[..], more].concat()
}

#[test]
fn a_killed_sweep_goes_on_and_ends_in_the_same_bytes() {
    let folder = Folder::new("results-kill");
    scenarios(&folder);
    assert_eq!(folder.run(&sweep(&["--results", "whole.jsonl"])).code, Some(1));
    let whole = std::fs::read(folder.path("whole.jsonl")).unwrap();
    let arguments = sweep(&["--results", "killed.jsonl", "--resume", "--jobs", "1"]);
    for milliseconds in [30, 150, 400] {
        let mut child = folder.command(&arguments).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(milliseconds));
        child.kill().unwrap();
        child.wait().unwrap();
    }
    let last = folder.run(&arguments);
    assert_eq!(last.code, Some(1), "{last:?}");
    assert_eq!(std::fs::read(folder.path("killed.jsonl")).unwrap(), whole);
    // Once more: there is nothing left to do, and it says the same.
    assert_eq!(folder.run(&arguments).out, last.out);
    assert_eq!(std::fs::read(folder.path("killed.jsonl")).unwrap(), whole);
}

#[test]
fn parts_are_merged_to_what_the_whole_writes() {
    let folder = Folder::new("results-merge");
    scenarios(&folder);
    let whole = folder.run(&sweep(&["--results", "whole.jsonl"]));
    for part in ["1/3", "2/3", "3/3"] {
        let file = format!("part-{}.jsonl", &part[..1]);
        folder.run(&sweep(&["--results", &file, "--shard", part]));
    }
    let merged = folder.run(&[
        "merge",
        "merged.jsonl",
        "part-3.jsonl",
        "part-1.jsonl",
        "part-2.jsonl",
    ]);
    let read = |name: &str| std::fs::read(folder.path(name)).unwrap();
    assert_eq!(read("merged.jsonl"), read("whole.jsonl"));
    let digest = |out: &str| {
        out.lines()
            .find(|line| line.starts_with("digest "))
            .map(str::to_owned)
    };
    assert!(digest(&whole.out).is_some() && digest(&whole.out) == digest(&merged.out));
    folder.refuses(
        &["merge", "gap.jsonl", "part-1.jsonl", "part-3.jsonl"],
        &["missing: part 2/3"],
    );
    folder.refuses(&["sweep", "near.toml", "--shard", "4/3"], &["1/3 to 3/3"]);
}

#[test]
fn reports_come_from_the_results() {
    let folder = Folder::new("results-report");
    scenarios(&folder);
    let swept = folder.run(&sweep(&["--out", "a", "--csv", "b.csv"]));
    let told = folder.run(&["report", "a/results.jsonl", "--out", "c"]);
    assert_eq!(swept.code, told.code);
    let read = |name: &str| std::fs::read_to_string(folder.path(name)).unwrap();
    for file in ["report.xml", "report.csv", "report.html"] {
        assert_eq!(read(&format!("a/{file}")), read(&format!("c/{file}")), "{file}");
    }
    assert_eq!(read("b.csv"), read("a/report.csv"));
    assert_eq!(read("b.csv").lines().count(), 13);
    let xml = read("a/report.xml");
    assert!(
        xml.contains("tests=\"12\"") && xml.contains("far[seed=1]"),
        "{xml}"
    );
    assert!(swept.out.contains("scenario_completed, timeout"), "{}", swept.out);
}

#[test]
fn a_claim_ends_the_sweep() {
    let folder = Folder::new("results-until");
    scenarios(&folder);
    let made = folder.run(&["sweep", "near.toml", "--until", "20%"]);
    assert_eq!(made.code, Some(0), "{made:?}");
    assert!(
        made.out.contains("claim made") && made.out.contains("after 14 runs"),
        "{}",
        made.out
    );
    let refuted = folder.run(&["sweep", "far.toml", "--until", "0.1"]);
    assert_eq!(refuted.code, Some(1), "{refuted:?}");
    assert!(refuted.out.contains("claim refuted"), "{}", refuted.out);
    let open = folder.run(&["sweep", "near.toml", "--until", "0.1%", "--count", "5"]);
    assert_eq!(open.code, Some(1));
    assert!(open.out.contains("claim open"), "{}", open.out);
    folder.refuses(
        &["sweep", "near.toml", "--until", "2"],
        &["a share between 0 and 1"],
    );
}

#[test]
fn two_results_are_compared_seed_by_seed() {
    let folder = Folder::new("results-compare");
    scenarios(&folder);
    folder.run(&sweep(&["--results", "old.jsonl"]));
    let slower = sweep(&[
        "--results",
        "new.jsonl",
        "--set",
        "decider.path_bounds.obstacle_lat_buffer=0.5",
    ]);
    folder.run(&slower);
    let run = folder.run(&["compare", "old.jsonl", "new.jsonl", "--json", "c.json"]);
    assert_eq!(run.code, Some(0), "{run:?}");
    assert!(
        run.out
            .starts_with("old and new on the same 12 seeds of 2 scenarios"),
        "{}",
        run.out
    );
    assert!(run.out.contains("score (mean)") && folder.path("c.json").is_file());
    folder.run(&[
        "sweep",
        "near.toml",
        "--count",
        "3",
        "--seed",
        "50",
        "--results",
        "other.jsonl",
    ]);
    folder.refuses(
        &["compare", "old.jsonl", "other.jsonl"],
        &["no scenario and seed in common"],
    );
}

#[test]
fn an_unfinished_sweep_is_neither_lost_nor_read() {
    let folder = Folder::new("results-lost");
    scenarios(&folder);
    folder.run(&sweep(&["--results", "a.jsonl"]));
    let whole = std::fs::read_to_string(folder.path("a.jsonl")).unwrap();
    let torn: String = whole.lines().take(4).map(|line| line.to_owned() + "\n").collect();
    folder.put("a.jsonl", &torn);
    folder.refuses(
        &sweep(&["--results", "a.jsonl"]),
        &["`a.jsonl`", "unfinished", "--resume"],
    );
    folder.refuses(&["report", "a.jsonl"], &["unfinished"]);
    assert_eq!(std::fs::read_to_string(folder.path("a.jsonl")).unwrap(), torn);
    folder.refuses(
        &[
            "sweep",
            "near.toml",
            "--count",
            "12",
            "--results",
            "a.jsonl",
            "--resume",
        ],
        &["another sweep", "list of scenarios"],
    );
    folder.refuses(&sweep(&["--resume"]), &["--results FILE"]);
}
