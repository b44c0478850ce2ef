//! The golden vectors of the path bounds, run by the `conformance` program as anyone would run it; and that the
//! program tells a wrong answer from a right one.

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests")]

mod lattice;
mod qp;

use serde_json::Value;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The vectors: JSON lines, gzipped.
const VECTORS: &[u8] = include_bytes!("../data/path_bounds.jsonl.gz");

/// Those of the speed tasks.
const SPEED_VECTORS: &[u8] = include_bytes!("../data/speed.jsonl.gz");

fn conformance(files: &[&Path]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_conformance"))
        .args(files)
        .output()
        .unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("the program was not killed")
}

fn last_line(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stdout);
    text.lines().last().unwrap_or_default().to_owned()
}

/// A file in this build's own folder.
fn file(name: &str, content: &[u8]) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, content).unwrap();
    path
}

fn cases() -> Vec<Value> {
    let mut text = String::new();
    flate2::read::GzDecoder::new(VECTORS)
        .read_to_string(&mut text)
        .unwrap();
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

/// The first case with a bound whose label starts like this and is not empty, after a change.
fn changed(label: &str, change: impl FnOnce(&mut Value)) -> Vec<u8> {
    let is_wanted = |bound: &Value| bound["label"].as_str().unwrap().starts_with(label);
    let find = |mut case: Value| {
        let bounds = case["expected"]["candidate_path_boundaries"].as_array_mut()?;
        let place = bounds.iter().position(is_wanted)?;
        Some((case, place))
    };
    let (mut case, place) = cases().into_iter().find_map(find).unwrap();
    change(&mut case["expected"]["candidate_path_boundaries"][place]);
    case.to_string().into_bytes()
}

fn add(number: &mut Value, amount: f64) {
    *number = (number.as_f64().unwrap() + amount).into();
}

#[test]
fn all_golden_vectors_pass() {
    let vectors = file("vectors.jsonl.gz", VECTORS);
    let output = conformance(&[&vectors]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(
        (code(&output), last_line(&output).as_str()),
        (0, "447 passed, 0 failed"),
        "{said}"
    );
}

#[test]
fn all_golden_vectors_of_the_speed_tasks_pass() {
    let vectors = file("speed.jsonl.gz", SPEED_VECTORS);
    let output = conformance(&[&vectors]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(
        (code(&output), last_line(&output).as_str()),
        (0, "1558 passed, 0 failed"),
        "{said}"
    );
}

/// Plain lines count as gzipped ones do, and several files add up.
#[test]
fn plain_files_add_up() {
    let plain = file("plain.jsonl", &changed("fallback", |_| ()));
    let vectors = file("again.jsonl.gz", VECTORS);
    let output = conformance(&[&plain, &vectors]);
    assert_eq!(
        (code(&output), last_line(&output).as_str()),
        (0, "448 passed, 0 failed")
    );
}

#[test]
fn two_nanometres_are_reported_and_half_a_nanometre_is_not() {
    for label in [
        "fallback",
        "regular/self",
        "regular/left",
        "regular/pullover",
        "regular/lanechange",
    ] {
        for (side, amount, fails) in [(0, 2e-9, 1), (1, -2e-9, 1), (0, 0.5e-9, 0), (1, 0.5e-9, 0)] {
            let text = changed(label, |bound| add(&mut bound["boundary"][0][side], amount));
            let name = format!("off-{}-{side}-{amount:e}.jsonl", label.replace('/', "-"));
            let output = conformance(&[&file(&name, &text)]);
            let wanted = format!("{} passed, {fails} failed", 1 - fails);
            assert_eq!(
                (code(&output), last_line(&output)),
                (fails, wanted),
                "{label} {side} {amount}"
            );
        }
    }
}

/// Everything else that a case names is compared, too.
#[test]
fn a_wrong_label_length_station_or_blocker_is_reported() {
    type Change = fn(&mut Value);
    let changes: [(&str, Change); 6] = [
        ("label", |bound| bound["label"] = "regular/else".into()),
        ("one point less", |bound| {
            bound["boundary"].as_array_mut().unwrap().pop();
        }),
        ("start", |bound| add(&mut bound["start_s"], 1e-6)),
        ("step", |bound| add(&mut bound["delta_s"], 1e-6)),
        ("blocker", |bound| {
            bound["blocking_obstacle_id"] = "nobody".into();
            bound["blocking_candidates"] = Value::Array(Vec::new());
        }),
        ("last point", |bound| {
            let last = bound["boundary"].as_array_mut().unwrap().last_mut().unwrap();
            add(&mut last[1], 1.0);
        }),
    ];
    for (what, change) in changes {
        let name = format!("wrong-{}.jsonl", what.replace(' ', "-"));
        let output = conformance(&[&file(&name, &changed("regular/self", change))]);
        assert_eq!(code(&output), 1, "{what}: {}", last_line(&output));
        assert_eq!(last_line(&output), "0 passed, 1 failed", "{what}");
    }
}

#[test]
fn a_wrong_result_or_place_is_reported() {
    let error = |case: &&Value| case["expected"]["result"] == "error";
    let mut failing = cases().iter().find(error).unwrap().clone();
    failing["expected"]["result"] = "check_failed".into();
    let output = conformance(&[&file("wrong-result.jsonl", failing.to_string().as_bytes())]);
    assert_eq!(code(&output), 1);

    let is_placed = |case: &&Value| case["expected"]["pull_over"]["position"].is_object();
    let placed = cases().iter().find(is_placed).unwrap().clone();
    for path in ["/position/x", "/position/y", "/theta", "/width_left"] {
        let mut moved = placed.clone();
        add(moved["expected"]["pull_over"].pointer_mut(path).unwrap(), 1e-6);
        let name = format!("moved{}.jsonl", path.replace('/', "-"));
        let output = conformance(&[&file(&name, moved.to_string().as_bytes())]);
        assert_eq!(code(&output), 1, "{path}");
    }
    let output = conformance(&[&file("placed.jsonl", placed.to_string().as_bytes())]);
    assert_eq!(code(&output), 0);
}

/// A file that cannot be used is a wrong call, not a failed case: exit code 2, and the file is named.
#[test]
fn unusable_files_end_with_two() {
    let mut case = cases().swap_remove(0);
    let missing = Path::new(env!("CARGO_TARGET_TMPDIR")).join("no-such-file.jsonl");
    let cut = &VECTORS[..VECTORS.len() / 2];
    case["input"].as_object_mut().unwrap().remove("ego");
    let unusable = [
        (missing, "no-such-file"),
        (file("garbage.jsonl", b"\x00\xff garbage"), "garbage.jsonl"),
        (file("text.jsonl", b"once upon a time"), "text.jsonl:1"),
        (file("empty.jsonl", b"\n\n"), "no case"),
        (
            file("unknown.jsonl", b"{\"name\": \"a\", \"input\": {}}"),
            "unknown kind",
        ),
        (file("array.jsonl", b"[1, 2]"), "unknown kind"),
        (file("number.jsonl", b"17"), "unknown kind"),
        (file("cut.jsonl.gz", cut), "cut.jsonl.gz"),
        (file("no-ego.jsonl", case.to_string().as_bytes()), "ego"),
    ];
    for (path, wanted) in &unusable {
        let output = conformance(&[path]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(code(&output), 2, "{}: {said}", path.display());
        assert!(said.contains(wanted), "{said:?} does not say {wanted:?}");
    }
    let output = conformance(&[]);
    assert_eq!(code(&output), 2);
    assert!(String::from_utf8_lossy(&output.stderr).contains("usage"));
}
