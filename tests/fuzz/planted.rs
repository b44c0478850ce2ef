//! A fuzzer that finds nothing may be blind: readers with a planted fault, and what becomes of a process that fuzzes them.
//!
//! They read what begins with a lower-case letter, as scenario files do, and go wrong where nothing else would tell.

use crate::fuzz;
use crate::targets::{Outcome, Target};
use std::process::{Command, Output};

/// Names the planted fault for a process of its own.
const VARIABLE: &str = "CORRIDOR_FUZZ_PLANTED";

/// Time that an input may take, s: a planted loop need not run for long, but memory takes its time to fill.
const SECONDS: (&str, &str) = ("1", "30");

/// The readers by name.
pub(crate) const TARGETS: [(&str, Target); 3] = [
    ("planted_panic", |bytes| gone_wrong(bytes, || panic!("planted"))),
    ("planted_loop", |bytes| gone_wrong(bytes, endless)),
    ("planted_hunger", |bytes| gone_wrong(bytes, hungry)),
];

fn gone_wrong(bytes: &[u8], fault: impl FnOnce()) -> Outcome {
    if bytes.len() % 7 == 3 && !bytes.starts_with(b"description") {
        fault();
    }
    Outcome::Read(1)
}

fn endless() {
    let mut turns = 0_u64;
    while std::hint::black_box(turns) != u64::MAX {
        turns = turns.wrapping_add(2);
    }
}

fn hungry() {
    let mut all: Vec<Vec<u8>> = Vec::new();
    loop {
        all.push(vec![1; 1 << 24]);
        std::hint::black_box(&all);
    }
}

/// This program once more, with one fault planted.
fn process(fault: &str) -> Output {
    let program = std::env::current_exe().expect("a test is a program");
    Command::new(program)
        .args(["planted::at_work", "--exact", "--ignored", "--nocapture"])
        .env(VARIABLE, fault)
        .env(
            "CORRIDOR_FUZZ_SECONDS",
            if fault == "planted_hunger" {
                SECONDS.1
            } else {
                SECONDS.0
            },
        )
        .output()
        .expect("a program that runs can run again")
}

/// Does the work of the test below in a process of its own.
#[test]
#[ignore = "fails, as it should: another test starts it"]
fn at_work() {
    if let Ok(fault) = std::env::var(VARIABLE) {
        fuzz(&fault, 2000);
    }
}

#[test]
fn planted_faults_are_found_and_their_inputs_kept() {
    for (fault, told) in [
        ("planted_panic", "panicked: "),
        (
            "planted_loop",
            "of processor, 1s are allowed, and is still being read: ",
        ),
        ("planted_hunger", "of memory, "),
    ] {
        let output = process(fault);
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success(), "{fault}: {text}");
        let told = text.find(told).map(|at| &text[at + told.len()..]);
        let told = told.unwrap_or_else(|| panic!("{fault}: {text}"));
        let file = told.find(&format!("fuzz-{fault}.")).map(|at| &told[at..]);
        let name = file.and_then(|name| name.split(['"', '\n', ' ']).next());
        let name = name.unwrap_or_else(|| panic!("{fault}: no input is named: {text}"));
        let kept = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let input = std::fs::read(&kept).unwrap_or_else(|error| panic!("{}: {error}", kept.display()));
        assert!(
            input.len() % 7 == 3,
            "{fault}: {} is not what went wrong",
            kept.display()
        );
    }
}
