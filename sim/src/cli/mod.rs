//! The command line: one file per verb. Results go to standard output, everything else to standard error.
//!
//! Exit codes: 0 passed, 1 a gate failed, 2 wrong use or bad input.
#![allow(clippy::print_stdout, reason = "a program that prints its results")]

mod run;
mod source;

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
    };
    match gate {
        Ok(Gate::Passed) => ExitCode::SUCCESS,
        Ok(Gate::Failed) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}
