//! Entry point of the program `mbs`.

use std::env::args_os;
use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(mbs_cli::run(args_os().take(1), args_os().skip(1)))
}
