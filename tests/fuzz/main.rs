//! Damaged files of every format, thousands of them: each is read or refused with a message, none makes the program
//! panic, hang or fill the memory.
//!
//! The inputs are the same in every run: `corpus` says what is damaged, `mutate` how, `targets` who reads it, `limits`
//! what that may cost. `CORRIDOR_FUZZ_INPUTS` multiplies the number of inputs and `CORRIDOR_FUZZ_SEED` chooses
//! others, for a longer hunt. The input at hand lies in a file while it is read, so that one that ends the
//! whole process is not lost; `watch` ends it when an input is read without end (`CORRIDOR_FUZZ_SECONDS` says how long that is).

mod corpus;
mod limits;
mod mutate;
mod planted;
mod targets;
mod watch;

use corpus::corpus;
use limits::Meter;
use mutate::Mutator;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use targets::{Outcome, TARGETS, Target};
use watch::Watch;

/// Memory is counted for the whole process, so only one target is at work at a time.
static ALONE: Mutex<()> = Mutex::new(());

/// What came of the inputs of one target.
#[derive(Default)]
struct Tally {
    read: usize,
    refused: usize,
    faults: Vec<String>,
    worst: (u64, std::time::Duration),
}

fn setting(name: &str, usual: u64) -> u64 {
    let set = std::env::var(name).ok();
    set.map_or(usual, |text| {
        text.parse().unwrap_or_else(|_| panic!("{name} is no number"))
    })
}

/// Where the input at hand of a target lies.
fn at_hand(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz-{name}.input"))
}

/// Reads one input. A fault is kept beside the input at hand.
fn try_one(name: &str, target: Target, bytes: &[u8], watch: &Watch, tally: &mut Tally) {
    let file = at_hand(name);
    std::fs::write(&file, bytes).expect("the target folder can be written to");
    watch.begin(&file, bytes.len());
    let meter = Meter::start();
    let fault = match catch_unwind(AssertUnwindSafe(|| target(bytes))) {
        Ok(Outcome::Refused(message)) if message.trim().is_empty() => {
            Some("refused without a word".to_owned())
        }
        Ok(Outcome::Refused(_)) => {
            tally.refused += 1;
            None
        }
        Ok(Outcome::Read(_)) => {
            tally.read += 1;
            None
        }
        Err(_) => Some("panicked".to_owned()),
    };
    watch.end();
    let (memory, work) = meter.read();
    tally.worst = (tally.worst.0.max(memory), tally.worst.1.max(work));
    if let Some(fault) = fault.or_else(|| meter.excess(bytes.len())) {
        let kept = file.with_extension(format!("fault{}", tally.faults.len()));
        std::fs::write(&kept, bytes).expect("the target folder can be written to");
        tally.faults.push(format!("{fault}: {}", kept.display()));
    }
}

/// The own files as they are, and `inputs` damaged ones.
fn fuzz(name: &str, inputs: u64) {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let mut targets = TARGETS.into_iter().chain(planted::TARGETS);
    let (_, target) = targets.find(|(known, _)| *known == name).expect("a target");
    let corpus = corpus(name);
    let watch = Watch::start();
    let mut tally = Tally::default();
    for (file, bytes) in &corpus {
        let outcome = target(bytes);
        assert!(
            matches!(outcome, Outcome::Read(parts) if parts > 0),
            "{file}: {outcome:?}"
        );
    }
    let mut mutator = Mutator::new(setting("CORRIDOR_FUZZ_SEED", 1));
    for _ in 0..inputs * setting("CORRIDOR_FUZZ_INPUTS", 1) {
        let (_, original) = &corpus[mutator.below(corpus.len())];
        let (_, other) = &corpus[mutator.below(corpus.len())];
        let bytes = mutator.damaged(original, other);
        try_one(name, target, &bytes, &watch, &mut tally);
        if tally.faults.len() > 9 {
            break;
        }
    }
    let Tally {
        read,
        refused,
        faults,
        worst,
    } = tally;
    tell(&format!(
        "{name}: {read} read, {refused} refused; at most {} MB and {:?}",
        worst.0 >> 20,
        worst.1
    ));
    assert!(faults.is_empty(), "{name}: {faults:#?}");
    let (low, all) = (inputs / 50, read + refused);
    assert!(
        read as u64 > low && refused as u64 > low,
        "{name}: the damage is too light or too heavy: {read} of {all} were read"
    );
    let _ = std::fs::remove_file(at_hand(name));
}

#[expect(clippy::print_stdout, reason = "whoever looks for the costs finds them here")]
fn tell(what: &str) {
    println!("{what}");
}

#[test]
fn opendrive() {
    fuzz("opendrive", 2500);
}

#[test]
fn lanelet2() {
    fuzz("lanelet2", 1200);
}

#[test]
fn commonroad() {
    fuzz("commonroad", 800);
}

#[test]
fn apollo_binary() {
    fuzz("apollo_binary", 6000);
}

#[test]
fn apollo_text() {
    fuzz("apollo_text", 6000);
}

#[test]
fn apollo_routing() {
    fuzz("apollo_routing", 6000);
}

#[test]
fn scenario() {
    fuzz("scenario", 1500);
}

#[test]
fn trace() {
    fuzz("trace", 1500);
}

#[test]
fn trace_lines() {
    fuzz("trace_lines", 1500);
}

/// The same seed makes the same inputs; without that a fault could not be found again.
#[test]
fn damage_is_repeatable_and_of_many_kinds() {
    let (_, original) = &corpus("scenario")[0];
    let inputs = |seed| {
        let mut mutator = Mutator::new(seed);
        let all: Vec<Vec<u8>> = (0..200).map(|_| mutator.damaged(original, original)).collect();
        all
    };
    let mut all = inputs(5);
    assert_eq!(all, inputs(5));
    let (low, high) = (original.len() / 2, original.len() * 2);
    assert!(all.iter().any(|bytes| bytes.len() > high) && all.iter().any(|bytes| bytes.len() < low));
    all.sort();
    all.dedup();
    assert!(all.len() > 150, "{} different ones of 200", all.len());
}
