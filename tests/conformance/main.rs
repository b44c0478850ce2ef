//! Holds Corridor against golden vectors of the original code.
//!
//! `conformance [--maps DIR] FILE…` takes plain or gzipped JSON lines, recognises the kind of each case, prints a line
//! per mismatch and ends with `N passed, N failed`. Cases on maps need the folder of the maps: `--maps`, else
//! `CORRIDOR_MAPS`, else `../shared/maps`. Exit code 0: all passed; 1: some failed; 2: a file that cannot be read.
#![allow(clippy::print_stdout, reason = "a program that prints its result")]

mod cases;
mod lattice;
mod map;
mod path_bounds;
mod qp;
mod speed;
mod stub_world;

use cases::Case;
use map::MapStore;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Where the maps are unless somebody says otherwise.
const MAPS: &str = "../shared/maps";

fn main() -> ExitCode {
    let Some((maps, files)) = arguments() else {
        eprintln!("usage: conformance [--maps DIR] FILE…   (JSON lines, plain or gzipped)");
        return ExitCode::from(2);
    };
    let mut store = MapStore::new(&maps);
    match files
        .iter()
        .try_fold((0, 0), |counts, file| run(file, &mut store, counts))
    {
        Ok((passed, failed)) => {
            println!("{passed} passed, {failed} failed");
            ExitCode::from(u8::from(failed > 0))
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

/// The folder of the maps, and the files of cases; `None` without a file.
fn arguments() -> Option<(PathBuf, Vec<PathBuf>)> {
    let mut maps = std::env::var_os("CORRIDOR_MAPS").map_or(PathBuf::from(MAPS), PathBuf::from);
    let mut files = Vec::new();
    let mut arguments = std::env::args_os().skip(1);
    while let Some(argument) = arguments.next() {
        if argument == "--maps" {
            maps = arguments.next()?.into();
        } else {
            files.push(argument.into());
        }
    }
    (!files.is_empty()).then_some((maps, files))
}

/// Runs all cases of a file, and counts those that passed and failed on.
fn run(
    file: &Path,
    store: &mut MapStore,
    (mut passed, mut failed): (usize, usize),
) -> Result<(usize, usize), Box<dyn std::error::Error>> {
    let cases = cases::read(file)?;
    if cases.iter().any(|case| matches!(case, Case::Map(_))) {
        store.check()?;
    }
    for case in &cases {
        match check(case, store) {
            Ok(()) => passed += 1,
            Err(mismatch) => {
                failed += 1;
                println!("{}: {mismatch}", case.name());
            }
        }
    }
    Ok((passed, failed))
}

/// Runs one case; the error says what differs first.
fn check(case: &Case, store: &mut MapStore) -> Result<(), String> {
    match case {
        Case::PathBounds(case) => path_bounds::check(case),
        Case::Map(case) => map::check(case, store),
        Case::Qp(case) => qp::check(case),
        Case::Speed(case) => speed::check(case),
        Case::Lattice(case) => lattice::check(case),
    }
}
