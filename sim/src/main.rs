//! `corridor`: drives scenarios in a closed loop and judges the decider.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main()
}
