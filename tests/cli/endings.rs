//! Exit codes, and readers that go away.

use crate::program::{Folder, GOOD};
use std::io::Read;
use std::process::Stdio;

#[test]
fn a_pass_is_0_and_a_failed_gate_is_1() {
    let folder = Folder::new("codes");
    folder.put("good.toml", GOOD);
    let passed = folder.run(&["run", "good.toml"]);
    assert_eq!(passed.code, Some(0), "{passed:?}");
    assert!(passed.out.starts_with("PASS "), "{}", passed.out);
    assert_eq!(folder.run(&["sweep", "good.toml"]).code, Some(0));

    folder.put(
        "late.toml",
        GOOD.replace("distance = 20.0", "distance = 400.0")
            .replace("[ego]", "timeout = 2.0\n[ego]"),
    );
    let late = folder.run(&["run", "late.toml"]);
    assert_eq!(late.code, Some(1), "{late:?}");
    assert!(late.out.starts_with("FAIL "), "{}", late.out);
    let swept = folder.run(&["sweep", "good.toml", "late.toml"]);
    assert_eq!(swept.code, Some(1), "{swept:?}");
    assert!(
        swept.out.contains("corridor run late.toml --seed 1"),
        "{}",
        swept.out
    );
}

#[test]
fn wrong_use_is_2_and_help_is_0() {
    let folder = Folder::new("use");
    for arguments in [
        &["fly"][..],
        &["run", "--seed", "x"],
        &["sweep"],
        &["explain", "x.zst"],
    ] {
        folder.refused(arguments);
    }
    folder.refuses(
        &["sweep", "parked_row", "--count", "0"],
        &["--count", "0 is not in 1..="],
    );
    folder.refuses(
        &["sweep", "parked_row", "--jobs", "100000"],
        &["--jobs", "is not in 0..=1024"],
    );
    for verb in ["run", "sweep", "replay", "list", "validate", "explain", "view"] {
        assert_eq!(folder.run(&[verb, "--help"]).code, Some(0), "{verb}");
    }
}

#[test]
fn jobs_0_means_every_core_and_changes_nothing() {
    let folder = Folder::new("jobs");
    let digest = |jobs: &str| {
        let run = folder.run(&["sweep", "parked_row", "cut_in", "--count", "4", "--jobs", jobs]);
        let digest = run
            .out
            .lines()
            .find(|line| line.starts_with("digest "))
            .map(str::to_owned);
        digest.unwrap_or_else(|| panic!("{run:?}"))
    };
    assert_eq!(digest("0"), digest("1"));
}

#[test]
fn the_catalog_is_listed() {
    let folder = Folder::new("list");
    let run = folder.run(&["list"]);
    assert_eq!(run.code, Some(0));
    assert!(
        run.out.lines().any(|line| line.starts_with("nudge_parked_car ")),
        "{}",
        run.out
    );
}

/// `corridor … | head -1`, and the same with the messages: nobody reads on, and that is no mistake.
#[test]
fn a_reader_that_goes_away_is_no_panic() {
    let folder = Folder::new("head");
    folder.put("good.toml", GOOD);
    folder.put("bad.toml", "");
    let verbs: [&[&str]; 4] = [
        &["list"],
        &["run", "good.toml"],
        &["sweep", "good.toml"],
        &["validate", "good.toml", "good.toml", "good.toml"],
    ];
    for arguments in verbs {
        let mut child = folder
            .command(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let mut err = String::new();
        child.stderr.take().unwrap().read_to_string(&mut err).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(0), "{arguments:?}: {err}");
    }
    let mut child = folder
        .command(&["validate", "bad.toml"])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(2));
}
