//! The command `lab`: the jobs of the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    lab::main()
}
