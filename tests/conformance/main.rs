//! Holds Corridor against golden vectors of the original code.
//!
//! `conformance FILE…` takes plain or gzipped JSON lines, recognises the kind of each case, prints a line per
//! mismatch and ends with `N passed, N failed`. Exit code 0: all passed; 1: some failed; 2: a file that cannot
//! be read.
#![allow(clippy::print_stdout, reason = "a program that prints its result")]

mod cases;
mod path_bounds;
mod stub_world;

use cases::Case;
use std::process::ExitCode;

fn main() -> ExitCode {
    let files: Vec<String> = std::env::args().skip(1).collect();
    if files.is_empty() {
        eprintln!("usage: conformance FILE…   (JSON lines, plain or gzipped)");
        return ExitCode::from(2);
    }
    let (mut passed, mut failed) = (0, 0);
    for file in &files {
        let cases = match cases::read(file.as_ref()) {
            Ok(cases) => cases,
            Err(error) => {
                eprintln!("error: {error}");
                return ExitCode::from(2);
            }
        };
        for case in &cases {
            match check(case) {
                Ok(()) => passed += 1,
                Err(mismatch) => {
                    failed += 1;
                    println!("{}: {mismatch}", case.name());
                }
            }
        }
    }
    println!("{passed} passed, {failed} failed");
    ExitCode::from(u8::from(failed > 0))
}

/// Runs one case; the error says what differs first.
fn check(case: &Case) -> Result<(), String> {
    match case {
        Case::PathBounds(case) => path_bounds::check(case),
    }
}
