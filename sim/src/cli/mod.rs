//! The command line: one file per verb. Results go to standard output, everything else to standard error.
//!
//! Exit codes: 0 passed, 1 a gate failed, 2 wrong use or bad input.
#![allow(clippy::print_stdout, reason = "a program that prints its results")]

mod blame;
mod catalog;
mod export;
mod faults;
mod import;
mod map;
mod output;
mod outputs;
mod planner;
mod results;
mod run;
mod search;
mod shrink;
mod source;
mod sweep;
mod trace;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Drives scenarios in a closed loop and judges the decider.
#[derive(Parser)]
#[command(name = "corridor", version, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Run one scenario and print its verdict.
    Run(run::Run),
    /// Run many seeds of many scenarios and report.
    Sweep(sweep::Sweep),
    /// Make the results of all parts of one sweep into one.
    Merge(results::Merge),
    /// Tell what a results file comes to, and write reports of it.
    Report(results::Report),
    /// Pair two results files seed by seed and test what differs.
    Compare(results::Compare),
    /// Look for failures of a family instead of drawing at random.
    Search(search::Search),
    /// Make a failing run small: fewer obstacles, shorter, rounder numbers, the same failure.
    Shrink(shrink::Shrink),
    /// Plant faults one by one and see whether each is caught.
    Faults(faults::Faults),
    /// Find out whose fault a run that failed is, and whether it could have been avoided.
    Blame(blame::Blame),
    /// Run a trace again and compare every state.
    Replay(trace::Replay),
    /// List the catalog.
    List(catalog::List),
    /// Check scenario files without running them.
    Validate(catalog::Validate),
    /// Tell what one tick saw and decided, and why.
    Explain(trace::Explain),
    /// Write a page that shows a trace.
    View(trace::View),
    /// Tell and draw what a map file holds.
    Map(map::Map),
    /// Make a scenario of a map file.
    Import(import::Import),
}

/// Whether the gates were passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Gate {
    Passed,
    Failed,
}

pub(crate) fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let gate = match &arguments.verb {
        Verb::Run(run) => run.execute(),
        Verb::Sweep(sweep) => sweep.execute(),
        Verb::Merge(merge) => merge.execute(),
        Verb::Report(report) => report.execute(),
        Verb::Compare(compare) => compare.execute(),
        Verb::Search(search) => search.execute(),
        Verb::Shrink(shrink) => shrink.execute(),
        Verb::Faults(faults) => faults.execute(),
        Verb::Blame(blame) => blame.execute(),
        Verb::Replay(replay) => replay.execute(),
        Verb::List(list) => list.execute(),
        Verb::Validate(validate) => validate.execute(),
        Verb::Explain(explain) => explain.execute(),
        Verb::View(view) => view.execute(),
        Verb::Map(map) => map.execute(),
        Verb::Import(import) => import.execute(),
    };
    match gate {
        Ok(Gate::Passed) => ExitCode::SUCCESS,
        Ok(Gate::Failed) => ExitCode::from(1),
        Err(error) => {
            output::note(&format!("error: {}", message(&error)));
            ExitCode::from(2)
        }
    }
}

/// The error and what caused it, in one line. Some errors already end with their cause; it is not said twice.
fn message(error: &anyhow::Error) -> String {
    let causes = error.chain().map(ToString::to_string);
    causes.fold(String::new(), |text, cause| match text.as_str() {
        "" => cause,
        said if said.ends_with(&cause) => text,
        _ => format!("{text}: {cause}"),
    })
}
