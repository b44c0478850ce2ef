//! Traces: whole, cut off, killed, foreign.

use crate::program::{Folder, GOOD};
use std::time::Duration;

/// A trace of a short run.
fn trace(folder: &Folder) -> Vec<u8> {
    folder.put("good.toml", GOOD);
    assert_eq!(
        folder.run(&["run", "good.toml", "--trace", "x.zst"]).code,
        Some(0)
    );
    std::fs::read(folder.path("x.zst")).unwrap()
}

#[test]
fn a_trace_is_replayed_explained_and_shown() {
    let folder = Folder::new("trace");
    trace(&folder);
    let replayed = folder.run(&["replay", "x.zst"]);
    assert_eq!(replayed.code, Some(0), "{replayed:?}");
    assert!(replayed.out.starts_with("same: all "), "{}", replayed.out);
    let explained = folder.run(&["explain", "x.zst", "--at", "0.5"]);
    assert!(
        explained.out.contains("at 0.50 s") && explained.out.contains("candidates"),
        "{explained:?}"
    );
    assert_eq!(folder.run(&["view", "x.zst"]).out, "x.html\n");
    assert!(folder.path("x.html").is_file());
}

#[test]
fn a_moment_outside_the_run_is_refused() {
    let folder = Folder::new("moment");
    trace(&folder);
    for at in ["-1", "-0.1", "1e9", "inf", "nan"] {
        folder.refuses(
            &["explain", "x.zst", "--at", at],
            &["--at", "`x.zst` goes from 0 to"],
        );
    }
    folder.refuses(&["explain", "x.zst", "--at", "soon"], &["--at", "soon"]);
}

#[test]
fn what_is_no_trace_says_so() {
    let folder = Folder::new("no-trace");
    trace(&folder);
    folder.put("empty", "");
    folder.put("text", GOOD);
    folder.put("garbage", [0xff, 0xfe, 0x00, 0x9f, 0x92, 0x96]);
    folder.put("other", zstd::encode_all(&b"a letter\n"[..], 1).unwrap());
    folder.put(
        "version",
        zstd::encode_all(&b"{\"header\":{\"format\":99}}\n"[..], 1).unwrap(),
    );
    std::fs::create_dir(folder.path("folder")).unwrap();
    let cases: [(&str, &[&str]); 7] = [
        ("no/such.zst", &["`no/such.zst`", "No such file"]),
        ("folder", &["`folder`", "directory"]),
        ("empty", &["`empty` is empty"]),
        ("text", &["`text` is not a trace", "zstd"]),
        ("garbage", &["`garbage` is not a trace"]),
        ("other", &["`other` is not a trace", "header"]),
        (
            "version",
            &["`version` has trace format 99; this program reads format "],
        ),
    ];
    for (name, parts) in cases {
        folder.refuses(&["replay", name], parts);
        folder.refuses(&["explain", name, "--at", "1"], parts);
        folder.refuses(&["view", name], parts);
    }
}

#[test]
fn a_damaged_trace_names_the_place() {
    let folder = Folder::new("damaged");
    let mut bytes = trace(&folder);
    let middle = bytes.len() / 2;
    bytes[middle..middle + 8].fill(0x55);
    folder.put("damaged", bytes);
    folder.refuses(&["replay", "damaged"], &["`damaged`", "line "]);
}

/// Wherever a file was cut off, what is left is used or refused, and never a panic.
#[test]
fn a_cut_off_trace_is_used_as_far_as_it_goes() {
    let folder = Folder::new("cut");
    folder.run(&["run", "nudge_parked_car", "--trace", "x.zst"]);
    let bytes = std::fs::read(folder.path("x.zst")).unwrap();
    for share in [1, 10, 50, 90, 99] {
        folder.put("cut", &bytes[..bytes.len() * share / 100]);
        let run = folder.run(&["replay", "cut"]);
        let said = run.out.starts_with("same: the ") && run.out.contains("cut-off");
        assert!(
            run.code == Some(0) && said || run.code == Some(2),
            "at {share} %: {run:?}"
        );
        assert!(share < 50 || said, "at {share} %: {run:?}");
    }
    assert_eq!(folder.run(&["explain", "cut", "--at", "0.5"]).code, Some(0));
    assert_eq!(folder.run(&["view", "cut"]).code, Some(0));
}

#[test]
fn a_killed_run_leaves_a_trace_to_work_with() {
    let folder = Folder::new("killed");
    // Small steps, so that the run is still going on when its trace has begun to grow.
    let slow = ["--set", "physics.dt=0.0005", "--set", "tick=0.05"];
    let arguments = [&["run", "--trace", "x.zst"][..], &slow].concat();
    let mut child = folder.command(&arguments).spawn().unwrap();
    let size = || folder.path("x.zst").metadata().map_or(0, |file| file.len());
    let mut sizes = vec![0];
    while sizes.len() < 4 {
        std::thread::sleep(Duration::from_millis(1));
        assert!(
            child.try_wait().unwrap().is_none(),
            "it ended before it could be killed"
        );
        if size() > sizes[sizes.len() - 1] {
            sizes.push(size());
        }
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let run = folder.run(&["replay", "x.zst"]);
    assert!(run.code == Some(0) && run.out.contains("cut-off"), "{run:?}");
    assert_eq!(folder.run(&["explain", "x.zst", "--at", "0.1"]).code, Some(0));
}

#[test]
fn a_trace_of_other_states_differs() {
    let folder = Folder::new("differs");
    let text = zstd::decode_all(&trace(&folder)[..]).unwrap();
    let text = String::from_utf8(text).unwrap();
    let at = text.rfind("\"hash\":\"").unwrap() + "\"hash\":\"".len();
    let digit = if text[at..].starts_with('0') { "1" } else { "0" };
    let other = format!("{}{digit}{}", &text[..at], &text[at + 1..]);
    folder.put("other", zstd::encode_all(other.as_bytes(), 1).unwrap());
    let run = folder.run(&["replay", "other"]);
    assert_eq!(run.code, Some(1));
    assert!(
        run.out.contains("differs from tick") && run.out.contains("state hash"),
        "{}",
        run.out
    );
}
