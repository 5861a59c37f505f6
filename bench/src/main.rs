//! The command `bench`: the measurements of the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    bench::main()
}
